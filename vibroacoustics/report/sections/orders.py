"""Force, foot force and level by order."""

import xarray as xr

from ...base.registry import register
from ...results.stored_study import words
from ..blocks import Block, Pictures, Text
from ..figures.orders import foot_force_orders, force_orders, level_orders
from ..shown_speeds import chosen_speeds
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(f"{words(results)['orders']} A missing marker means a value too small to draw."),
        *chosen_speeds(results, "results.nc"),
        Pictures((force_orders(results), foot_force_orders(results), level_orders(results))),
    ]


register(Section("orders", "Orders", _blocks, position=40.0))
