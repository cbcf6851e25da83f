"""Slider-link mechanism: unbalanced forces and moments on the block, and its free vibration."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...moving_parts import Array
from ...parameters.housing import Housing
from ...parameters.slider_link import SliderLinkMachine
from .crankshaft import CrankForces
from .piston import CrankState, engaged_length

SOURCES: Final = ("piston", "slider", "crankshaft")
"""Who makes the force, in the order of the source axis."""


@dataclass(frozen=True)
class Unbalance:
    """Force and moment of the moving parts on the block, -Σ m a and -Σ r x m a.

    Attributes
    ----------
    force_n, moment_n_m : shape (source, 3, samples), in the order of SOURCES
    """

    force_n: Array
    moment_n_m: Array


def unbalance(machine: SliderLinkMachine, state: CrankState) -> Unbalance:
    """Unbalanced forces and moments about the origin O (25), (26), (36) to (40), paper's frame.

    The slider's moment about the shaft has R², which (39) and (40) print as R.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    """
    masses, mechanism = machine.masses, machine.mechanism
    radius, height = mechanism.crank_radius_m, machine.heights.piston_axis_m
    along, across, zero = state.along, state.across, np.zeros_like(state.angle)
    piston = masses.piston_mass_kg * radius * along
    slider = masses.slider_mass_kg * radius * np.stack([along, across])
    shaft = -masses.crankshaft_mass_kg * masses.crankshaft_mass_offset_m * np.stack([along, across])
    product = masses.crankshaft_product_kg_m2
    arm = mechanism.link_offset_m - mechanism.piston_mass_offset_m
    slider_spin = -masses.slider_mass_kg * radius**2 * state.acceleration
    shaft_spin = -masses.crankshaft_inertia_kg_m2 * state.acceleration
    force = [(piston, zero, zero), (*slider, zero), (*shaft, zero)]
    moment = [
        (zero, -height * piston, arm * piston),
        (height * slider[1], -height * slider[0], slider_spin),
        (-product * across, product * along, shaft_spin),
    ]
    return Unbalance(np.array(force), np.array(moment))


def about_centre_of_mass(machine: SliderLinkMachine, about_origin: Unbalance) -> Unbalance:
    """Moments about the block's centre of mass (41): M_Z = M_z - x_c F_y.

    Parameters
    ----------
    machine : lengths in m
    about_origin : of `unbalance`
    """
    moment = about_origin.moment_n_m.copy()
    moment[:, 2] -= machine.centre_of_mass_offset_m * about_origin.force_n[:, 1]
    return Unbalance(about_origin.force_n, moment)


def z_up(paper: Unbalance) -> Unbalance:
    """From the paper's frame, z down, to the toolkit's, z up: half a turn about x.

    Parameters
    ----------
    paper : in the paper's frame
    """
    turn = np.array([1.0, -1.0, -1.0])[:, None]
    return Unbalance(paper.force_n * turn, paper.moment_n_m * turn)


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
) -> dict[str, tuple[Array, Array]]:
    """Force and moment about O of each internal pair on the block, by source, paper's frame.

    Gas, contacts, bearings and motor load the block's structure. Their sum is that of
    `unbalance`; they are not added to it.

    Parameters
    ----------
    machine : masses in kg, lengths in m
    state : motion of the crank
    forces : of that motion
    motor_torque_n_m : M_v

    Returns
    -------
    wrenches : force and moment by source, each of shape (3, samples), N and N m
    """
    mechanism, heights, contacts = machine.mechanism, machine.heights, forces.contacts
    axis, height = -mechanism.link_offset_m, -heights.piston_axis_m
    upper = height + heights.upper_bearing_m
    reach = mechanism.piston_length_m + mechanism.crank_radius_m * np.cos(state.angle)
    zero = np.zeros_like(state.angle)
    friction = contacts.piston_sense * mechanism.cylinder_friction_ratio
    side = 0.5 * mechanism.bore_m

    def contact(normal: Array, sense: Array, place: Array) -> tuple[Array, Array]:
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
        "bearing_friction": (np.zeros((3, len(zero))), np.stack([zero, zero, zero + drag])),
        "motor": (np.zeros((3, len(zero))), np.stack([zero, zero, -motor_torque_n_m])),
    }


def _at(force: Array, x: Array, y: Array | float, z: Array | float) -> tuple[Array, Array]:
    """A force at a place, with its moment about the origin."""
    place = np.stack(np.broadcast_arrays(x, y, z))
    return force, np.cross(place, force, axis=0)
