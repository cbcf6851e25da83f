"""Published mechanism models: from a machine and its speed to force and moment by source."""

from collections.abc import Callable
from typing import Any, Final

from ..moving_parts import MachineMotion
from .hermetic.revolution import hermetic_revolution
from .oldham_scroll import oldham_scroll
from .reciprocating.revolution import reciprocating_revolution

Mechanism = Callable[[Any, float, int], MachineMotion]
"""(machine, speed in rpm, crank angles of a revolution) to a steady revolution."""

MECHANISMS: Final[dict[str, Mechanism]] = {
    "oldham-scroll": oldham_scroll,
    "reciprocating": reciprocating_revolution,
    "hermetic-reciprocating": hermetic_revolution,
}
"""Mechanism of each kind of machine."""

__all__ = [
    "MECHANISMS",
    "Mechanism",
    "hermetic_revolution",
    "oldham_scroll",
    "reciprocating_revolution",
]
