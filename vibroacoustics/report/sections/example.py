"""Values that are still those of the template which the study began with."""

from dataclasses import replace
from typing import Final

import xarray as xr

from ...base.registry import register
from ...results.stored_study import parameters
from ...study.example import example_sentence
from ..blocks import Block, Text
from . import Section, text
from .unknowns import in_si, unknowns_table

SHOWN: Final = 5
"""Ranked values on the page."""


def example_names(results: xr.Dataset) -> set[str]:
    """Dotted names, in SI, of the values that are the example's."""
    records = parameters(results)["records"]
    return {in_si(record["field"]) for record in records if record.get("example")}


def example_words(results: xr.Dataset) -> str:
    """Say how many values are the example's; empty where none is."""
    return example_sentence(len(example_names(results)), len(parameters(results)["records"]))


def _blocks(results: xr.Dataset) -> list[Block]:
    ranking = unknowns_table(results, example_names(results)) if "level_share" in results else None
    caption = "Values of the example that the modelled level depends on most, by the samples"
    if ranking is not None:
        ranking = replace(ranking, caption=caption, rows=ranking.rows[:SHOWN])
    how = "The others are" if ranking else "They are"
    return [
        Text(f"{example_words(results)} Results hold for your machine once they are replaced."),
        *([ranking] if ranking else []),
        *text(
            f"{how} marked in inputs.csv. `vibroacoustics check STUDY --example` moves each by "
            "itself and ranks them.",
            "note",
        ),
    ]


def _applies(results: xr.Dataset) -> bool:
    return bool(example_names(results))


register(Section("example", "Values of the example", _blocks, _applies, position=98.0))
