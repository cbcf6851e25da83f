"""Limits of orders, and how far below them the orders are."""

from typing import Final

from ..registry import register
from ..vocabulary import Variable

_ORDERS: Final = ("channel", "speed", "order")

for _thing in (
    Variable(
        "order_limit",
        _ORDERS,
        "",
        "largest root mean square allowed, NaN without limit, unit in channel_unit",
    ),
    Variable("limit_margin", _ORDERS, "dB", "limit over the order's root mean square"),
    Variable("within_limit", _ORDERS, "1", "whether the order is not above a limit"),
    Variable(
        "compared_order_rms",
        _ORDERS,
        "",
        "root mean square in the other result, unit in channel_unit",
    ),
    Variable(
        "compared_limit_margin",
        _ORDERS,
        "dB",
        "limit over the order's root mean square in the other result",
    ),
    Variable(
        "compared_within_limit",
        _ORDERS,
        "1",
        "whether the order in the other result is not above a limit",
    ),
):
    register(_thing)
