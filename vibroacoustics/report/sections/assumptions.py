"""Where the inputs come from, and what is not modelled."""

import xarray as xr

from ...base.registry import register
from ...results.stored_study import overall_noise
from .. import assumptions
from ..blocks import Block, Bullets, Heading, Text
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    published = overall_noise(results)
    assumed, recorded = assumptions.assumed_count(results)
    return [
        Heading("What is not modelled"),
        Bullets(tuple(assumptions.not_modelled(results))),
        *([Text(assumptions.structure_borne_sentence(results))] if published else []),
        Heading("The remainder"),
        Text(assumptions.remainder_sentence(results)),
        *_of_discrepancy(results),
        Heading("Inputs"),
        Text(
            f"{assumed} of {recorded} recorded values are assumed; they come first. Where a range "
            "is given, the true value is believed to lie in it. Files are written in the units "
            "shown."
        ),
        assumptions.records_table(results),
    ]


def _of_discrepancy(results: xr.Dataset) -> list[Block]:
    sentence = assumptions.discrepancy_sentence(results)
    return [Heading("Model discrepancy"), Text(sentence)] if sentence else []


register(Section("assumptions", "Assumptions", _blocks, position=100.0))
