"""Results of a steady cycle of the hermetic compressor: motion, joint forces, energy."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...base.constants import STANDARD_GRAVITY_M_PER_S2
from .gas import gas_force_n
from .journal_bearing import film_coordinates, highest_pressure_pa
from .periodic_collocation import PeriodicSolution
from .pin import MechanismMotion, mechanism_motion
from .shaft import ShaftEquations


@dataclass(frozen=True)
class BearingCycle:
    """One journal bearing over the crank angle.

    Attributes
    ----------
    orbit_m : journal centre from the bearing's, shape (angles, 2)
    force_n : force of the film on the journal, shape (angles, 2)
    thinnest_film_m : shape (angles,)
    highest_pressure_pa : highest pressure of the short film, shape (angles,)
    """

    orbit_m: Array
    force_n: Array
    thinnest_film_m: Array
    highest_pressure_pa: Array


def bearing_cycles(equations: ShaftEquations, states: Array) -> tuple[BearingCycle, ...]:
    """Orbit, force, film and pressure of each bearing from states (angles, 2n + 1)."""
    displacement, velocity, speed = equations.split(states)
    bearing, forces = equations.machine.bearing, equations.film_forces(states)
    cycles = []
    for dof, force in zip(equations.shaft.bearing_dofs, np.moveaxis(forces, -2, 0), strict=True):
        orbit, moving = displacement[..., dof : dof + 2], velocity[..., dof : dof + 2]
        eccentricity, _, _ = film_coordinates(bearing, orbit, moving, speed)
        cycles.append(
            BearingCycle(
                orbit,
                force,
                bearing.clearance_m * (1.0 - eccentricity),
                highest_pressure_pa(bearing, orbit, moving, speed),
            )
        )
    return tuple(cycles)


def motion_of(equations: ShaftEquations, angle: Array, states: Array) -> MechanismMotion:
    """Motion and joint forces of the mechanism at states that solve the equations."""
    coordinates, rates = equations.crank_coordinates(angle, states)
    second = np.zeros_like(coordinates)
    accelerations = equations.accelerations(angle, states)
    second[..., list(equations.shaft.free)] = accelerations[..., equations.shaft.crank_indices]
    gas = gas_force_n(equations.machine, angle)
    return mechanism_motion(equations.machine, coordinates, rates, second, gas)


def support_reaction(equations: ShaftEquations, angle: Array, states: Array) -> Array:
    """Return the reaction that holds x, y, β and Γ of the crank where fixed (Estupiñan fig. 7).

    Returns
    -------
    forces in N and moments in N m on the crank, zero for free coordinates, shape (angles, 4)
    """
    reaction = -motion_of(equations, angle, states).shaft_load[..., :4]
    reaction[..., [freedom for freedom in equations.shaft.free if freedom < 4]] = 0.0
    return reaction


def works_per_cycle_j(equations: ShaftEquations, solution: PeriodicSolution) -> Mapping[str, float]:
    """Work of gas, motor, oil films and weight per revolution, J; their sum is zero.

    The powers over the shaft speed are integrated over the crank angle at the collocation points.
    """
    angle, states = solution.stage_angles, solution.stages
    machine, (_, velocity, speed) = equations.machine, equations.split(states)
    motion = motion_of(equations, angle, states)
    _, rates = equations.crank_coordinates(angle, states)
    films = np.moveaxis(equations.film_forces(states), -2, 0)
    film_power = np.zeros_like(speed)
    for dof, force in zip(equations.shaft.bearing_dofs, films, strict=True):
        film_power += np.sum(force * velocity[..., dof : dof + 2], axis=-1)
    weight = -machine.crank.mass_kg * STANDARD_GRAVITY_M_PER_S2
    powers = {
        "gas": -gas_force_n(machine, angle) * motion.rod.piston_velocity,
        "motor": equations.motor_torque(speed) * speed,
        "films": film_power,
        "weight": motion.joints.rod_on_crank[..., 2] * motion.pin.velocity(rates)[..., 2]
        + weight * motion.mass_centre.velocity(rates)[..., 2],
    }
    return {name: float(solution.cycle_integral(power / speed)) for name, power in powers.items()}
