"""Levels of sources and orders in a run-up between the speeds of a study."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block, Pictures
from ..figures.stacked import run_up_levels, run_up_orders
from . import Section, hold

_FEWEST: int = 3
"""Orders from which on they are shown as colours."""


def _blocks(results: xr.Dataset) -> list[Block]:
    several = results.sizes["run_up_order"] >= _FEWEST
    orders = [run_up_orders(results)] if several else []
    return [Pictures((run_up_levels(results), *orders))]


register(Section("run-up", "Run-up", _blocks, hold("run_up_level"), 35.0))
