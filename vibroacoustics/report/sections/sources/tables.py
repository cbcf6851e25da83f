"""Tables of the sources of sound, and of what the options do to them."""

from itertools import product

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.vocabulary import REFERENCE_OPTION, SUFFIXES
from ....results import labels
from ....results.estimates import has_samples, is_sampled
from ....results.stored_study import (
    at_catalogue,
    balancers,
    catalogue_receiver,
    options,
    overall_noise,
    source_name,
    speeds,
    words,
)
from ...bands import INTERVAL, band
from ...column_values import column
from ...remainder import remainder_band
from ...tables import Table, dataset_csv
from .changes import key_figure
from .words import ranked, source_share, unmodelled_share


def source_tables(results: xr.Dataset) -> list[Table]:
    """Level and share of each source without a balancer, a table per speed."""
    return [_source_table(results, speed) for speed in speeds(results)]


def change_tables(results: xr.Dataset) -> list[Table]:
    """What each option does to the line, to all sources and to the whole, a table per speed."""
    if not balancers(results):
        return []
    head = (
        "Option",
        "Δ 1× line, dB",
        "Δ all modelled sources, dB",
        "Δ total, dB",
        "Key impacts per revolution",
        "Largest key force, N",
    )
    receiver = catalogue_receiver(results)
    return [
        Table(
            f"{speed:g} rpm, microphone {receiver}: changes against {REFERENCE_OPTION}; keys of "
            "the ring + of a second ring",
            head,
            tuple(_change_row(results, option, speed) for option in options(results)),
        )
        for speed in speeds(results)
    ]


def figures_table(results: xr.Dataset) -> Table:
    """Figures of the sources, and those of options that differ from no balancer."""
    known = words(results)
    of_sources = known["source_figures"]
    names = [
        str(name) for name in results["reported_figure"]["figure"].values if name in of_sources
    ]
    cells = {
        (option, name): tuple(map(rounding.significant, key_figure(results, option, name)))
        for option, name in product([REFERENCE_OPTION, *balancers(results)], names)
    }
    rows = tuple(
        (option, labels.name(name, known), labels.unit(name, known) or "1", *values)
        for (option, name), values in cells.items()
        if set(values) != {rounding.NOTHING}
        and (option == REFERENCE_OPTION or values != cells[REFERENCE_OPTION, name])
    )
    head = ("Option", "Figure", "Unit", *(f"At {speed:g} rpm" for speed in speeds(results)))
    caption = "Figures of the sources; options where they differ from none"
    return Table(caption, head, rows, frozenset({0, 1, 2}))


def sources_csv(results: xr.Dataset) -> bytes:
    """One row per option, speed, microphone and source, to nine significant digits."""
    columns = {
        "option": results["option"],
        "speed_rpm": results["speed"],
        "receiver": results["receiver"],
        "source": results["sound_source"],
    }
    for variable, stem, unit in (
        ("source_level", "level", "_dba"), ("source_share", "share_of_energy", ""),
    ):  # fmt: skip
        columns[f"{stem}{unit}"] = results[variable]
        if is_sampled(results, variable):
            for suffix in SUFFIXES.values():
                columns[f"{stem}{suffix}{unit}"] = results[f"{variable}{suffix}"]
    return dataset_csv(("option", "speed", "receiver", "sound_source"), columns)


def _source_table(results: xr.Dataset, speed: float) -> Table:
    at = at_catalogue(results, speed=speed)
    rows = [
        (
            source_name(results, source).capitalize(),
            band(results, "source_level", **at, sound_source=source).middle_and_ends(
                rounding.level
            ),
            source_share(results, source, speed).in_percent(),
        )
        for source in ranked(results, speed)
    ]
    modelled = band(results, "level_modelled", **at).middle_and_ends(rounding.level)
    rows.append(("All modelled sources", modelled, rounding.NOTHING))
    if overall_noise(results) is not None:
        unmodelled = remainder_band(results, speed).middle_and_ends(rounding.level)
        share = unmodelled_share(results, speed).in_percent()
        total = band(results, "level_total", **at).middle_and_ends(rounding.level)
        rows += [("Unmodelled noise", unmodelled, share), ("Machine", total, "100 %")]
    of_level, of_share = ("", "")
    if has_samples(results):
        of_level, of_share = f", median ({INTERVAL})", f", mean ({INTERVAL})"
    head = ("Source", f"Level alone, dB(A){of_level}", f"Share of the energy{of_share}")
    caption = (
        f"{speed:g} rpm, option {REFERENCE_OPTION}, microphone {catalogue_receiver(results)}. "
        "Levels of parts do not add up to the level of the machine."
    )
    return Table(caption, head, tuple(rows))


def _change_row(results: xr.Dataset, option: str, speed: float) -> tuple[str, ...]:
    selection = at_catalogue(results, option=option, speed=speed)
    of_both = {**selection, "option": [option, REFERENCE_OPTION]}
    line = column(results, "level_1x_db").sel(of_both).values
    change = float(column(results, "change_1x_db").sel(selection))
    cells = [option, rounding.level_change(change, *map(float, line))]
    changes = (band(results, name, **selection) for name in ("change_modelled", "change_total"))
    cells += [change.middle_and_ends(rounding.signed) for change in changes]
    at = speeds(results).index(speed)
    for figure, write in (
        ("impacts_per_revolution", rounding.fixed),
        ("force_peak_n", rounding.significant),
    ):
        of_rings = [
            key_figure(results, option, f"{ring}_{figure}")[at] for ring in ("key", "twin_key")
        ]
        cells.append(" + ".join(write(value) for value in of_rings if np.isfinite(value)))
    return tuple(cells)
