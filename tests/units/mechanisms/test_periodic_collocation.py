"""Periodic solutions by collocation: exact cycles, order, failure."""

import numpy as np
import pytest

from vibroacoustics.base.errors import SolverError
from vibroacoustics.mechanisms.hermetic.periodic_collocation import periodic_solution


def _relaxing(rate):
    """y' = rate (cos θ - y), with the cycle (rate² cos θ + rate sin θ)/(1 + rate²)."""

    def slope(angle, states):
        slopes = rate * (np.cos(angle)[:, None] - states)
        return slopes, np.full((angle.size, 1, 1), -rate)

    return slope


def _solved(slope, steps):
    mesh = np.linspace(0.0, 2.0 * np.pi, steps + 1)
    return periodic_solution(slope, mesh, np.zeros((steps, 3, 1)), np.ones(1))


@pytest.mark.parametrize("rate", [1.0, 1e6])
def test_exact_cycle(rate):
    solution = _solved(_relaxing(rate), 60)
    exact = (rate**2 * np.cos(solution.mesh) + rate * np.sin(solution.mesh)) / (1.0 + rate**2)
    # Order 5: (2π/60)⁵/7200 is 2e-9 of a unit derivative.
    assert solution.states[:, 0] == pytest.approx(exact, abs=1e-8)
    # Radau IIA is L-stable: what decays too fast to follow is gone.
    assert solution.largest_multiplier == pytest.approx(np.exp(-2.0 * np.pi * rate), abs=1e-9)


def test_order_of_convergence():
    """The quadrature of a stage value over the cycle: order 5, hence a factor of 32."""

    def error(steps):
        solution = _solved(_relaxing(1.0), steps)
        return np.max(
            np.abs(solution.states[:, 0] - np.cos(solution.mesh - np.pi / 4) / np.sqrt(2))
        )

    assert np.log2(error(10) / error(20)) == pytest.approx(5.0, abs=0.2)


def test_integral_over_the_cycle():
    solution = _solved(_relaxing(1.0), 40)
    # Radau's quadrature is exact to degree 4; the error is that of (2π/40)⁶.
    angle = solution.stage_angles
    assert solution.cycle_integral(np.cos(angle) ** 2) == pytest.approx(np.pi, abs=1e-9)


def test_steps_of_rounding_errors_end_the_search():
    """Slopes with noise of 1e-9 hold every step above the tolerance of 1e-10."""
    noise = np.random.default_rng(1)
    exact = _relaxing(1.0)

    def rough(angle, states):
        slopes, tangents = exact(angle, states)
        return slopes + 1e-9 * noise.standard_normal(slopes.shape), tangents

    solution = _solved(rough, 40)
    smooth = _solved(exact, 40)
    assert solution.states == pytest.approx(smooth.states, abs=1e-8)


def test_no_cycle_is_a_solver_error():
    def drifting(angle, states):
        return np.ones_like(states), np.zeros((angle.size, 1, 1))

    with pytest.raises(SolverError, match="no periodic cycle"):
        _solved(drifting, 10)
