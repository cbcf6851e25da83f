"""Dominant sources of sound, and what the options do to them."""

import xarray as xr

from ....base.registry import register
from ....results.sample_words import prior_words
from ....results.stored_study import has_sources
from ...blocks import Block, Bullets, Heading, Pictures, Text
from ...charts.marks import Chart
from ...figures.sources import changing_options, option_third_octaves, source_third_octaves
from ...figures.stacked import stacked_lines, stacked_third_octaves
from ...tables import DataTable
from .. import Section
from . import energy as energy_words
from . import tables as source_tables
from . import words as source_words


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        source_tables.source_table(results),
        Text(
            "A share holds half of the interference with other sources at one frequency; it can be "
            "negative. Other speeds, options and microphones are in sources.csv, figures of the "
            "sources in figures.csv.",
            "note",
        ),
        Pictures((source_third_octaves(results), *_stacked(results), *_options(results))),
        Heading("Uncertainty"),
        Bullets(tuple(source_words.certainty_sentences(results))),
        *_alternatives(results),
    ]


def _stacked(results: xr.Dataset) -> list[Chart]:
    """Third octaves and lines, divided among the sources."""
    charts = {"band_energy": stacked_third_octaves, "line_energy": stacked_lines}
    return [make(results) for name, make in charts.items() if name in results]


def _options(results: xr.Dataset) -> list[Chart]:
    """Spectra of options, if any changes them by what can be heard."""
    changes = "total_band_level" in results and changing_options(results)
    return [option_third_octaves(results)] if changes else []


def _alternatives(results: xr.Dataset) -> list[Block]:
    """Level and shares with less evidence or the second prior, and what the priors are."""
    table = energy_words.alternatives_table(results)
    if table is None:
        return []
    words = prior_words(results)
    priors = zip(("first", "second"), words, strict=False)
    named = "; ".join(f"{which} prior {what}" for which, what in priors)
    return [
        table,
        Text(energy_words.spectrum_sentence(results)),
        Text(f"Level of unmodelled noise before the data: {named}.", "note"),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    return {"sources.csv": source_tables.sources_data(results)}


register(Section("sources", "Dominant sources", _blocks, has_sources, 30.0, tables=_data))
