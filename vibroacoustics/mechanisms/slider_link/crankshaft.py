"""Slider-link mechanism: forces on slider and crankshaft, and the crank's equation of motion."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.constants import STANDARD_GRAVITY_M_PER_S2
from ...base.errors import SolverError
from .bearing_friction import journal_friction_moment, thrust_friction_moment
from .parameters import SliderLinkTables
from .piston import (
    CrankState,
    PistonContacts,
    engaged_length,
    gas_force,
    piston_contacts,
    piston_film_force,
    piston_matrix,
)

MAXIMUM_ITERATIONS: Final = 100
CONVERGED: Final = 1e-12
"""Change of the angular acceleration and of the crank pin's friction moment, relative."""


@dataclass(frozen=True)
class CrankForces:
    """Forces inside the machine over crank angle, N and N m, in the paper's frame.

    Attributes
    ----------
    gas : F_g (1), on the piston towards -x, shape (samples,)
    film : F_FG (7), on the piston along x, shape (samples,)
    contacts : constraint forces on the piston
    crank_pin : F_kx, F_ky (17), on the slider, shape (2, samples)
    upper_bearing, lower_bearing : F_a, F_b (30), on the crankshaft, shape (2, samples)
    friction_moments : M_k, M_a, M_b, M_t, M_p by name, against the rotation
    """

    gas: Array
    film: Array
    contacts: PistonContacts
    crank_pin: Array
    upper_bearing: Array
    lower_bearing: Array
    friction_moments: dict[str, Array]


def crank_pin_force(
    machine: SliderLinkTables, state: CrankState, contacts: PistonContacts
) -> Array:
    """Oil film force of the crank pin on the slider (17), shape (2, samples), N.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    contacts : constraint forces on the piston
    """
    mass_moment = machine.masses.slider_mass_kg * machine.mechanism.crank_radius_m
    rubbing = contacts.slider_sense * contacts.sides[:, 2] * machine.mechanism.link_friction_ratio
    return np.stack(
        [
            contacts.link - mass_moment * state.along,
            rubbing * contacts.link - mass_moment * state.across,
        ]
    )


def bearing_forces(
    machine: SliderLinkTables, state: CrankState, crank_pin: Array
) -> tuple[Array, Array]:
    """Forces of upper and lower bearing on the crankshaft (27) to (30), shape (2, samples), N.

    From the moments about the centre of the lower bearing; the second row of (28) and of (30) is
    printed with wrong signs, table 2 is right.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    crank_pin : force of the crank pin on the slider, shape (2, samples), N
    """
    masses, heights = machine.masses, machine.heights
    turning = np.stack([state.along, state.across])
    inertia = -masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m * turning  # (25)
    # Below the origin by this much; M_Ry and -M_Rx of (26) are J_x'z times a and b.
    lower = heights.upper_bearing_m + heights.bearing_distance_m - heights.piston_axis_m
    couple = masses.crankshaft_product_kg_m2 * turning - lower * inertia
    arm = heights.upper_bearing_m + heights.bearing_distance_m
    upper_force = (crank_pin * arm + couple) / heights.bearing_distance_m
    return upper_force, crank_pin - inertia - upper_force


def crank_forces(
    machine: SliderLinkTables, state: CrankState, tilting_friction_n_m: Array
) -> CrankForces:
    """All forces of one motion of the crank.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    tilting_friction_n_m : M_k, shape (samples,), which the slider passes on to the link
    """
    mechanism, masses, oil = machine.mechanism, machine.masses, machine.oil
    gas = gas_force(mechanism, machine.gas, state.angle)
    film = piston_film_force(mechanism, oil.viscosity_pa_s, state)
    inertia = -masses.piston_mass_kg * mechanism.crank_radius_m * state.along  # m_p ẍ_p
    tilting = inertia * mechanism.piston_mass_offset_m + tilting_friction_n_m
    contacts = piston_contacts(mechanism, state, gas - film + inertia, tilting)
    crank_pin = crank_pin_force(machine, state, contacts)
    upper, lower = bearing_forces(machine, state, crank_pin)
    loads = {"crank_pin": crank_pin, "upper": upper, "lower": lower}
    moments = {
        name: journal_friction_moment(
            getattr(machine.bearings, name), np.hypot(*load), state.velocity, oil.viscosity_pa_s
        )
        for name, load in loads.items()
    }
    weight = masses.crankshaft_mass_kg * STANDARD_GRAVITY_M_PER_S2
    thrust = thrust_friction_moment(machine.bearings.thrust, weight)
    moments["thrust"] = np.full_like(gas, thrust)
    moments["oil_pump"] = np.full_like(gas, oil.pump_moment_n_m)
    return CrankForces(gas, film, contacts, crank_pin, upper, lower, moments)


def crank_coefficients(
    machine: SliderLinkTables, angle: Array, contacts: PistonContacts
) -> tuple[Array, Array, Array, Array]:
    """γ4, γ5, γ6 of (34), kg m² and m, and the factor of the slider's moment on the link.

    The last one comes with the moment M_b that the paper neglects: the crank pin's friction
    moment, passed on to the link, acts back on the crank with this factor.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    angle : crank angle, shape (samples,), rad
    contacts : signs of the constraint forces on the piston
    """
    mechanism, masses = machine.mechanism, machine.masses
    radius = mechanism.crank_radius_m
    matrix = piston_matrix(
        mechanism, angle, contacts.sides, contacts.piston_sense, contacts.slider_sense
    )
    first = 1.0 / np.linalg.det(matrix)
    third = engaged_length(mechanism, angle)
    sides = contacts.sides[:, 0] - contacts.sides[:, 1]
    pinch = contacts.piston_sense * mechanism.cylinder_friction_ratio * sides
    second = third + pinch * mechanism.piston_mass_offset_m
    rubbing = contacts.slider_sense * contacts.sides[:, 2] * mechanism.link_friction_ratio
    arm = np.sin(angle) - rubbing * np.cos(angle)
    carried = first * second * masses.piston_mass_kg
    fourth = radius**2 * (carried * np.sin(angle) * arm + masses.slider_mass_kg)
    fifth = radius**2 * carried * np.cos(angle) * arm
    return fourth, fifth, -radius * first * third * arm, -radius * first * pinch * arm


def crank_acceleration(
    machine: SliderLinkTables, state: CrankState, forces: CrankForces, motor_torque_n_m: Array
) -> Array:
    """Angular acceleration of the crank (35), rad/s², with J_z for I_z and M_p for M_s.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank; its acceleration has shaped the forces
    forces : forces of that motion
    motor_torque_n_m : M_v, shape (samples,)
    """
    fourth, fifth, sixth, passed = crank_coefficients(machine, state.angle, forces.contacts)
    resisting = (
        fifth * state.velocity**2
        + sum(forces.friction_moments.values())
        + sixth * (forces.gas - forces.film)
        + passed * forces.friction_moments["crank_pin"]
    )
    inertia = fourth + machine.masses.crankshaft_inertia_kg_m2
    return np.asarray((motor_torque_n_m - resisting) / inertia)


def settled(
    machine: SliderLinkTables, angle: Array, velocity: Array, motor_torque_n_m: Array
) -> tuple[CrankState, CrankForces]:
    """Acceleration and forces that agree with each other at given angles and velocities.

    (35) is implicit: bearing friction and the sides that the piston touches depend on the
    acceleration. Iterated; each step shrinks the error by about the ratio of the friction's
    radius to the crank's times that of the masses, 1e-3.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    angle, velocity : angle and velocity of the crank, rad and rad/s, shape (samples,)
    motor_torque_n_m : M_v, shape (samples,)

    Raises
    ------
    SolverError
        No convergence.
    """
    state = CrankState(angle, velocity, np.zeros_like(angle))
    friction = np.zeros_like(angle)
    for _ in range(MAXIMUM_ITERATIONS):
        forces = crank_forces(machine, state, friction)
        acceleration = crank_acceleration(machine, state, forces, motor_torque_n_m)
        change = np.max(np.abs(acceleration - state.acceleration)) / np.max(np.abs(acceleration))
        rubbed = forces.friction_moments["crank_pin"]
        change = max(change, np.max(np.abs(rubbed - friction)) / np.max(rubbed))
        if change < CONVERGED:
            return state, forces
        state, friction = CrankState(angle, velocity, acceleration), rubbed
    raise SolverError(
        f"slider-link crank: its acceleration still changes by {change:.1e} after "
        f"{MAXIMUM_ITERATIONS} iterations"
    )
