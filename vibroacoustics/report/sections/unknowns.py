"""What the band of the level hangs on, and what to measure next."""

import xarray as xr

from ...base.registry import register
from .. import unknowns
from ..blocks import Block, Text
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    draws = (
        "No level is published: all draws count alike."
        if list(results["level_share"]["knowledge"].values) == [unknowns.BEFORE]
        else "Values before and after are those of all draws at the point of the published "
        "level, after by their weights."
    )
    sentence = unknowns.measure_next_sentence(results)
    return [
        *([Text(sentence, "strong")] if sentence else []),
        Text(unknowns.quality_sentence(results)),
        unknowns.unknowns_table(results),
        Text(
            "A share is what the variance is expected to lose once the unknown is known (first "
            f"order). {draws}",
            "note",
        ),
    ]


def _applies(results: xr.Dataset) -> bool:
    return "level_share" in results


register(Section("unknowns", "What the level hangs on", _blocks, _applies, 35.0))
