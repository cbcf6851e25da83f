"""Gas in the cylinder of any reciprocating compressor: polytropic, with ideal valves."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from ..base.arrays import Array
from ..base.parameters import Contradictions, Parameters
from .capabilities import Capability
from .moving_parts import derivative
from .rotation import uniform_crank_angle

FLOW_SAMPLES: Final = 4096
"""Crank angles a revolution that sources take: the flow jumps where a valve opens."""


class IdealValveCycle(NamedTuple):
    """Polytropes between two pressures; valves open without loss."""

    suction_pressure_pa: float
    discharge_pressure_pa: float
    exponent: float
    clearance_ratio: float
    """Clearance volume over displaced volume."""

    @property
    def span(self) -> float:
        """Volume ratio at which one polytrope spans the two pressures."""
        ratio = self.discharge_pressure_pa / self.suction_pressure_pa
        return float(ratio ** (1.0 / self.exponent))

    @property
    def fill_at_suction(self) -> float:
        """Volume over displaced volume where the expanding gas has come down to suction."""
        return self.clearance_ratio * self.span

    @property
    def fill_at_discharge(self) -> float:
        """Volume over displaced volume where the compressed charge has reached discharge."""
        return (1.0 + self.clearance_ratio) / self.span

    def open_valves(
        self, fill: Array, expanding: NDArray[np.bool_]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Whether the suction and the discharge valve are open; parameters as `pressure_pa`."""
        suction = expanding & (fill >= self.fill_at_suction)
        return suction, ~expanding & (fill <= self.fill_at_discharge)

    def pressure_pa(self, fill: Array, expanding: NDArray[np.bool_]) -> Array:
        """Pressure at a volume over displaced volume, clearance included.

        Parameters
        ----------
        fill : volume over displaced volume, shape (samples,)
        expanding : whether the clearance's gas expands there, after top dead centre; else the
            charge is compressed
        """
        charge = (1.0 + self.clearance_ratio) / np.maximum(fill, self.fill_at_discharge)
        # Without clearance nothing expands; the smallest number keeps 0/0 out at top dead centre.
        expanded = self.fill_at_suction / np.maximum(fill, np.finfo(float).tiny)
        volume_ratio = np.where(expanding, np.maximum(expanded, 1.0), charge)
        return np.asarray(self.suction_pressure_pa * volume_ratio**self.exponent)


class CylinderGas(Parameters):
    """Polytropic cycle between two pressures with valves that open without loss."""

    suction_pressure_pa: float = Field(gt=0.0, le=1e8)
    discharge_pressure_pa: float = Field(gt=0.0, le=1e8)
    exponent_ratio: float = Field(ge=1.0, le=2.0)
    """Polytropic exponent."""
    clearance_ratio: float = Field(gt=0.0, le=1.0)
    """Clearance volume over swept volume."""

    def contradictions(self) -> Contradictions:
        if self.discharge_pressure_pa <= self.suction_pressure_pa:
            yield (
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must exceed "
                f"suction_pressure_bar = {1e-5 * self.suction_pressure_pa:g} bar"
            )
        reached = (1.0 + 1.0 / self.clearance_ratio) ** self.exponent_ratio
        if self.discharge_pressure_pa >= reached * self.suction_pressure_pa:
            yield (
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must be "
                f"less than {1e-5 * reached * self.suction_pressure_pa:g} bar, the compression at "
                f"clearance_ratio = {self.clearance_ratio:g}"
            )

    @property
    def valve_cycle(self) -> IdealValveCycle:
        """Cycle over volumes."""
        return IdealValveCycle(
            self.suction_pressure_pa,
            self.discharge_pressure_pa,
            self.exponent_ratio,
            self.clearance_ratio,
        )


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
        """Flows out of the suction side and into the discharge side, at the pressure there.

        Times the angular frequency they are flows in m³/s; the shaft is taken to turn evenly.

        Parameters
        ----------
        samples : uniform crank angles of a revolution
        """
        fill = self.fill(uniform_crank_angle(samples))
        slope = self.displaced_m3 * derivative(fill, 1)
        suction, discharge = self.gas.open_valves(fill, slope > 0.0)
        return np.where(suction, slope, 0.0), np.where(discharge, -slope, 0.0)
