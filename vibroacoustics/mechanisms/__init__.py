"""Published mechanism models: from a machine to its moving parts."""

from collections.abc import Callable
from typing import Final

from ..moving_parts import Array, MovingPart
from ..parameters.machine import Machine
from .oldham import oldham_ring
from .rotating_set import rotating_set

Mechanism = Callable[[Machine, Array], tuple[MovingPart, ...]]

MECHANISMS: Final[dict[str, tuple[Mechanism, ...]]] = {"oldham-scroll": (oldham_ring, rotating_set)}
"""Mechanisms of each kind of machine."""

__all__ = ["MECHANISMS", "Mechanism", "oldham_ring", "rotating_set"]
