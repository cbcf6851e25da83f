"""Two results over the speed: levels and modes of two studies, orders of any two."""

import xarray as xr

from ...results.figure_limits import Compared
from ..blocks import Part, Pictures
from ..charts.marks import Chart
from ..figures.campbell import campbell
from ..figures.levels_over_speed import levels_over_speed
from ..figures.orders_over_speed import orders_over_speed
from ..shown_speeds import FEWEST_OVER_SPEED, over_speed
from .validation import is_study


def over_speed_parts(compared: Compared) -> list[Part]:
    """Return a section of two studies that both have several speeds; none of others."""
    first, second = compared.first, compared.second
    if not all(is_study(results) and over_speed(results) for results in (first, second)):
        return []
    option, other = (option for _, _, option, _ in compared.sides())
    charts = (
        levels_over_speed(first, None, [option], second, [other]),
        campbell(first, None, option, second),
    )
    return [Part("speeds", "Over the speed", (Pictures(charts),))]


def channel_charts(orders: xr.Dataset, channel: str) -> list[Chart]:
    """Return orders of a channel in both results over the speeds, where these are several."""
    several = orders.sizes["speed"] >= FEWEST_OVER_SPEED
    return [orders_over_speed(orders, channel)] if several else []
