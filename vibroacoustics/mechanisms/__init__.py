"""Published mechanism models: from a machine and its speed to force and moment by source."""

from collections.abc import Callable
from typing import Any, Final

from ..moving_parts import MachineMotion
from .hermetic.revolution import hermetic_revolution
from .minicrank.revolution import minicrank_revolution
from .oldham_scroll import oldham_scroll
from .reciprocating.revolution import reciprocating_revolution
from .slider_link.revolution import slider_link_revolution

Mechanism = Callable[[Any, float, int], MachineMotion]
"""(machine, speed in rpm, crank angles of a revolution) to a steady revolution."""

MECHANISMS: Final[dict[str, Mechanism]] = {
    "minicrank-scroll": minicrank_revolution,
    "oldham-scroll": oldham_scroll,
    "reciprocating": reciprocating_revolution,
    "slider-link": slider_link_revolution,
    "hermetic-reciprocating": hermetic_revolution,
}
"""Mechanism of each kind of machine."""

__all__ = [
    "MECHANISMS",
    "Mechanism",
    "hermetic_revolution",
    "minicrank_revolution",
    "oldham_scroll",
    "reciprocating_revolution",
    "slider_link_revolution",
]
