"""Loads, mounts and a free weight on the shaft: all that can move on the page."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.machine import Machine
from ..mechanics.capabilities import Slider
from ..mechanics.moving_parts import circling, wrench
from ..mechanics.rotation import Rotation
from ..orders.spectrum import order_spectrum_at_speed
from ..results.stored_study import options, parameters
from .machines import Machines, machines_of
from .mounts import MountMatrices, is_over_frequency, mount_matrices
from .transmission import Transmission, transmission_of

FORCES: Final = 2.0
"""The heaviest weight makes about so many times the largest force at 1x without an option."""
ROUNDING: Final = 1e-9
_RADIUS_M: Final = 0.025
"""Radius of the weight where the machine names no planes for weights."""
_REACH_M: Final = 0.2
"""Reach from the shaft's origin, to both sides."""


class Weight(NamedTuple):
    """Range of a weight.

    Attributes
    ----------
    moment_kg_m : the largest mass times radius
    height_m : lowest and highest, along the shaft from the origin of the crank's frame
    radius_m : at which a mass makes the moment
    origin_m, shaft : where heights begin, from the centre of mass at rest, and along which axis
    """

    moment_kg_m: float
    height_m: tuple[float, float]
    radius_m: float
    origin_m: tuple[float, float, float]
    shaft: tuple[float, float, float]


def weight_of(machine: Machine, force_1x_n: Array, speed_rpm: Array) -> Weight:
    """Range of a weight on a machine.

    Parameters
    ----------
    machine : without an option
    force_1x_n : its largest force at 1x, by speed, shape (speed,)
    speed_rpm : shape (speed,)
    """
    slider = machine.capability(Slider)
    angular = 2.0 * np.pi * speed_rpm / 60.0
    moment = max(FORCES * float(np.max(force_1x_n / angular**2)), 1e-6)
    moment = float(f"{moment:.0e}")
    axes = machine.crank_frame.origin_m, machine.crank_frame.shaft
    if slider is None:
        return Weight(moment, (-_REACH_M, _REACH_M), _RADIUS_M, *axes)
    planes = slider.planes
    heights = (planes.lower_height_m, planes.upper_height_m, slider.height_m)
    return Weight(moment, (min(heights), max(heights)), planes.radius_m, *axes)


def unit_loads(machine: Machine, results: xr.Dataset, weight: Weight) -> ComplexArray:
    """Loads of 1 kg m on the shaft, above the pin: a force and a moment.

    The force of any angle is that at the pin, turned about the shaft; its moment follows from the
    point of the shaft at the weight's height. About the shaft a weight that speeds up and slows
    down makes m r² times the shaft's acceleration besides, wherever it is.

    Parameters
    ----------
    machine : on whose shaft it turns
    results : at one speed with one option, whose shaft turns it: `shaft_speed`,
        `shaft_acceleration`, `order`
    weight : its radius

    Returns
    -------
    shape (2: force and moment, axis, order), N and N m, complex peaks
    """
    speed = results["shaft_speed"].values
    rotation = Rotation(speed, results["shaft_acceleration"].values)
    radius, frame = weight.radius_m, machine.crank_frame._replace(origin_m=(0.0, 0.0, 0.0))
    part = circling("weight", 1.0 / radius, radius, 0.0, rotation.crank_angle, frame)
    loads = np.array(wrench((part,), rotation))
    lines = order_spectrum_at_speed(loads, speed, int(results["order"].max()))
    return np.where(np.abs(lines) > ROUNDING * np.max(np.abs(lines)), lines, 0.0)


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
