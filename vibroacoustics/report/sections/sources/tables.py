"""Tables of the sources of sound, and of what the options do to them."""

import xarray as xr

from ....base import rounding
from ....base.vocabulary import SUFFIXES
from ....results.estimates import has_samples, is_sampled
from ....results.stored_study import (
    at_catalogue,
    catalogue_receiver,
    nearest_speed,
    overall_noise,
    source_name,
)
from ...bands import INTERVAL, band
from ...remainder import remainder_band
from ...tables import DataTable, Table, data_table
from .words import ranked, source_share, unmodelled_share


def sources_data(results: xr.Dataset) -> DataTable:
    """Return a row per option, speed, microphone and source."""
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
    return data_table(("option", "speed", "receiver", "sound_source"), columns)


def source_table(results: xr.Dataset) -> Table:
    """Return level and share of each source without a balancer at the published speed."""
    speed = nearest_speed(results)
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
        f"{speed:g} rpm, without a balancer, microphone {catalogue_receiver(results)}; "
        "levels do not add up"
    )
    return Table(caption, head, tuple(rows))
