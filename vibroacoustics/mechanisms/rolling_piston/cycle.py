"""Steady turn of the machine: gas, vane and roller of each cylinder, speed of the shaft."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import SolverError
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import DrivenRotation, steady_rotation
from ...mechanics.rotation import Rotation
from ..oldham_scroll.revolution import two_plane_balance
from .contact import Contact, contact_turn, first_contact
from .drive import control_torque_n_m
from .gas import GasTurn, gas_of
from .parameters import RollingPistonTables
from .roller import journal_drag_n_m_s

SAMPLES: Final = 1440
"""Crank angles a turn: a quarter of a degree."""
ITERATIONS: Final = 200
LOAD_TOLERANCE: Final = 1e-13
"""Largest change of the load in the last iteration over the largest load."""
KEPT_CYCLES: Final = 16


@dataclass(frozen=True)
class RollingPistonCycle:
    """One steady turn over uniform crank angles.

    Attributes
    ----------
    rotation : speed, acceleration and all of the motor's torque
    gas : gas of each cylinder, over its own angle
    contacts : vane and roller of each cylinder, over its own angle
    load_n_m : torque against the rotation, shape (samples,)
    """

    rotation: DrivenRotation
    gas: GasTurn
    contacts: tuple[Contact, ...]
    load_n_m: Array

    def over_shaft(self, of_cylinder: Array, number: int) -> Array:
        """Turn a time history over a cylinder's own angle into one over the crank angle, last
        axis."""
        return np.roll(of_cylinder, -self._shift(number), axis=-1)

    def _shift(self, number: int) -> int:
        return number * (self.load_n_m.size // 2)


def inertia_kg_m2(machine: RollingPistonTables) -> float:
    """Moment of inertia of all that turns with the shaft, about its axis.

    Rotor, eccentrics, counterweights, and rollers as masses on their centres.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    """
    roller, cylinder = machine.roller, machine.cylinder
    on_eccentrics = cylinder.number * (roller.mass_kg + roller.eccentric_mass_kg)
    weights = sum(map(abs, counterweight_moments(machine))) * machine.counterweights.radius_m
    turning = on_eccentrics * cylinder.eccentricity_m**2 + weights
    return machine.rotary_shaft.inertia_kg_m2 + turning


def counterweight_moments(machine: RollingPistonTables) -> tuple[float, float]:
    """Mass moments of the counterweights in the upper and lower plane, kg m.

    The share `balanced_ratio` of what cancels force and couple of eccentrics and rollers; a
    negative one is opposite the first eccentric.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    """
    roller, planes = machine.roller, machine.counterweights
    moment = (roller.mass_kg + roller.eccentric_mass_kg) * machine.cylinder.eccentricity_m
    stations = machine.cylinder.stations
    moments = [moment * float(np.cos(lead)) for lead, _ in stations]
    heights = [height for _, height in stations]
    ends = planes.upper_height_m, planes.lower_height_m
    upper, lower = two_plane_balance(moments, heights, *ends)
    return planes.balanced_ratio * upper, planes.balanced_ratio * lower


@lru_cache(KEPT_CYCLES)
def steady_cycle(
    machine: RollingPistonTables, speed_rpm: float, samples: int = SAMPLES
) -> RollingPistonCycle:
    """Solve shaft, rollers and vanes together by iteration; the gas is that of the mean speed.

    J ω' = M - L with a constant J: the vane's inertia is part of the load L.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : uniform crank angles, an even number

    Raises
    ------
    ParameterError
        The inertia does not carry the shaft through a turn, or the current not the load.
    SolverError
        Reed, vane, roller or the iteration do not repeat.
    """
    omega = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    gas = gas_of(machine, speed_rpm, samples)
    inertia = np.full(samples, inertia_kg_m2(machine))
    rotation = DrivenRotation(np.full(samples, omega), np.zeros(samples), np.zeros(samples))
    contacts = tuple(first_contact(machine, gas, omega) for _ in machine.cylinder.stations)
    load: Array = np.zeros(samples)
    for _ in range(ITERATIONS):
        contacts = tuple(
            contact_turn(machine, gas, _of_cylinder(rotation, number), contact)
            for number, contact in enumerate(contacts)
        )
        before, load = load, journal_drag_n_m_s(machine) * rotation.speed_rad_per_s
        for number, contact in enumerate(contacts):
            load = load + np.roll(contact.load_n_m, -number * (samples // 2))
        control = control_torque_n_m(machine.drive, load)
        slope = machine.drive.motor_slope_ratio
        driven = steady_rotation(inertia, np.zeros(samples), load - control, omega, slope)
        rotation = DrivenRotation(
            driven.speed_rad_per_s, driven.acceleration_rad_per_s2,
            driven.motor_torque_n_m + control,
        )  # fmt: skip
        if np.max(np.abs(load - before)) <= LOAD_TOLERANCE * np.max(np.abs(load)):
            return RollingPistonCycle(rotation, gas, contacts, load)
    raise SolverError(f"rolling piston at {speed_rpm:g} rpm: vane and roller do not converge")


def _of_cylinder(rotation: Rotation, number: int) -> Rotation:
    """The shaft's rotation over the own angle of a cylinder, the second half a turn ahead."""
    shift = number * (rotation.speed_rad_per_s.size // 2)
    return Rotation(
        np.roll(rotation.speed_rad_per_s, shift), np.roll(rotation.acceleration_rad_per_s2, shift)
    )
