"""Gas in the cylinder of any reciprocating compressor: polytropic, with ideal valves."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array


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
        left = self.fill_at_suction / np.maximum(fill, np.finfo(float).tiny)
        volume_ratio = np.where(expanding, np.maximum(left, 1.0), charge)
        return np.asarray(self.suction_pressure_pa * volume_ratio**self.exponent)
