"""Levels, orders and natural frequencies over the speed, and speeds to avoid."""

import xarray as xr

from ...base.registry import register
from ...results.over_speed.avoid import avoided
from ...results.stored_study import has_sources
from ..avoid import avoid_table, reference_words, rule_words
from ..blocks import Block, Pictures, Text
from ..figures.campbell import campbell
from ..figures.levels_over_speed import levels_over_speed, source_levels_over_speed
from ..figures.orders_over_speed import orders_over_speed, speed_frequency_map
from ..shown_speeds import over_speed
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    every = avoided(results)
    table = avoid_table(results, every)
    charts = (
        levels_over_speed(results),
        *([source_levels_over_speed(results)] if has_sources(results) else []),
        orders_over_speed(results),
        speed_frequency_map(results),
        campbell(results),
    )
    return [
        Text(reference_words(every), "strong"),
        *([table] if table else []),
        Text(rule_words(results), "note"),
        Pictures(charts),
    ]


register(Section("speeds", "Over the speed", _blocks, over_speed, 35.0))
