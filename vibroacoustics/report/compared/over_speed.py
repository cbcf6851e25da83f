"""Two results over the speed: levels and modes of two studies, orders of any two."""

import xarray as xr

from ...results.figure_limits import Compared
from ..blocks import Pictures
from ..figures.campbell import campbell
from ..figures.levels_over_speed import levels_over_speed
from ..figures.orders_over_speed import over_speed_picture
from ..figures.style import Picture, in_both_widths, numbered_file_name
from ..page import Part
from ..shown_speeds import FEWEST_OVER_SPEED, over_speed
from .validation import is_study


def over_speed_parts(compared: Compared) -> list[Part]:
    """A section of two studies that both have several speeds; none of others."""
    both = (compared.first, compared.second)
    if not all(is_study(one) and over_speed(one) for one in both):
        return []
    return [Part("speeds", "Over the speed", (Pictures((_levels(compared), _modes(compared))),))]


def channel_pictures(orders: xr.Dataset, channel: str) -> list[Picture]:
    """Orders of a channel in both results over the speeds, where these are several."""
    if orders.sizes["speed"] < FEWEST_OVER_SPEED:
        return []
    number = 1 + orders["channel"].values.tolist().index(channel)
    name = f"over_speed_{numbered_file_name(number, channel)}"
    return [over_speed_picture(orders, name, channel)]


def _levels(compared: Compared) -> Picture:
    first, second = (option for _, _, option, _ in compared.sides())
    return in_both_widths(
        "compared_levels_over_speed",
        "A-weighted level over the speed in both results, total and modelled.",
        f"A-weighted level over the speed. Solid: A, option {first}; dashed: B, option {second}. "
        "Shaded: speeds to avoid of A.",
        lambda width: levels_over_speed(
            compared.first, None, [first], compared.second, [second], width
        ),
    )


def _modes(compared: Compared) -> Picture:
    option = next(iter(compared.sides()))[2]
    return in_both_widths(
        "compared_campbell",
        "Campbell diagram: lines of A over the speed, natural frequencies of both results.",
        f"Campbell diagram: lines, crossings and speeds to avoid of A, option {option}. Natural "
        "frequencies: solid of A, dashed of B.",
        lambda width: campbell(compared.first, None, option, compared.second, width),
    )
