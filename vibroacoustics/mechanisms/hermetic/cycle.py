"""Steady cycle of a hermetic reciprocating compressor: the periodic motion, found directly."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from .gas import valve_angles
from .journal_bearing import FilmForce, positive_film_force
from .parameters import HermeticTables
from .periodic_collocation import PeriodicSolution, periodic_solution
from .shaft import Crankshaft, ShaftEquations, crankshaft

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

    Raises
    ------
    SolverError
        Newton's method does not converge.
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
