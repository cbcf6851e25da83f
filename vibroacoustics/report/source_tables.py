"""Tables of the sources of sound, and of what the options do to them."""

from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import level_of_power, power_of_level
from ..base.vocabulary import REFERENCE_OPTION
from . import labels
from .bands import QUANTILES, Band, band, band_words, percent, quantiles, share_band
from .column_values import column
from .remainder import remainder_band
from .source_changes import key_figure
from .source_words import at_published, ranked, source_share
from .study import (
    a_weighted,
    at_catalogue,
    balancers,
    catalogue_receiver,
    has_samples,
    options,
    overall_noise,
    quoted_speed,
    source_name,
    speeds,
    total_of,
    words,
)
from .tables import Table, dataset_csv

_NOT_QUOTED: Final = "; no overall level is published at this speed"


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
        "Δ all modelled sources as assumed, dB",
        f"its {band_words(results)}, dB",
        "Δ total as assumed, dB",
        f"its {band_words(results)}, dB",
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
    caption = "Figures of the sources, values as assumed; options where they differ from none"
    return Table(caption, head, rows, frozenset({0, 1, 2}))


def sources_csv(results: xr.Dataset) -> bytes:
    """One row per option, speed, microphone and source, to nine significant digits."""
    sampled = quantiles(results, "source_level")
    columns = {
        "option": results["option"],
        "speed_rpm": results["speed"],
        "receiver": results["receiver"],
        "source": results["sound_source"],
        "level_dba": results["source_level"],
    }
    for quantile in QUANTILES:
        columns[f"level_{100.0 * quantile:.0f}_percent_dba"] = sampled.sel(quantile=quantile)
    columns["share_of_modelled_energy"] = results["source_share"]
    return dataset_csv(("option", "speed", "receiver", "sound_source"), columns)


def _source_table(results: xr.Dataset, speed: float) -> Table:
    quoted = speed == quoted_speed(results)
    head = [
        "Source, the loudest first",
        "Level as assumed, dB(A)",
        f"Middle of the samples ({band_words(results)}), dB(A)",
        "Share of the modelled energy, as assumed",
    ]
    if quoted:
        head.append(f"Share of the energy of {total_of(results)}, middle ({band_words(results)})")
    rows = [
        _row(
            source_name(results, source).capitalize(),
            _at(results, "source_level", speed, sound_source=source),
            level,
            percent(_at(results, "source_share", speed, sound_source=source)),
            source_share(results, source) if quoted else None,
        )
        for source, level in ranked(results, speed)
    ]
    caption = (
        f"{speed:g} rpm, option {REFERENCE_OPTION}, microphone {catalogue_receiver(results)}"
        + ("" if quoted or overall_noise(results) is None else _NOT_QUOTED)
    )
    return Table(caption, tuple(head), (*rows, *_sum_rows(results, speed, quoted)))


def _sum_rows(results: xr.Dataset, speed: float, quoted: bool) -> list[tuple[str, ...]]:
    """What is modelled, what is not, and the whole machine."""
    modelled, total = (_at(results, name, speed) for name in ("level_modelled", "level_total"))
    of_rest = _remainder_level(results)
    of_sums = (
        ("level_modelled", "All modelled sources", modelled, "100 %"),
        ("", "Not modelled, the remainder", _difference(total, modelled), rounding.NOTHING),
        ("level_total", "Whole machine", total, rounding.NOTHING),
    )
    return [
        _row(
            words,
            level,
            band(results, name, **at_catalogue(results, speed=speed))
            if name
            else remainder_band(results, speed),
            share,
            share_band(results, at_published(results, name) if name else of_rest)
            if quoted
            else None,
        )
        for name, words, level, share in of_sums[: 1 if overall_noise(results) is None else None]
    ]


def _remainder_level(results: xr.Dataset) -> xr.DataArray:
    """Level of the remainder by sample, or as given."""
    if not has_samples(results):
        return results["level_unmodelled"]
    return results["level_unmodelled_by_sample"]


def _row(
    name: str, level_dba: float, sampled: Band, share: str, of_machine: Band | None
) -> tuple[str, ...]:
    cells = (name, rounding.level(level_dba), sampled.middle_and_ends(rounding.level), share)
    return cells if of_machine is None else (*cells, of_machine.in_percent())


def _change_row(results: xr.Dataset, option: str, speed: float) -> tuple[str, ...]:
    selection = at_catalogue(results, option=option, speed=speed)
    of_both = {**selection, "option": [option, REFERENCE_OPTION]}
    line = column(results, "level_1x_db").sel(of_both).values
    change = float(column(results, "change_1x_db").sel(selection))
    cells = [option, rounding.level_change(change, *map(float, line))]
    for name in ("change_modelled", "change_total"):
        cells.append(rounding.signed(float(results[name].sel(selection))))
        cells.append(band(results, name, **selection).ends(rounding.signed))
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


def _at(results: xr.Dataset, name: str, speed: float, **more: str) -> float:
    return float(a_weighted(results[name]).sel(at_catalogue(results, speed=speed, **more)))


def _difference(total_dba: float, part_dba: float) -> float:
    """Level of what is left of a total without a part; SILENCE_DB if nothing is."""
    return level_of_power(power_of_level(total_dba) - power_of_level(part_dba))
