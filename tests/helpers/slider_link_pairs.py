"""Second ways to what the slider-link compressor computes: pairs of forces, a free block."""

import numpy as np

from vibroacoustics.base.arrays import Array
from vibroacoustics.machine.housing import Housing
from vibroacoustics.mechanics.moving_parts import Wrench
from vibroacoustics.mechanisms.slider_link.bearing_friction import _checked
from vibroacoustics.mechanisms.slider_link.crankshaft import CrankForces
from vibroacoustics.mechanisms.slider_link.machine import SliderLinkMachine
from vibroacoustics.mechanisms.slider_link.piston import CrankState, engaged_length
from vibroacoustics.mechanisms.slider_link.revolution import _wrench


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


def _at(force: Array, x: Array, y: Array | float, z: Array | float) -> Wrench:
    """A force at a place, with its moment about the origin."""
    place = np.stack(np.broadcast_arrays(x, y, z))
    return Wrench(force, np.cross(place, force, axis=0))


def short_bearing_load(eccentricity_ratio: Array, length_per_diameter: float) -> Array:
    """Load coefficient Φ_p (22) = ψ² F / (η ω l d) of a short bearing.

    The paper leaves the function open; this is Ocvirk's (NACA TN 2808, 1952): half of
    (l/d)² π ε √(0.6211 ε² + 1) / (1 - ε²)².

    Parameters
    ----------
    eccentricity_ratio : from 0 to below 1
    length_per_diameter : l/d

    Raises
    ------
    ParameterError
        The eccentricity is outside its range.
    """
    ratio = _checked(eccentricity_ratio)
    clear = 1.0 - ratio**2
    root = np.sqrt(np.pi**2 * clear + 16.0 * ratio**2)
    return np.asarray(0.5 * length_per_diameter**2 * ratio * root / clear**2)
