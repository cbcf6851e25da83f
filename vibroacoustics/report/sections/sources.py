"""What carries the level: the sources of sound, and what the options do to them."""

from typing import Final

import xarray as xr

from ...base.registry import register
from .. import energy_words, source_tables, source_words
from ..blocks import Block, Bullets, Heading, Pictures, Text
from ..figures import source_figures
from ..remainder import total_sentence
from ..speeds import chosen_speeds
from ..study import few_speeds, has_sources, overall_noise
from . import Section

_REMAINDER: Final = " The remainder is what each sample leaves of the published level."


def _blocks(results: xr.Dataset) -> list[Block]:
    has_total = overall_noise(results) is not None
    return [
        Text(source_words.carrier_sentence(results), "strong"),
        Text(source_words.shares_sentence(results)),
        *filter(None, [energy_words.energy_table(results)]),
        Heading("How sure that is"),
        Bullets(tuple(source_words.certainty_sentences(results))),
        Heading("Sources without a balancer"),
        Text(
            "Each level is that of the source alone. Shares of the modelled energy add up to "
            "100 %: lines of two sources at one frequency add as phasors, so a share can be "
            f"negative. The band of a sum is not the sum of bands.{_REMAINDER * has_total}",
            "note",
        ),
        *chosen_speeds(results, "sources.csv"),
        *source_tables.source_tables(few_speeds(results)),
        Pictures(tuple(source_figures(results))),
        *_changes(few_speeds(results)),
        source_tables.figures_table(few_speeds(results)),
    ]


def _changes(results: xr.Dataset) -> list[Block]:
    tables = source_tables.change_tables(results)
    if not tables:
        return []
    return [
        Heading("What the options do to all sources"),
        Text(
            "The change of all modelled sources holds the high-frequency side effects of an "
            "option: keys without preload that strike, and what pushes the ring. "
            f"{total_sentence(results)} A band that reaches from below to above zero says that "
            "not even the sign is known.",
            "note",
        ),
        *tables,
    ]


register(Section("sources", "What carries the level", _blocks, has_sources, 30.0))
