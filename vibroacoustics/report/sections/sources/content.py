"""Dominant sources of sound, and what the options do to them."""

import xarray as xr

from ....base.registry import register
from ....results.sample_words import prior_words
from ....results.stored_study import has_sources
from ...blocks import Block, Bullets, Heading, Pictures, Text
from ...charts.marks import Chart
from ...figures.sources import changing_options, option_third_octaves, source_third_octaves
from ...figures.stacked import stacked_lines, stacked_third_octaves
from ...remainder import total_sentence
from ...shown_speeds import chosen_speeds, few_speeds
from .. import Section
from . import energy as energy_words
from . import tables as source_tables
from . import words as source_words


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(source_words.carrier_sentence(results), "strong"),
        Text(source_words.shares_sentence(results)),
        *_alternatives(results),
        Heading("Uncertainty"),
        Bullets(tuple(source_words.certainty_sentences(results))),
        Heading("Sources without a balancer"),
        Text(
            "A level is that of the source alone. A share holds half of the interference with "
            "other sources at one frequency, so it can be negative. All shares add up to 100 %.",
            "note",
        ),
        *chosen_speeds(results, "sources.csv"),
        *source_tables.source_tables(few_speeds(results)),
        Pictures((source_third_octaves(results), *_stacked(results), *_options(results))),
        *_changes(few_speeds(results)),
        source_tables.figures_table(few_speeds(results)),
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
    priors = zip(("First", "Second"), words, strict=False)
    named = "; ".join(f"{which.lower()} prior {what}" for which, what in priors)
    return [table, Text(f"Level of unmodelled noise before the data: {named}.", "note")]


def _changes(results: xr.Dataset) -> list[Block]:
    tables = source_tables.change_tables(results)
    if not tables:
        return []
    return [
        Heading("What the options do to all sources"),
        Text(
            "The change of all modelled sources includes the side effects of an option: impacts "
            f"of keys without preload, and what pushes the ring. {total_sentence(results)} Where "
            "an interval includes zero, the sign of the change is not known.",
            "note",
        ),
        *tables,
    ]


register(Section("sources", "Dominant sources", _blocks, has_sources, 30.0))
