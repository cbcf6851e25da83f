"""All that can move on the page: loads, mounts and a weight, as far as the run allows."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray as xr

from ..base.arrays import ComplexArray
from ..base.vocabulary import REFERENCE_OPTION
from ..results.stored_study import options, parameters
from .machines import Machines, machines_of
from .mounts import MountMatrices, is_over_frequency, mount_matrices
from .transmission import Transmission, transmission_of
from .weight import Weight, unit_loads, weight_of


@dataclass(frozen=True)
class Moving:
    """A run whose loads and machines are known.

    Attributes
    ----------
    results : results of the run
    machines : machines of its options
    transmission : transmission of the loads of the moving parts
    """

    results: xr.Dataset
    machines: Machines
    transmission: Transmission

    @cached_property
    def weight(self) -> Weight | None:
        """Range of a weight; none where the results keep no rotation over crank angle."""
        if "shaft_acceleration" not in self.results:
            return None
        force = self.results["force_amplitude"].sel(option=REFERENCE_OPTION, order=1).values
        machine = self.machines.machine[REFERENCE_OPTION]
        return weight_of(machine, force, self.results["speed"].values)

    @cached_property
    def unit_loads(self) -> ComplexArray | None:
        """Loads of a unit weight, shape (speed, option, 2, axis, order)."""
        if self.weight is None:
            return None
        return np.array(
            [
                [self._unit_loads(speed, name, self.weight) for name in options(self.results)]
                for speed in self.results["speed"].values
            ]
        )

    @cached_property
    def mounts(self) -> list[MountMatrices]:
        """Matrices of the different machines."""
        names = options(self.results)
        number = [self.machines.number(name) for name in names]
        first = [names[number.index(row)] for row in range(len(self.machines.different))]
        return [mount_matrices(self.machines.machine[name]) for name in first]

    @cached_property
    def mounts_move(self) -> bool:
        """Whether stiffness and loss of the mounts can be varied.

        They cannot where more than the moving parts sounds: what other sources do to the machine on
        its mounts is not in the results.
        """
        if any(map(is_over_frequency, self.machines.different)):
            return False
        dims = ("speed", "option", "receiver", "line")
        pressure = self.results["pressure_line"].sum("sound_source").transpose(*dims).values
        return self.transmission.is_all_of(pressure)

    def orders(self) -> frozenset[float]:
        """Those that a weight has."""
        if self.unit_loads is None:
            return frozenset()
        loaded = np.any(self.unit_loads != 0.0, axis=(0, 1, 2, 3))
        sounds = np.any(self.transmission.vector != 0.0, axis=(0, 1, 2))
        orders = self.results["order"].values
        return frozenset(map(float, orders[loaded & sounds & (orders > 0)]))

    def _unit_loads(self, speed: float, option: str, weight: Weight) -> ComplexArray:
        shaft = self.results[["shaft_speed", "shaft_acceleration", "order"]].sel(
            speed=speed, option=option
        )
        return unit_loads(self.machines.machine[option], shaft, weight)


def moving_of(results: xr.Dataset) -> Moving | None:
    """Return what can move; none where the page's model is not that of the run."""
    measured = (parameters(results).get("measured") or {}).get("sound")
    if measured or "distance" not in results["transfer_vector"].coords:
        return None
    machines = machines_of(results)
    if machines is None:
        return None
    transmission = transmission_of(results, machines)
    if not transmission.moves_as_in(machines):
        return None
    return Moving(results, machines, transmission)
