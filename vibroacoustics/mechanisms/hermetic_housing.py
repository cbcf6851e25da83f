"""Force and moment of the hermetic compressor's moving parts on the housing, by source."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..moving_parts import Array
from .beam_rotor import NODE_FREEDOMS
from .hermetic_results import motion_of
from .hermetic_shaft import ShaftEquations


@dataclass(frozen=True)
class Wrench:
    """Force, N, and moment about the crank's centre at rest, N m, shape (angles, 3) each."""

    force_n: Array
    moment_n_m: Array


def housing_wrenches(
    equations: ShaftEquations, angle: Array, states: Array
) -> Mapping[str, Wrench]:
    """Change of momentum of piston, rod, crank and rotor, with the sign of its reaction.

    Left out are the moments of the shaft's bending and tilt, micrometres over its length.

    Parameters
    ----------
    equations : of the case
    angle : crank angle, rad, shape (angles,)
    states : of the periodic solution there, shape (angles, 2n + 1)

    Returns
    -------
    wrench by source
    """
    machine, motion = equations.machine, motion_of(equations, angle, states)
    accelerations, rod = equations.accelerations(angle, states), motion.rod
    spin = accelerations[..., -1]
    distance, height = machine.rod.centre_of_mass_m, -machine.crank.pin_offset_m
    piston_x = rod.piston_position_m
    rod_x, rod_y = rod.centre_acceleration(machine.rod)
    rotor_force = np.stack(_stacked(*_rotor_force(equations, accelerations)), axis=-1)
    no_moment = np.zeros_like(rotor_force)
    return {
        "piston": _wrench(
            machine.piston.mass_kg,
            _stacked(piston_x, 0.0, height),
            _stacked(rod.piston_acceleration, 0.0, 0.0),
            np.zeros_like(spin),
        ),
        "rod": _wrench(
            machine.rod.mass_kg,
            _stacked(piston_x - distance * rod.cosine, distance * rod.sine, height),
            _stacked(rod_x, rod_y, 0.0),
            machine.rod.inertia_kg_m2 * rod.angular_acceleration,  # α turns against θ
        ),
        "crank": _wrench(
            machine.crank.mass_kg,
            tuple(np.moveaxis(motion.mass_centre.position_m, -1, 0)),
            tuple(np.moveaxis(motion.mass_centre_acceleration, -1, 0)),
            -machine.crank.axial_inertia_kg_m2 * spin,
        ),
        "rotor": Wrench(rotor_force, no_moment + _axial(-machine.rotor.axial_inertia_kg_m2 * spin)),
    }


def _rotor_force(equations: ShaftEquations, accelerations: Array) -> tuple[Array, Array, Array]:
    """Change of the flexible shaft's momentum in x and y, with the sign of its reaction, N."""
    forces = accelerations[..., :-1] @ equations.shaft.matrices.mass
    nodes = range(0, equations.shaft.freedoms, NODE_FREEDOMS)
    x, y = (-forces[..., [at + axis for at in nodes]].sum(axis=-1) for axis in (0, 1))
    return x, y, np.zeros_like(x)


def _wrench(
    mass_kg: float, place: tuple[Array, ...], acceleration: tuple[Array, ...], spin_moment: Array
) -> Wrench:
    force = -mass_kg * np.stack(acceleration, axis=-1)
    return Wrench(force, np.cross(np.stack(place, axis=-1), force) + _axial(spin_moment))


def _axial(moment: Array) -> Array:
    return np.asarray(moment[..., np.newaxis] * np.array([0.0, 0.0, 1.0]))


def _stacked(x: Array, y: Array | float, z: Array | float) -> tuple[Array, ...]:
    return tuple(np.broadcast_arrays(x, y, z))
