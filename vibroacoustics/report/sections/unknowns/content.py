"""Unknowns that the level depends on, and what to measure next."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Text
from .. import Section
from . import tables as unknowns


def _blocks(results: xr.Dataset) -> list[Block]:
    samples = (
        "No level is published: all samples count alike."
        if list(results["level_share"]["knowledge"].values) == [unknowns.BEFORE]
        else "Values before and after are those of all samples at the point of the published "
        "level, after by their weights."
    )
    sentence = unknowns.measure_next_sentence(results)
    table = unknowns.unknowns_table(results)
    return [
        *([Text(sentence, "strong")] if sentence else []),
        Text(unknowns.resolved_sentence(results)),
        *([table] if table else []),
        Text(
            "A share is what the variance is expected to lose once the unknown is known (first "
            "order), with its 80 % bootstrap interval. It is resolved where this interval lies "
            f"above what chance gives the largest share. {samples}",
            "note",
        ),
    ]


def _applies(results: xr.Dataset) -> bool:
    return "level_share" in results


register(Section("unknowns", "What the level depends on", _blocks, _applies, 35.0))
