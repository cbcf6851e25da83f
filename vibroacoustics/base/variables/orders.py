"""Shaft orders of forces and moments."""

from typing import Final

from ..registry import register
from ..vocabulary import Coordinate, Variable

_FORCES: Final = ("speed", "option", "source", "axis")
_ORDERS: Final = ("speed", "option", "order")

for _thing in (
    Coordinate("order", ("order",), "1", "shaft order"),
    Coordinate("order_frequency", ("speed", "order"), "Hz", "frequency of a shaft order"),
    Variable("force_order", (*_FORCES, "order"), "N", "force order spectrum", complex_peak=True),
    Variable(
        "moment_order", (*_FORCES, "order"), "N m", "moment order spectrum", complex_peak=True
    ),
    Variable(
        "force_amplitude", _ORDERS, "N", "resultant force, semi-major axis of its ellipse, peak"
    ),
    Variable(
        "moment_amplitude", _ORDERS, "N m", "resultant moment, semi-major axis of its ellipse, peak"
    ),
):
    register(_thing)
