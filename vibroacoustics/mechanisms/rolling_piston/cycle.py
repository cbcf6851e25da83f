"""Steady turn of the machine: gas, vane, roller, motor, speed of the shaft, bearing loads."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from ...mechanics.crankshaft import DrivenRotation, steady_rotation
from ...mechanics.moving_parts import MovingPart, circling, wrenches_of_parts
from ...mechanics.rotation import Rotation
from ...orders.spectrum import order_spectrum
from ..oldham_scroll.revolution import counterweight, two_plane_balance
from .contact import Contact, contact_turn, first_contact
from .gas import GasTurn, gas_of
from .parameters import Drive, RollingPistonTables
from .roller import journal_drag_n_m_s


def control_torque_n_m(drive: Drive, load_n_m: Array) -> Array:
    """Alternating torque with which an inverter follows the load's first orders, N m.

    Orders 1 to n of the load; all smaller by one factor where mean and control together would take
    more current than the drive has. Zero without a control.

    Parameters
    ----------
    drive : with its control
    load_n_m : torque against the rotation over uniform crank angles, shape (samples,)

    Raises
    ------
    ParameterError
        The current does not carry the mean load.
    """
    control = drive.control
    if control is None:
        return np.zeros_like(load_n_m)
    spectrum = np.fft.rfft(load_n_m)
    spectrum[0] = 0.0
    spectrum[control.highest_order + 1 :] = 0.0
    wave = np.asarray(np.fft.irfft(spectrum, n=load_n_m.size))
    if control.current_limit_a is None:
        return wave
    room = drive.torque_per_current_nm_per_a * control.current_limit_a - float(np.mean(load_n_m))
    if room < 0.0:
        needed = float(np.mean(load_n_m)) / drive.torque_per_current_nm_per_a
        raise ParameterError(
            f"current_limit_a = {control.current_limit_a:g} A: must be at least {needed:.4g} A, "
            "the current of the mean load"
        )
    return np.asarray(wave * min(1.0, room / max(float(np.max(wave)), np.finfo(float).tiny)))


def torque_orders_n_m(torque_n_m: Array, highest: int) -> Array:
    """Amplitudes of the orders 1 to `highest` over the crank angle, shape (highest,), N m.

    Parameters
    ----------
    torque_n_m : over uniform crank angles, shape (samples,)
    highest : order
    """
    return np.abs(order_spectrum(torque_n_m, highest)[1:])


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


def turning_parts(machine: RollingPistonTables, crank_angle: Array) -> list[MovingPart]:
    """Eccentrics, rollers as masses on their centres, and counterweights on their circles.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    crank_angle : shape (samples,), rad
    """
    radius, roller = machine.cylinder.eccentricity_m, machine.roller
    parts = [
        circling(name, mass, radius, height, crank_angle + lead)
        for lead, height in machine.cylinder.stations
        for name, mass in (("eccentric", roller.eccentric_mass_kg), ("roller", roller.mass_kg))
    ]
    planes = machine.counterweights
    ends = {"upper_counterweight": planes.upper_height_m,
            "lower_counterweight": planes.lower_height_m}  # fmt: skip
    for (name, height), moment in zip(ends.items(), counterweight_moments(machine), strict=True):
        parts.append(counterweight(name, moment, planes.radius_m, height, crank_angle))
    return parts


def bearing_forces_n(machine: RollingPistonTables, cycle: RollingPistonCycle) -> Array:
    """Forces of the shaft on main and sub bearing, along and across the vane.

    Gas and vane on the rollers less the inertia of all that circles, by the lever of two supports;
    the rotor is balanced about its axis and the shaft rigid.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    cycle : cycle of the machine

    Returns
    -------
    shape (2, 2, samples), N: bearing, axis, crank angle
    """
    turning = wrenches_of_parts(turning_parts(machine, cycle.rotation.crank_angle), cycle.rotation)
    force = sum(wrench.force_n[:2] for wrench in turning.values())
    # a force f at height z has the moment (-z f_y, z f_x)
    lever = sum(np.stack([each.moment_n_m[1], -each.moment_n_m[0]]) for each in turning.values())
    for number, (_, height) in enumerate(machine.cylinder.stations):
        on_roller = cycle.over_shaft(cycle.contacts[number].on_roller_n, number)
        force, lever = force + on_roller, lever + height * on_roller
    main, sub = (
        machine.rotary_shaft.main_bearing_height_m,
        machine.rotary_shaft.sub_bearing_height_m,
    )
    on_main = (lever - sub * force) / (main - sub)
    return np.stack([on_main, force - on_main])
