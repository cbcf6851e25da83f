"""Levels, orders and natural frequencies over the speed, and speeds to avoid."""

import xarray as xr

from ...base.registry import register
from ...results.over_speed.avoid import avoided
from ..avoid import avoid_table, reference_words, rule_words
from ..blocks import Block, Pictures, Text
from ..figures.over_speed import over_speed_figures
from ..shown_speeds import over_speed
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    every = avoided(results)
    table = avoid_table(results, every)
    return [
        Text(reference_words(every), "strong"),
        *([table] if table else []),
        Text(rule_words(results), "note"),
        Pictures(tuple(over_speed_figures(results))),
    ]


register(Section("speeds", "Over the speed", _blocks, over_speed, 35.0))
