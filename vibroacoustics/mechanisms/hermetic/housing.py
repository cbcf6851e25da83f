"""Force and moment of the hermetic compressor's moving parts on the housing, by source."""

import numpy as np

from ...base.arrays import Array
from ...mechanics.beam_rotor import NODE_FREEDOMS
from ...mechanics.moving_parts import Wrench, path
from .results import motion_of
from .shaft import ShaftEquations, node_positions_m


def housing_wrenches(equations: ShaftEquations, angle: Array, states: Array) -> dict[str, Wrench]:
    """Change of momentum of piston, rod, crank and rotor, with the sign of its reaction.

    In the paper's frame; the moment is about the crank's centre at rest. The rod swings in the
    plane of the pin's middle, as in the paper.

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
    side = machine.piston.cylinder_offset_m
    piston_x = rod.piston_position_m
    rod_x, rod_y = rod.centre_acceleration(machine.rod)
    return {
        "piston": _wrench(
            machine.piston.mass_kg,
            path(piston_x, side, height),
            path(rod.piston_acceleration, 0.0, 0.0),
            np.zeros_like(spin),
        ),
        "connecting_rod": _wrench(
            machine.rod.mass_kg,
            path(piston_x - distance * rod.cosine, side + distance * rod.sine, height),
            path(rod_x, rod_y, 0.0),
            machine.rod.inertia_kg_m2 * rod.angular_acceleration,  # α turns against θ
        ),
        "crank": _wrench(
            machine.crank.mass_kg,
            motion.mass_centre.position_m.T,
            motion.mass_centre_acceleration.T,
            -machine.crank.axial_inertia_kg_m2 * spin,
        ),
        "rotor": _rotor_wrench(equations, states, accelerations),
    }


def _rotor_wrench(equations: ShaftEquations, states: Array, accelerations: Array) -> Wrench:
    """Change of the shaft's and rotor's momentum, with the sign of its reaction.

    The gyroscopic part is that of an angular momentum about the shaft that tilts.
    """
    matrices, (_, velocity, speed) = equations.shaft.matrices, equations.split(states)
    spin_moment = _axial(-equations.machine.rotor.axial_inertia_kg_m2 * accelerations[..., -1])
    if equations.shaft.freedoms < NODE_FREEDOMS:  # no rotor in the lateral equations
        return Wrench(np.zeros_like(spin_moment), spin_moment)
    change = accelerations[..., :-1] @ matrices.mass
    change += speed[..., np.newaxis] * (velocity @ matrices.gyroscopic.T)
    x, y, about_x, about_y = np.moveaxis(-change @ _rigid_motions(equations), -1, 0)
    return Wrench(path(x, y, 0.0), spin_moment + path(about_x, about_y, 0.0))


def _rigid_motions(equations: ShaftEquations) -> Array:
    """Displacements of all nodes for unit x, y, θx, θy about the crank's centre."""
    motions = [np.eye(NODE_FREEDOMS) for _ in node_positions_m(equations.machine)]
    for motion, height in zip(motions, node_positions_m(equations.machine), strict=True):
        motion[0, 3], motion[1, 2] = height, -height
    return np.concatenate(motions)


def _wrench(mass_kg: float, position: Array, acceleration: Array, spin_moment: Array) -> Wrench:
    force = -mass_kg * acceleration
    return Wrench(force, np.cross(position, force, axis=0) + _axial(spin_moment))


def _axial(moment: Array) -> Array:
    return path(0.0, 0.0, moment)
