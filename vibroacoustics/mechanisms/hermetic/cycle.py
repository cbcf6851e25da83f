"""Steady cycle of a hermetic reciprocating compressor: the periodic motion, found directly."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.constants import STANDARD_GRAVITY_M_PER_S2
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from .gas import gas_force_n, valve_angles
from .journal_bearing import FilmForce, film_coordinates, highest_pressure_pa, positive_film_force
from .parameters import HermeticTables
from .periodic_collocation import PeriodicSolution, periodic_solution
from .pin import MechanismMotion, mechanism_motion
from .shaft import Crankshaft, ShaftEquations, crankshaft


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


STEPS: Final = 360
"""Steps per revolution besides the kinks at the valves: one degree."""
START_ECCENTRICITY: Final = 0.1
SUPPLIES: Final = 10
THICKER_OILS: Final = (8.0, 4.0, 2.0, 1.4)
"""Viscosities over the machine's, on the way to it where it is not reached at once."""
SPEED_TOLERANCE: Final = 1e-6
"""Tolerance of the mean speed, relative."""
KEPT_CYCLES: Final = 16
"""A search asks for those of a design twice, at each speed: for its forces and its criteria."""


def steady_cycle(
    machine: HermeticTables,
    film: FilmForce = positive_film_force,
    steps: int = STEPS,
) -> tuple[ShaftEquations, PeriodicSolution]:
    """Periodic motion of the machine's case, with the equations that it solves.

    Parameters
    ----------
    machine : the compressor, its motor at a fixed synchronous speed
    film : force of a bearing's film on the journal
    steps : uniform steps per revolution
    """
    equations = ShaftEquations(machine, crankshaft(machine), film)
    mesh = np.union1d(np.linspace(0.0, 2.0 * np.pi, steps + 1), valve_angles(machine))
    guess = np.tile(_guess(machine, equations.shaft), (mesh.size - 1, 3, 1))
    try:
        return equations, _solved(equations, mesh, guess)
    except SolverError:
        return equations, _thinned(equations, mesh, guess)


def _thinned(equations: ShaftEquations, mesh: Array, guess: Array) -> PeriodicSolution:
    """The cycle from those of thicker oil, in whose films Newton's method has an easier way."""
    machine = equations.machine
    for factor in THICKER_OILS:
        oil = {"viscosity_pa_s": factor * machine.bearing.viscosity_pa_s}
        thicker = machine.model_copy(update={"bearing": machine.bearing.model_copy(update=oil)})
        solution = _solved(replace(equations, machine=thicker), mesh, guess)
        guess = solution.stages
    return _solved(equations, mesh, guess)


@lru_cache(KEPT_CYCLES)
def cycle_at_speed(
    machine: HermeticTables, speed_rpm: float, steps: int = STEPS
) -> tuple[ShaftEquations, PeriodicSolution]:
    """Steady cycle of a mean speed: the motor's synchronous speed is what it takes.

    Raises
    ------
    SolverError
        No cycle, or no synchronous speed for it, is found.
    """
    wanted = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    equations, solution = steady_cycle(_supplied(machine, wanted), steps=steps)
    for _ in range(SUPPLIES):
        missing = wanted - mean_speed_rad_per_s(solution)
        if abs(missing) < SPEED_TOLERANCE * wanted:
            return equations, solution
        # The load hardly depends on the speed, so that the slip stays as it is.
        supply = equations.machine.motor.synchronous_speed_rad_per_s + missing
        supplied = _supplied(machine, supply)
        equations = ShaftEquations(supplied, equations.shaft, equations.film)
        solution = _solved(equations, solution.mesh, solution.stages)
    raise SolverError(f"{speed_rpm:g} rpm: no synchronous speed of the motor found for it")


def mean_speed_rad_per_s(solution: PeriodicSolution) -> float:
    """Mean over time of the shaft's speed."""
    return 2.0 * np.pi / float(solution.cycle_integral(1.0 / solution.stages[..., -1]))


def _supplied(machine: HermeticTables, synchronous_speed: float) -> HermeticTables:
    """The machine on a supply of another frequency, its torque over slip the same."""
    motor = machine.motor.model_copy(update={"synchronous_speed_rad_per_s": synchronous_speed})
    return machine.model_copy(update={"motor": motor})


def _solved(equations: ShaftEquations, mesh: Array, stages: Array) -> PeriodicSolution:
    machine, shaft = equations.machine, equations.shaft
    return periodic_solution(
        equations.slopes_and_tangents,
        mesh,
        stages,
        _size(machine, shaft),
        _clearance_kept(machine, shaft),
    )


def uniform_samples(solution: PeriodicSolution, steps: int = STEPS) -> tuple[Array, Array]:
    """Crank angles from zero, uniform over the revolution, and the states there.

    Parameters
    ----------
    solution : result of `steady_cycle` with the same number of steps
    steps : samples per revolution

    Returns
    -------
    angles, states : rad, shape (steps,), and shape (steps, 2n + 1)

    Raises
    ------
    ParameterError
        The solution has other steps.
    """
    wanted = np.linspace(0.0, 2.0 * np.pi, steps + 1)[:-1]
    indices = np.searchsorted(solution.mesh, wanted)
    if not np.array_equal(solution.mesh[indices], wanted):
        raise ParameterError(f"steps = {steps}: must be that of the solution's own mesh")
    return solution.mesh[indices], solution.states[indices]


def _guess(machine: HermeticTables, shaft: Crankshaft) -> Array:
    """Journals a little out of the middle, at the synchronous speed."""
    state = np.zeros(2 * shaft.dof_count + 1)
    for dof in shaft.bearing_dofs:
        state[dof] = -START_ECCENTRICITY * machine.bearing.clearance_m
    state[-1] = machine.motor.synchronous_speed_rad_per_s
    return state


def _size(machine: HermeticTables, shaft: Crankshaft) -> Array:
    """Magnitude of each state: the clearance, the clearance per radian, the speed."""
    speed, clearance = machine.motor.synchronous_speed_rad_per_s, machine.bearing.clearance_m
    tilt = clearance / machine.shaft.bearing_distance_m
    displacement = np.resize([clearance, clearance, tilt, tilt], shaft.dof_count)
    return np.concatenate((displacement, speed * displacement, [speed]))


def _clearance_kept(machine: HermeticTables, shaft: Crankshaft) -> Callable[[Array, Array], float]:
    """Fraction of a Newton step that leaves every journal a fifth of its film or more."""
    clearance = machine.bearing.clearance_m

    def fraction(stages: Array, step: Array) -> float:
        film, move = _films_and_moves(stages, step, shaft.bearing_dofs, clearance)
        return float(min(1.0, 0.8 * np.min(film / np.maximum(move, 1e-300), initial=np.inf)))

    return fraction


def _films_and_moves(
    stages: Array, step: Array, dofs: Sequence[int], clearance_m: float
) -> tuple[Array, Array]:
    """Thinnest film and length of the step of each journal at each point."""
    journal_dofs = np.array([(dof, dof + 1) for dof in dofs], dtype=int).reshape(-1, 2)
    film = clearance_m - np.linalg.norm(stages[..., journal_dofs], axis=-1)
    return film, np.linalg.norm(step[..., journal_dofs], axis=-1)
