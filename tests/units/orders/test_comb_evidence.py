"""Speeds of a shaft in clear lines that are given."""

import numpy as np
import pytest

from vibroacoustics.orders.comb_evidence import Lines, best_speeds


def test_speed_is_the_weighted_least_squares_fit_of_its_lines():
    """Weights are 1/σ², σ = 1.5e-3 f + 0.35 lines; at one of the teeth they are right to 1e-3."""
    frequency, orders = np.array([10.01, 20.0, 39.98]), np.array([1.0, 2.0, 4.0])
    lines = Lines(
        frequency=frequency, level=np.full(3, 1e3), width=np.full(3, 1.9), resolution=0.05,
        highest=100.0, spectrum=np.zeros(1), step=1.0,
    )  # fmt: skip
    weight = 1.0 / (1.5e-3 * frequency + 0.35 * 0.05) ** 2
    fitted = np.sum(weight * orders * frequency) / np.sum(weight * orders**2)
    speeds, evidence = best_speeds(lines, orders, 9.0, 11.0, 1e-2)
    assert speeds == pytest.approx([fitted], abs=1e-4)  # deviations of 0.02 times 1e-3, and more
    assert evidence[0] > 0.0
