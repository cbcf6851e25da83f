"""Dominant sources of sound, and what the options do to them."""

from collections.abc import Callable
from typing import Final

import xarray as xr

from ....base import rounding
from ....base.registry import register
from ....base.vocabulary import SUFFIXES
from ....results.bands import INTERVAL, Band, band, written
from ....results.estimates import estimate, has_samples, is_sampled
from ....results.sample_words import prior_words
from ....results.stored_study import (
    at_catalogue,
    catalogue_receiver,
    has_sources,
    nearest_speed,
    overall_noise,
    source_name,
)
from ...blocks import Block, Bullets, Heading, Pictures, Text
from ...charts.marks import Chart
from ...figures.sources import changing_options, option_third_octaves, source_third_octaves
from ...figures.stacked import stacked_lines, stacked_third_octaves
from ...remainder import unmodelled_level
from ...tables import DataTable, Table, data_table
from .. import Section, text
from .words import certainty_sentences, ranked, source_share, unmodelled_share


def sources_data(results: xr.Dataset) -> dict[str, DataTable]:
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
    dims = ("option", "speed", "receiver", "sound_source")
    return {"sources.csv": data_table(dims, columns)}


def source_table(results: xr.Dataset) -> Table:
    """Return level and share of each source without a balancer at the published speed."""
    speed = nearest_speed(results)
    coordinates = at_catalogue(results, speed=speed)
    rows = []
    for source in ranked(results, speed):
        level = band(results, "source_level", **coordinates, sound_source=source)
        share = source_share(results, source, speed).in_percent()
        name = source_name(results, source).capitalize()
        rows.append((name, level.middle_and_ends(rounding.level), share))
    modelled = band(results, "level_modelled", **coordinates).middle_and_ends(rounding.level)
    rows.append(("All modelled sources", modelled, rounding.NOTHING))
    if overall_noise(results) is not None:
        unmodelled = unmodelled_level(results, speed).middle_and_ends(rounding.level)
        share = unmodelled_share(results, speed).in_percent()
        total = band(results, "level_total", **coordinates).middle_and_ends(rounding.level)
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


LEAST: Final = 0.01
"""Smaller shares are in uncertainty.csv."""


def spectrum_sentence(results: xr.Dataset) -> str:
    """Return how far the published spectral share changes shares; empty without one.

    A measured spectrum has a section of its own.
    """
    alternatives = results.get("alternative", xr.DataArray([])).values
    if "level alone" not in alternatives or "spectrum_measured" in results:
        return ""
    speed, sources = nearest_speed(results), list(map(str, results["sound_source"].values))

    def change(source: str) -> float:
        alone = alternative_share(results, "level alone", source).middle
        return abs(source_share(results, source, speed).middle - alone)

    source = max(sources, key=change)
    name = source_name(results, source)
    return (
        f"With the published spectral share {name} make "
        f"{source_share(results, source, speed).in_percent()} of the energy. The share with the "
        f"level alone is {alternative_share(results, 'level alone', source).in_percent()}."
    )


def alternative_share(results: xr.Dataset, alternative: str, part: str) -> Band:
    """Return the share of a part of the energy with less evidence or another prior."""
    share = estimate(results, "alternative_share", alternative=alternative, energy_part=part)
    return written(share, _effective(results, alternative))


def _effective(results: xr.Dataset, alternative: str) -> float:
    return float(results["alternative_effective"].sel(alternative=alternative))


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        source_table(results),
        Text(
            "A share holds half of the interference with other sources at one frequency; it can be "
            "negative. Other speeds, options and microphones are in sources.csv, figures of the "
            "sources in figures.csv.",
            "note",
        ),
        Pictures((source_third_octaves(results), *_further(results))),
        Heading("Uncertainty"),
        Bullets(tuple(certainty_sentences(results))),
        *text(spectrum_sentence(results)),
        *text(_prior_sentence(results), "note"),
    ]


def _further(results: xr.Dataset) -> list[Chart]:
    """Third octaves and lines divided among the sources, and what options can be heard to do."""
    charts: dict[str, Callable[[xr.Dataset], Chart]]
    charts = {}
    if "path_share" in results and "baseline_band_level" not in results:
        charts = {"path_band_share": stacked_third_octaves, "path_order_share": stacked_lines}
    if "total_band_level" in results and changing_options(results):
        charts["total_band_level"] = option_third_octaves
    return [make(results) for name, make in charts.items() if name in results]


def _prior_sentence(results: xr.Dataset) -> str:
    """Return words for the prior of unmodelled noise; empty where no level is published."""
    if overall_noise(results) is None or "prior" not in results:
        return ""
    return f"Level of unmodelled noise before the data: {prior_words(results)[0]}."


register(Section("sources", "Dominant sources", _blocks, has_sources, 30.0, tables=sources_data))
