"""Flows through the valves of a reciprocating compressor's cylinder."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from ..base.arrays import Array
from .capabilities import Capability
from .cylinder_gas import IdealValveCycle
from .moving_parts import derivative
from .rotation import uniform_crank_angle

FLOW_SAMPLES: Final = 4096
"""Crank angles a revolution that sources take: the flow jumps where a valve opens."""


@dataclass(frozen=True)
class ValvedCylinder(Capability):
    """A cylinder whose ideal valves pass what the piston displaces while they are open.

    Attributes
    ----------
    displaced_m3 : volume between the dead centres
    gas : pressures, exponent, clearance
    fill : volume over displaced volume at crank angles in rad
    """

    words: ClassVar[str] = "a cylinder with valves"
    displaced_m3: float
    gas: IdealValveCycle
    fill: Callable[[Array], Array]

    def flows_m3_per_rad(self, samples: int) -> tuple[Array, Array]:
        """Out of the suction side and into the discharge side, at the pressure there.

        Times the angular frequency they are flows in m³/s; the shaft is taken to turn evenly.

        Parameters
        ----------
        samples : uniform crank angles of a revolution
        """
        fill = self.fill(uniform_crank_angle(samples))
        slope = self.displaced_m3 * derivative(fill, 1)
        suction, discharge = self.gas.open_valves(fill, slope > 0.0)
        return np.where(suction, slope, 0.0), np.where(discharge, -slope, 0.0)
