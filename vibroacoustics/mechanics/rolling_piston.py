"""Time histories of a rolling piston for sources."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from ..base.arrays import Array
from .capabilities import Capability


class RollingHistories(NamedTuple):
    """Time histories over uniform crank angles of a turn, shape (samples,) each.

    Attributes
    ----------
    speed_rad_per_s : speed of the shaft
    discharge_m3_per_s : flow into the shell, at the density there
    block_torque_n_m : on the cylinder block about the shaft, by gas, vane and films
    motor_torque_n_m : on the shaft
    landing_n : force of landing vanes on the block along the vane, their impulse in one sample
    """

    speed_rad_per_s: Array
    discharge_m3_per_s: Array
    block_torque_n_m: Array
    motor_torque_n_m: Array
    landing_n: Array


@dataclass(frozen=True)
class RollingPiston(Capability):
    """Cylinders with rolling pistons whose gas goes into the shell.

    Attributes
    ----------
    histories : function of a mean speed in rpm and a least number of samples
    density_kg_per_m3, sound_speed_m_per_s : density and sound speed of the discharged gas
    vane_height_m : mean height of the vanes from the centre of mass at rest
    """

    words: ClassVar[str] = "a rolling piston"
    histories: Callable[[float, int], RollingHistories]
    density_kg_per_m3: float
    sound_speed_m_per_s: float
    vane_height_m: float
