"""Slider-link mechanism: unbalanced forces and moments on the block, and its free vibration."""

import numpy as np

from ...base.arrays import Array
from ...machine.housing import Housing
from ...mechanics.moving_parts import Wrench
from .crankshaft import CrankForces
from .machine import SliderLinkMachine
from .piston import CrankState, engaged_length


def unbalance(machine: SliderLinkMachine, state: CrankState) -> dict[str, Wrench]:
    """Unbalanced forces and moments about the origin O (25), (26), (36) to (40), paper's frame.

    By source: -Σ m a and -Σ r x m a of piston, slider and crankshaft. The slider's moment about
    the shaft has R², which (39) and (40) print as R. `Wrench.placed` takes them to the block's
    centre of mass (41).

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    """
    masses, mechanism = machine.masses, machine.mechanism
    radius, height = mechanism.crank_radius_m, machine.heights.piston_axis_m
    turning, zero = np.stack([state.along, state.across]), np.zeros_like(state.angle)
    piston = masses.piston_mass_kg * radius * state.along
    slider = masses.slider_mass_kg * radius * turning
    shaft = -masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m * turning
    couple = masses.crankshaft_product_kg_m2 * turning
    arm = mechanism.link_offset_m - mechanism.piston_mass_offset_m
    slider_spin = -masses.slider_mass_kg * radius**2 * state.acceleration
    shaft_spin = -masses.crankshaft_inertia_kg_m2 * state.acceleration
    return {
        "piston": _wrench((piston, zero, zero), (zero, -height * piston, arm * piston)),
        "slider": _wrench((*slider, zero), (height * slider[1], -height * slider[0], slider_spin)),
        "crankshaft": _wrench((*shaft, zero), (-couple[1], couple[0], shaft_spin)),
    }


def free_acceleration(block: Housing, load: Array) -> Array:
    """Acceleration of a block on soft springs (43), [M]⁻¹ [F], m/s² and rad/s².

    Parameters
    ----------
    block : mass and principal moments of inertia
    load : force and moment about the centre of mass, shape (6, ...), N and N m
    """
    inertia = (block.inertia_xx_kg_m2, block.inertia_yy_kg_m2, block.inertia_zz_kg_m2)
    return np.asarray((load.T / np.array([block.mass_kg] * 3 + list(inertia))).T)


def internal_forces(
    machine: SliderLinkMachine, state: CrankState, forces: CrankForces, motor_torque_n_m: Array
) -> dict[str, Wrench]:
    """Force and moment about O of each internal pair on the block, by source, paper's frame.

    Gas, contacts, bearings and motor load the block's structure. Their sum is that of
    `unbalance`; they are not added to it.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    forces : of that motion
    motor_torque_n_m : M_v
    """
    mechanism, heights, contacts = machine.mechanism, machine.heights, forces.contacts
    axis, height = -mechanism.link_offset_m, -heights.piston_axis_m
    upper = height + heights.upper_bearing_m
    reach = mechanism.piston_length_m + mechanism.crank_radius_m * np.cos(state.angle)
    zero = np.zeros_like(state.angle)
    friction = contacts.piston_sense * mechanism.cylinder_friction_ratio
    side = 0.5 * mechanism.bore_m

    def contact(normal: Array, sense: Array, place: Array) -> Wrench:
        force = -np.stack([friction * sense * normal, normal, zero])
        return _at(force, place, axis - side * sense, height)

    rear_place = reach - engaged_length(mechanism, state.angle)
    bearings = {
        f"{name}_bearing": _at(np.stack([-force[0], -force[1], zero]), zero, 0.0, place)
        for name, force, place in (
            ("upper", forces.upper_bearing, upper),
            ("lower", forces.lower_bearing, upper + heights.bearing_distance_m),
        )
    }
    drag = sum(
        moment for name, moment in forces.friction_moments.items() if name != "crank_pin"
    )  # the crank pin's is passed on through slider, link and piston
    return {
        "gas": _at(np.stack([forces.gas, zero, zero]), zero, axis, height),
        "piston_film": _at(np.stack([-forces.film, zero, zero]), zero, axis, height),
        "piston_front": contact(contacts.front, contacts.sides[:, 0], reach),
        "piston_rear": contact(contacts.rear, contacts.sides[:, 1], rear_place),
        **bearings,
        "bearing_friction": _wrench((zero, zero, zero), (zero, zero, zero + drag)),
        "motor": _wrench((zero, zero, zero), (zero, zero, -motor_torque_n_m)),
    }


def _wrench(force: tuple[Array, ...], moment: tuple[Array, ...]) -> Wrench:
    return Wrench(np.stack(force), np.stack(moment))


def _at(force: Array, x: Array, y: Array | float, z: Array | float) -> Wrench:
    """A force at a place, with its moment about the origin."""
    place = np.stack(np.broadcast_arrays(x, y, z))
    return Wrench(force, np.cross(place, force, axis=0))
