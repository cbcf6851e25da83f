"""Transmission of loads of the moving parts to sound, as the results hold it."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..radiation.transfer_vectors import interpolate_transfer_vector
from ..transfer import MachineOnMounts
from .machines import Machines

SAME: Final = 1e-6
"""Relative difference below which the page's model is that of the run."""
_DIMS: Final = ("speed", "option", "dof", "order")


@dataclass(frozen=True)
class Transmission:
    """Loads, their motion and their sound at the orders, complex peaks.

    Attributes
    ----------
    frequency_hz : frequency of the orders, shape (speed, order)
    load : force and moment of all moving parts on their body, shape (speed, option, 6, order)
    velocity : velocity of the body on the feet, of the same shape
    vector : pressure per velocity, zero at orders that the run did not take along, shape (speed,
        receiver, 6, order), Pa s/m
    pressure : pressure of the loads behind the option's insertion loss, shape (speed, option,
        receiver, order), Pa
    """

    frequency_hz: Array
    load: ComplexArray
    velocity: ComplexArray
    vector: ComplexArray
    pressure: ComplexArray

    def moves_as_in(self, machines: Machines) -> bool:
        """Whether the machines, as they are read, move under these loads as they did in the run."""
        for number, name in enumerate(machines.machine):
            stand = machines.different[machines.number(name)]
            velocity = velocity_per_load(stand, self.frequency_hz)
            again = np.einsum("sdln,sln->sdn", velocity, self.load[:, number])
            if not _same(again, self.velocity[:, number]):
                return False
        return True

    def is_all_of(self, pressure_line: ComplexArray) -> bool:
        """Whether it is all that sounds.

        Parameters
        ----------
        pressure_line : pressure of all sources, orders first, shape (speed, option, receiver,
            line), Pa
        """
        orders = self.pressure.shape[-1]
        others = pressure_line[..., orders:]
        return _same(self.pressure, pressure_line[..., :orders]) and not np.any(others)


def transmission_of(results: xr.Dataset, machines: Machines) -> Transmission:
    """Loads and sound of the moving parts."""
    force, moment = (
        results[f"{name}_order"].sum("source").transpose("speed", "option", "axis", "order").values
        for name in ("force", "moment")
    )
    frequency = results["order_frequency"]
    table = results["transfer_vector"]
    held = frequency.clip(max=float(table["frequency"].max()))
    vector = interpolate_transfer_vector(table, held)
    vector_at = vector.transpose("speed", "receiver", "dof", "order").values
    load = np.concatenate([force, moment], axis=2)
    vector_at = vector_at * _taken(load)[:, None, None]
    velocity = results["velocity_order"].sum("source").transpose(*_DIMS).values
    factor = np.array(
        [
            [machines.amplitude_factor(name, hertz) for name in machines.option]
            for hertz in frequency.values
        ]
    )
    pressure = np.einsum("srdn,sodn,son->sorn", vector_at, velocity, factor)
    return Transmission(frequency.values, load, velocity, vector_at, pressure)


def beside(all_together: ComplexArray, part: ComplexArray) -> ComplexArray:
    """Return the difference of a sum and a part of it, zero where it is rounding."""
    others = all_together - part
    return np.where(np.abs(others) > SAME * np.abs(all_together), others, 0.0)


def velocity_per_load(machine: MachineOnMounts, frequency_hz: Array) -> ComplexArray:
    """Velocity of the body on the feet per load on that with the mechanism.

    Parameters
    ----------
    machine : on its mounts
    frequency_hz : shape (speed, order); at zero nothing moves

    Returns
    -------
    shape (speed, 6 velocities, 6 loads, order)
    """
    moves = frequency_hz > 0.0
    frequency = np.where(moves, frequency_hz, 1.0)
    unit = np.broadcast_to(np.eye(6, dtype=complex)[:, None, None], (6, *frequency.shape, 6))
    velocity = machine.response(unit, frequency).velocity  # (load, speed, order, velocity)
    return np.asarray(np.moveaxis(velocity * moves[..., None], (0, 3), (2, 1)))


def _taken(load: ComplexArray) -> Array:
    """1 up to the highest order that is loaded at a speed, 0 above, shape (speed, order)."""
    loaded = np.any(load != 0.0, axis=(1, 2))
    return np.maximum.accumulate(loaded[:, ::-1], axis=1)[:, ::-1].astype(float)


def _same(first: ComplexArray, other: ComplexArray) -> bool:
    size = np.max(np.abs(other), initial=0.0)
    return bool(np.max(np.abs(first - other), initial=0.0) <= SAME * size)
