"""Force, foot force and level by order."""

import xarray as xr

from ...base.registry import register
from ...results.stored_study import words
from ..blocks import Block, Pictures, Text
from ..figures import order_figures
from ..speeds import chosen_speeds
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(f"{words(results)['orders']} A missing marker means a value too small to draw."),
        *chosen_speeds(results, "results.nc"),
        Pictures(tuple(order_figures(results))),
    ]


register(Section("orders", "Orders", _blocks, position=40.0))
