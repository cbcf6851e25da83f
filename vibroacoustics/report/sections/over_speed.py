"""Levels, orders and natural frequencies over the speed, speeds to avoid, and a run-up."""

import xarray as xr

from ...base.registry import register
from ...results.over_speed.avoid import avoided
from ...results.stored_study import has_sources
from ..avoid import avoid_table, reference_words, rule_words
from ..blocks import Block, Pictures, Text
from ..figures.campbell import campbell
from ..figures.levels_over_speed import levels_over_speed, source_levels_over_speed
from ..figures.orders_over_speed import orders_over_speed, speed_frequency_map
from ..figures.stacked import run_up_levels, run_up_orders
from ..shown_speeds import over_speed
from . import Section, hold

_FEWEST: int = 3
"""Orders from which on they are shown as colours."""


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


def _run_up(results: xr.Dataset) -> list[Block]:
    several = results.sizes["run_up_order"] >= _FEWEST
    orders = [run_up_orders(results)] if several else []
    return [Pictures((run_up_levels(results), *orders))]


register(Section("run-up", "Run-up", _run_up, hold("run_up_level"), 35.0))
