"""Periodic solutions of stiff y' = f(θ, y): Radau IIA collocation, Newton with the exact tangent.

One linear solve a step and iteration, no transient to wait for: the cycle is closed at once.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import SolverError

Slope = Callable[[Array, Array], tuple[Array, Array]]
"""Slopes (points, states) and their tangents (points, states, states) at angles and states."""

_ROOT: Final = np.sqrt(6.0)
NODES: Final = np.array([(4.0 - _ROOT) / 10.0, (4.0 + _ROOT) / 10.0, 1.0])
"""Radau IIA of order 5 (Hairer & Wanner 1996, table IV.5.6)."""
WEIGHTS: Final = np.array(
    [
        [(88 - 7 * _ROOT) / 360, (296 - 169 * _ROOT) / 1800, (-2 + 3 * _ROOT) / 225],
        [(296 + 169 * _ROOT) / 1800, (88 + 7 * _ROOT) / 360, (-2 - 3 * _ROOT) / 225],
        [(16 - _ROOT) / 36, (16 + _ROOT) / 36, 1 / 9],
    ]
)
STAGES: Final = 3
NEWTON_STEPS: Final = 80
STEP_TOLERANCE: Final = 1e-10
"""Last Newton step over the size of each state; the convergence is quadratic before it."""
ROUNDING: Final = 1e-8
"""Size below which a step that is no longer a tenth of the one before is rounding error: stiff
shafts in thin films have a floor of a few 1e-10."""


@dataclass(frozen=True)
class PeriodicSolution:
    """A closed cycle.

    Attributes
    ----------
    mesh : angles of the mesh points, rad, shape (steps + 1,)
    states : at the mesh points, shape (steps + 1, states); the last equals the first
    stages : at the collocation points, shape (steps, 3, states)
    monodromy : derivative of the states after one cycle by those before, shape (states, states)
    """

    mesh: Array
    states: Array
    stages: Array
    monodromy: Array

    @property
    def stage_angles(self) -> Array:
        """Angles of the collocation points, rad, shape (steps, 3)."""
        return np.asarray(self.mesh[:-1, None] + np.diff(self.mesh)[:, None] * NODES)

    def cycle_integral(self, integrand: Array) -> Array:
        """Integral over the cycle of values at the collocation points, shape (steps, 3, ...)."""
        return np.asarray(np.einsum("i,k,ik...->...", np.diff(self.mesh), WEIGHTS[-1], integrand))

    @property
    def largest_multiplier(self) -> float:
        """Growth of the slowest deviation per cycle; below one the cycle is stable."""
        return float(np.max(np.abs(np.linalg.eigvals(self.monodromy))))


def periodic_solution(
    slope: Slope,
    mesh: Array,
    guess: Array,
    size: Array,
    allowed: Callable[[Array, Array], float] = lambda _states, _step: 1.0,
) -> PeriodicSolution:
    """Cycle of y' = f(θ, y) over the mesh, by Newton's method on all collocation points.

    Parameters
    ----------
    slope : f and its tangent
    mesh : ascending angles of one period, shape (steps + 1,); kinks of f must be mesh points
    guess : states at the collocation points, shape (steps, 3, states)
    size : typical magnitude of each state, for the test of convergence, shape (states,)
    allowed : largest fraction of a step that keeps the states where f is defined

    Raises
    ------
    SolverError
        Newton's method does not converge.
    """
    stages, start, length = guess.copy(), guess[-1, -1].copy(), np.inf
    for _ in range(NEWTON_STEPS):
        particular, transfer = _condensed(slope, mesh, stages, start)
        monodromy, offset = _compose(particular[:, -1], transfer[:, -1])
        try:
            change = np.asarray(np.linalg.solve(np.eye(start.size) - monodromy, offset), float)
        except np.linalg.LinAlgError:  # a deviation that neither grows nor decays
            break
        step = _propagated(particular, transfer, change)
        if not np.isfinite(step).all():
            break
        fraction = allowed(stages, step)
        stages, start = stages + fraction * step, start + fraction * change
        before, length = length, float(np.max(np.abs(step) / size))
        if length < STEP_TOLERANCE or 0.1 * before < length < ROUNDING:
            states = np.concatenate((start[np.newaxis], stages[:, -1]))
            return PeriodicSolution(mesh, states, stages, monodromy)
    raise SolverError("no periodic cycle found: Newton's method does not converge")


def _condensed(slope: Slope, mesh: Array, stages: Array, start: Array) -> tuple[Array, Array]:
    """Newton step of each step's stages as d + P (step of its first state)."""
    steps, _, size = stages.shape
    widths = np.diff(mesh)
    angles = (mesh[:-1, None] + widths[:, None] * NODES).ravel()
    slopes, tangents = slope(angles, stages.reshape(-1, size))
    slopes = slopes.reshape(stages.shape)
    tangents = tangents.reshape(steps, STAGES, size, size)
    before = np.concatenate((start[np.newaxis], stages[:-1, -1]))
    residual = stages - before[:, None] - np.einsum("i,jk,ikn->ijn", widths, WEIGHTS, slopes)
    matrix = -np.einsum("i,jk,iknm->ijnkm", widths, WEIGHTS, tangents)
    matrix = matrix.reshape(steps, STAGES * size, STAGES * size)
    matrix += np.eye(STAGES * size)
    right = np.empty((steps, STAGES * size, size + 1))
    right[..., 0] = -residual.reshape(steps, -1)
    right[..., 1:] = np.tile(np.eye(size), (STAGES, 1))
    solved = np.linalg.solve(matrix, right).reshape(steps, STAGES, size, size + 1)
    return solved[..., 0], solved[..., 1:]


def _compose(particular: Array, transfer: Array) -> tuple[Array, Array]:
    """The whole cycle's change as offset + monodromy times the change of the first state."""
    monodromy, offset = np.eye(transfer.shape[-1]), np.zeros(transfer.shape[-1])
    for change, matrix in zip(particular, transfer, strict=True):
        monodromy, offset = matrix @ monodromy, matrix @ offset + change
    return monodromy, offset


def _propagated(particular: Array, transfer: Array, first: Array) -> Array:
    """Newton steps of all stages from that of the first state."""
    step = np.empty_like(particular)
    for step_number, (change, matrix) in enumerate(zip(particular, transfer, strict=True)):
        step[step_number] = change + matrix @ first
        first = step[step_number, -1]
    return step
