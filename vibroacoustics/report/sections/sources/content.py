"""Dominant sources of sound, and what the options do to them."""

from collections.abc import Callable

import xarray as xr

from ....base.registry import register
from ....results.sample_words import prior_words
from ....results.stored_study import has_sources
from ...blocks import Block, Bullets, Heading, Pictures, Text
from ...charts.marks import Chart
from ...figures.sources import changing_options, option_third_octaves, source_third_octaves
from ...figures.stacked import stacked_lines, stacked_third_octaves
from .. import Section
from .tables import alternatives_table, source_table, sources_data, spectrum_sentence
from .words import certainty_sentences


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
        *_alternatives(results),
    ]


def _further(results: xr.Dataset) -> list[Chart]:
    """Third octaves and lines divided among the sources, and what options can be heard to do."""
    charts: dict[str, Callable[[xr.Dataset], Chart]]
    charts = {"band_energy": stacked_third_octaves, "line_energy": stacked_lines}
    if "total_band_level" in results and changing_options(results):
        charts["total_band_level"] = option_third_octaves
    return [make(results) for name, make in charts.items() if name in results]


def _alternatives(results: xr.Dataset) -> list[Block]:
    """Level and shares with less evidence or the second prior, and what the priors are."""
    table = alternatives_table(results)
    if table is None:
        return []
    priors = zip(("first", "second"), prior_words(results), strict=False)
    named = "; ".join(f"{which} prior {what}" for which, what in priors)
    return [
        table,
        Text(spectrum_sentence(results)),
        Text(f"Level of unmodelled noise before the data: {named}.", "note"),
    ]


register(Section("sources", "Dominant sources", _blocks, has_sources, 30.0, tables=sources_data))
