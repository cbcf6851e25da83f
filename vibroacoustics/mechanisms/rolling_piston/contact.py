"""Forces between roller, vane and slot of a cylinder over a turn."""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...mechanics.crankshaft import acceleration_of
from ...mechanics.rotation import Rotation, uniform_crank_angle
from .gas import GasTurn
from .geometry import gas_force, vane_extension
from .parameters import RollingPistonTables
from .roller import eccentric_drag_n_m_s, roller_spin
from .vane import (
    SLIP_M_PER_S,
    Impacts,
    jump_speed_rad_per_s,
    pressing_force_n,
    slot_reactions_n,
    vane_flight,
)


@dataclass(frozen=True)
class Contact:
    """Vane and roller over uniform angles of the contact with the bore; x along the vane.

    Attributes
    ----------
    extension : x of the roller at the vane and its derivatives, shape (3, samples)
    flight : acceleration of the vane off the roller, NaN in contact, shape (samples,), m/s²
    impacts : landings of the vane's tip
    jump_speed_rad_per_s : speed of the shaft above which the tip leaves
    vane_acceleration : inwards, shape (samples,), m/s²
    tip_n : normal force of the tip, negative where frozen flight and contact differ, shape
        (samples,)
    tip_friction_n : friction of the vane on the roller against the turned normal, shape (samples,)
    slot_n : across the vane at mouth and rear end, on the vane, shape (2, samples)
    slot_friction_n : against the vane's motion inwards, shape (samples,)
    on_roller_n : gas and tip, along and across the vane, shape (2, samples)
    spin_rad_per_s : speed of rotation of the roller, shape (samples,)
    spin_acceleration : acceleration of the rotation of the roller, shape (samples,), rad/s²
    rubbing_w : friction of tip and slot, shape (samples,)
    load_n_m : torque against the shaft, shape (samples,)
    """

    extension: Array
    flight: Array
    impacts: Impacts
    jump_speed_rad_per_s: float
    vane_acceleration: Array
    tip_n: Array
    tip_friction_n: Array
    slot_n: Array
    slot_friction_n: Array
    on_roller_n: Array
    spin_rad_per_s: Array
    spin_acceleration: Array
    rubbing_w: Array
    load_n_m: Array


def first_contact(machine: RollingPistonTables, gas: GasTurn, speed_rad_per_s: float) -> Contact:
    """Vane at constant speed without friction, from which the iteration starts.

    Where the tip leaves the roller is decided here once.

    Parameters
    ----------
    machine : with cylinder and vane
    gas : turn of the cylinder
    speed_rad_per_s : Ω
    """
    still = np.zeros(gas.compression_pa.size)
    extension = vane_extension(machine.cylinder, uniform_crank_angle(still.size))
    pressing = pressing_force_n(machine, gas.compression_pa, extension[0])
    flight, impacts = vane_flight(machine, pressing, extension, speed_rad_per_s)
    jump = jump_speed_rad_per_s(machine, pressing, extension[2])
    pair = np.zeros((2, still.size))
    return Contact(extension, flight, impacts, jump, still, still, still, pair, still, pair, still,
                   still, still, still)  # fmt: skip


def normal_angle(machine: RollingPistonTables, angle: Array) -> tuple[Array, Array]:
    """Sine and cosine of the angle α between the roller's normal at the tip and the vane.

    Parameters
    ----------
    machine : with its cylinder
    angle : θ, shape (samples,), rad
    """
    cylinder = machine.cylinder
    sine = cylinder.eccentricity_m * np.sin(angle) / cylinder.roller_radius_m
    return sine, np.sqrt(1.0 - sine**2)


def contact_turn(
    machine: RollingPistonTables, gas: GasTurn, rotation: Rotation, before: Contact
) -> Contact:
    """Forces at the rotation given, with the slot's friction of the iteration before.

    Parameters
    ----------
    machine : with cylinder, vane, roller and oil
    gas : turn of the cylinder
    rotation : rotation of the shaft over the cylinder's own angle
    before : result of the last iteration, or `first_contact`
    """
    cylinder, vane = machine.cylinder, machine.vane
    angle, (x, slope, _) = rotation.crank_angle, before.extension
    speed = rotation.speed_rad_per_s
    kinematic = acceleration_of(before.extension, rotation)
    acceleration = np.where(np.isnan(before.flight), kinematic, before.flight)
    axial = pressing_force_n(machine, gas.compression_pa, x) - vane.mass_kg * acceleration
    axial = axial - before.slot_friction_n
    sine, cosine = normal_angle(machine, angle)
    slide = cylinder.eccentricity_m * speed * np.cos(angle) / cosine
    spin, spin_acceleration = roller_spin(machine, speed, axial, (sine, cosine), slide)
    slide = slide + cylinder.roller_radius_m * spin
    share = vane.tip_friction_ratio * np.tanh(slide / SLIP_M_PER_S)
    tip = axial / (cosine + share * sine)
    friction = share * tip
    difference = gas.compression_pa - machine.gas.suction_pressure_pa
    tip_on_roller = -np.stack([cosine * tip + sine * friction, cosine * friction - sine * tip])
    on_roller = gas_force(cylinder, angle, difference) + tip_on_roller
    slot = slot_reactions_n(machine, x, difference * cylinder.height_m * x, -tip_on_roller[1])
    against = vane.slot_friction_ratio * np.tanh(slope * speed / SLIP_M_PER_S)
    slot_friction = against * (np.abs(slot[0]) + np.abs(slot[1]))
    moment = np.cos(angle) * on_roller[1] - np.sin(angle) * on_roller[0]
    film = eccentric_drag_n_m_s(machine) * (speed - spin)
    return Contact(
        before.extension,
        before.flight,
        before.impacts,
        before.jump_speed_rad_per_s,
        acceleration,
        tip,
        friction,
        np.stack(slot),
        slot_friction,
        on_roller,
        spin,
        spin_acceleration,
        friction * slide + slot_friction * slope * speed,
        film - cylinder.eccentricity_m * moment,
    )
