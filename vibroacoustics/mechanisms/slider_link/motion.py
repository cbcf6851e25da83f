"""Slider-link mechanism: the crank's periodic motion and its energy balance."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError, SolverError
from .crankshaft import CrankForces, settled
from .parameters import SliderLinkTables
from .piston import (
    CrankState,
    check_not_jammed,
    piston_velocity,
    slider_velocity,
    valve_angles,
)

MAXIMUM_ITERATIONS: Final = 200
CONVERGED: Final = 1e-12
"""Largest change of velocity and mean torque between iterations, relative."""
KEPT_CYCLES: Final = 16
"""A search asks for those of a design twice, at each speed: for its forces and its criteria."""
NODES: Final = 4
"""Nodes of one panel: exact for a polynomial of degree 7 over it, of degree 3 inside it."""


@dataclass(frozen=True)
class GaussPanels:
    """Panels between given edges; kinks of the integrand belong on edges.

    Attributes
    ----------
    edges : rising, shape (panel + 1,)
    """

    edges: Array

    @property
    def nodes(self) -> Array:
        """Shape (panel × node,)."""
        positions, _, _ = _rule()
        return np.asarray(self.edges[:-1, None] + self._width * positions).ravel()

    def integral(self, values: Array) -> float:
        """Return the integral over all panels.

        Parameters
        ----------
        values : values at the nodes, shape (node,)
        """
        return float(self.running(values)[1][-1])

    def running(self, values: Array) -> tuple[Array, Array]:
        """Integrals from the first edge to every node and to every edge.

        Parameters
        ----------
        values : values at the nodes, shape (node,)
        """
        _, weights, inner = _rule()
        scaled = self._width * values.reshape(-1, NODES)
        edges = np.concatenate([[0.0], np.cumsum(scaled @ weights)])
        return (edges[:-1, None] + scaled @ inner.T).ravel(), edges

    @property
    def _width(self) -> Array:
        return np.diff(self.edges)[:, None]


@dataclass(frozen=True)
class SliderLinkCycle:
    """One revolution of the steady motion, uniform over crank angle.

    Attributes
    ----------
    state : motion of the crank
    forces : inside the machine
    motor_torque_n_m : M_v, shape (samples,)
    time_s : time from crank angle zero, shape (samples,)
    work_j : work of one revolution: put in by the motor, taken by the gas and by each friction
    """

    state: CrankState
    forces: CrankForces
    motor_torque_n_m: Array
    time_s: Array
    work_j: dict[str, float]


@lru_cache(KEPT_CYCLES)
def steady_motion(
    machine: SliderLinkTables, mean_velocity: float, samples: int = 720
) -> SliderLinkCycle:
    """Periodic motion of the crank (35) at a given mean velocity.

    With φ as the variable (35) is d(φ̇²/2)/dφ = φ̈. The motor's torque falls with the velocity;
    its mean is what closes the cycle. Iterated on all of the revolution at once: velocities give
    forces (vectorised), these φ̈, its integral the velocities. The motor's answer to a change is
    solved for in each step, hence about seven steps do, some twenty for a very steep motor.

    Parameters
    ----------
    machine : masses in kg, lengths in m, pressures in Pa
    mean_velocity : one revolution per its time, rad/s
    samples : number of samples of the result, a multiple of four; also the panels of the quadrature

    Raises
    ------
    ParameterError
        The piston jams, or a value is outside its range.
    SolverError
        The iteration does not converge, or the crank would stop within the revolution.
    """
    if not (np.isfinite(mean_velocity) and mean_velocity > 0.0):
        raise ParameterError(f"mean_velocity = {mean_velocity:g} rad/s: must be above 0")
    if samples < 16 or samples % 4:
        raise ParameterError(f"samples = {samples}: must be a multiple of 4, at least 16")
    check_not_jammed(machine.mechanism)
    uniform = 2.0 * np.pi * np.arange(samples + 1) / samples
    panels = GaussPanels(np.union1d(uniform, valve_angles(machine.gas)))
    mean_torque, velocity, start = _converged(machine, panels, mean_velocity)
    state, forces, torque = _at(machine, panels.nodes, velocity, mean_torque, mean_velocity)
    work = _work(machine, panels, state, forces, torque)
    kept = np.searchsorted(panels.edges, uniform[:-1])
    rise = panels.running(state.acceleration)[1][kept]
    at_edges = _at(machine, uniform[:-1], np.sqrt(2.0 * (start + rise)), mean_torque, mean_velocity)
    time = panels.running(1.0 / velocity)[1][kept]
    return SliderLinkCycle(*at_edges, time, work)


def _at(
    machine: SliderLinkTables,
    angle: Array,
    velocity: Array,
    mean_torque: float,
    mean_velocity: float,
) -> tuple[CrankState, CrankForces, Array]:
    """Motion, forces and motor torque at given angles and velocities."""
    torque = mean_torque - machine.motor.slope_n_m_s_per_rad * (velocity - mean_velocity)
    return *settled(machine, angle, velocity, torque), torque


def _converged(
    machine: SliderLinkTables, panels: GaussPanels, mean_velocity: float
) -> tuple[float, Array, float]:
    """Mean motor torque, velocity at the nodes and φ̇²/2 at crank angle zero."""
    inertia = machine.masses.crankshaft_inertia_kg_m2
    steepness = machine.motor.slope_n_m_s_per_rad / (inertia * mean_velocity)
    velocity, mean_torque = np.full_like(panels.nodes, mean_velocity), 0.0
    for _ in range(MAXIMUM_ITERATIONS):
        state, _, _ = _at(machine, panels.nodes, velocity, mean_torque, mean_velocity)
        # What the mean torque has too much would speed up the crank from turn to turn.
        surplus = panels.integral(state.acceleration) / (2.0 * np.pi)
        mean_torque -= inertia * surplus
        missing = abs(inertia * surplus / mean_torque)
        rise, _ = panels.running(state.acceleration - surplus)
        start = _start(panels, rise, mean_velocity)
        error = start + rise - 0.5 * velocity**2
        change = np.max(np.abs(error)) / mean_velocity**2
        if max(change, missing) < CONVERGED:
            return mean_torque, velocity, start
        square = 0.5 * velocity**2 + error - _motor_answer(panels, error, steepness)
        velocity = np.sqrt(2.0 * (square + _start(panels, square, mean_velocity)))
    raise SolverError(
        f"slider-link crank: the velocity still changes by {change:.1e} of its mean, the mean "
        f"torque by {missing:.1e} of the load after {MAXIMUM_ITERATIONS} iterations"
    )


def _motor_answer(panels: GaussPanels, error: Array, steepness: float) -> Array:
    """Response of the motor to a change of φ̇²/2: the periodic v of v' + s v = s error.

    Only a preconditioner: where e^(2π s) would grow too large a smaller s does.
    """
    rate = np.clip(steepness, 1e-9, 100.0)
    growth = np.exp(rate * panels.nodes)
    gathered, edges = panels.running(rate * growth * error)
    return np.asarray((edges[-1] / np.expm1(2.0 * np.pi * rate) + gathered) / growth)


def _start(panels: GaussPanels, rise: Array, mean_velocity: float) -> float:
    """Return what to add to φ̇²/2 for the stated mean velocity; Newton's method."""
    start = 0.5 * mean_velocity**2 - panels.integral(rise) / (2.0 * np.pi)
    for _ in range(MAXIMUM_ITERATIONS):
        if np.min(start + rise) <= 0.0:
            break
        velocity = np.sqrt(2.0 * (start + rise))
        excess = panels.integral(1.0 / velocity) - 2.0 * np.pi / mean_velocity
        step = excess / panels.integral(velocity**-3.0)
        start += step
        if abs(step) < 0.1 * CONVERGED * mean_velocity**2:
            return float(start)
    raise SolverError(
        "slider-link crank: it would stop within the revolution; crankshaft_inertia_kg_m2 is too "
        "small for this load and speed"
    )


def _work(
    machine: SliderLinkTables,
    panels: GaussPanels,
    state: CrankState,
    forces: CrankForces,
    torque: Array,
) -> dict[str, float]:
    """Work of one revolution, J: of the motor, into the gas, into each friction."""
    mechanism, contacts = machine.mechanism, forces.contacts
    piston = piston_velocity(mechanism, state)
    slider = slider_velocity(mechanism, state)
    pressed = np.abs(contacts.front) + np.abs(contacts.rear)
    powers = {
        "motor": torque * state.velocity,
        "gas": forces.gas * piston,
        "piston_film": -forces.film * piston,
        "cylinder": mechanism.cylinder_friction_ratio * pressed * np.abs(piston),
        "link": mechanism.link_friction_ratio * np.abs(contacts.link * slider),
        **{name: moment * state.velocity for name, moment in forces.friction_moments.items()},
    }
    return {name: panels.integral(power / state.velocity) for name, power in powers.items()}


def _rule() -> tuple[Array, Array, Array]:
    """Nodes on 0 to 1, weights over all of it, and from zero to each node (node, node)."""
    points, weights = np.polynomial.legendre.leggauss(NODES)
    positions = 0.5 * (points + 1.0)
    powers = np.arange(NODES)
    # Integrates every power exactly: inner @ position^k = position^(k+1) / (k+1).
    vandermonde = positions[:, None] ** powers
    integrals = positions[:, None] ** (powers + 1) / (powers + 1)
    return positions, 0.5 * weights, integrals @ np.linalg.inv(vandermonde)
