"""A motor whose torque an inverter sets within a turn: what an option can control."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from pydantic import Field

from ..base.parameters import Parameters
from .capabilities import Capability


class TorqueControl(Parameters):
    """Motor torque that follows the first shaft orders of the load."""

    highest_order: int = Field(ge=1, le=8)
    current_limit_a: float | None = Field(default=None, gt=0.0, le=1e4)
    """Peak of the phase current; none is an ideal drive."""


@dataclass(frozen=True)
class ControlledMotor(Capability):
    """A motor on an inverter that may set the torque over the crank angle.

    Attributes
    ----------
    under : the machine with its motor under a control
    """

    words: ClassVar[str] = "a motor whose torque an inverter sets within a turn"
    under: Callable[[TorqueControl], Any]
