"""The hermetic compressor as the chain takes it: force and moment by source."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...mechanics.beam_rotor import NODE_DOFS
from ...mechanics.crankshaft import every
from ...mechanics.moving_parts import Revolution, Wrench, path
from ...mechanics.rotation import Rotation
from .cycle import (
    bearing_cycles,
    cycle_at_speed,
    mean_speed_rad_per_s,
    motion_of,
    support_reaction,
    uniform_samples,
    works_per_cycle_j,
)
from .parameters import HermeticTables
from .periodic_collocation import PeriodicSolution
from .shaft import ShaftEquations, node_positions_m

LEAST_STEPS: Final = 144
"""Against 720 steps the first 20 orders of case III err by 0.02 N and 1 mN m."""


def hermetic_revolution(machine: HermeticTables, speed_rpm: float, samples: int) -> Revolution:
    """Steady revolution of piston, rod, crank and rotor under gas and oil films.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    speed_rpm : mean over time
    samples : crank angles of the revolution
    """
    stride = -(-LEAST_STEPS // samples)
    equations, solution = cycle_at_speed(machine, speed_rpm, samples * stride)
    angle, states = uniform_samples(solution, samples * stride)
    rotation = Rotation(states[:, -1], equations.accelerations(angle, states)[:, -1])
    wrenches = housing_wrenches(equations, angle, states)
    facts = {
        "speed_fluctuation_percent": 100.0 * rotation.fluctuation_ratio,
        **_drive_facts(equations, solution),
        **_bearing_facts(equations, solution),
    }
    return every(
        stride,
        speed_rpm,
        rotation,
        {name: wrench.placed(machine.crank_frame) for name, wrench in wrenches.items()},
        facts,
    )


def _drive_facts(equations: ShaftEquations, solution: PeriodicSolution) -> Mapping[str, float]:
    works = works_per_cycle_j(equations, solution)
    forces = motion_of(equations, solution.mesh, solution.states).joints
    supply = equations.machine.motor.synchronous_speed_rad_per_s
    return {
        "shaft_power_w": works["motor"] * mean_speed_rad_per_s(solution) / (2.0 * np.pi),
        "supply_frequency_hz": supply / (2.0 * np.pi),
        "largest_piston_side_force_n": float(np.max(np.abs(forces.wall_on_piston[..., 1]))),
    }


def _bearing_facts(equations: ShaftEquations, solution: PeriodicSolution) -> Mapping[str, float]:
    """Largest load of each bearing, its thinnest film and where, its highest pressure."""
    if equations.machine.case == "I":  # the crank is held, without a film
        held = support_reaction(equations, solution.mesh, solution.states)[..., :2]
        return {"upper_bearing_largest_load_n": float(np.max(np.linalg.norm(held, axis=-1)))}
    facts: dict[str, float] = {}
    cycles = bearing_cycles(equations, solution.states)
    for name, bearing in zip(("upper", "lower"), cycles, strict=False):  # one bearing in case II
        thinnest = int(np.argmin(bearing.thinnest_film_m))
        where = np.rad2deg(solution.mesh[thinnest])
        facts |= {
            f"{name}_bearing_largest_load_n": float(
                np.max(np.linalg.norm(bearing.force_n, axis=-1))
            ),
            f"{name}_bearing_thinnest_film_um": 1e6 * float(bearing.thinnest_film_m[thinnest]),
            f"{name}_bearing_thinnest_film_at_deg": float(where),
            f"{name}_bearing_highest_pressure_mpa": 1e-6 * float(bearing.highest_pressure_pa.max()),
        }
    return facts


def housing_wrenches(equations: ShaftEquations, angle: Array, states: Array) -> dict[str, Wrench]:
    """Change of momentum of piston, rod, crank and rotor, with the sign of its reaction.

    In the paper's frame; the moment is about the crank's centre at rest. The rod swings in the
    plane of the pin's middle, as in the paper.

    Parameters
    ----------
    equations : equations of the case
    angle : crank angle, rad, shape (angles,)
    states : states of the periodic solution there, shape (angles, 2n + 1)

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
    if equations.shaft.dof_count < NODE_DOFS:  # no rotor in the lateral equations
        return Wrench(np.zeros_like(spin_moment), spin_moment)
    change = accelerations[..., :-1] @ matrices.mass
    change += speed[..., np.newaxis] * (velocity @ matrices.gyroscopic.T)
    x, y, about_x, about_y = np.moveaxis(-change @ _rigid_motions(equations), -1, 0)
    return Wrench(path(x, y, 0.0), spin_moment + path(about_x, about_y, 0.0))


def _rigid_motions(equations: ShaftEquations) -> Array:
    """Displacements of all nodes for unit x, y, θx, θy about the crank's centre."""
    motions = [np.eye(NODE_DOFS) for _ in node_positions_m(equations.machine)]
    for motion, height in zip(motions, node_positions_m(equations.machine), strict=True):
        motion[0, 3], motion[1, 2] = height, -height
    return np.concatenate(motions)


def _wrench(mass_kg: float, position: Array, acceleration: Array, spin_moment: Array) -> Wrench:
    force = -mass_kg * acceleration
    return Wrench(force, np.cross(position, force, axis=0) + _axial(spin_moment))


def _axial(moment: Array) -> Array:
    return path(0.0, 0.0, moment)
