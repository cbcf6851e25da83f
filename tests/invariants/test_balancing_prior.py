"""Influence coefficients of a model save a trial run."""

import numpy as np
import pytest
from synthetic_bench import TRIAL_KG_M, influence_of, of_prior

from vibroacoustics.mechanics.balancing.coefficients import Ensemble, coefficients
from vibroacoustics.mechanics.balancing.moments import least_squares_moments

SEED = 1934
MACHINES = 100
SCATTER = 0.01
"""Standard deviation of a reading, of the first one."""


def residuals(mass, stiffness):
    """Median of what remains with two trial runs, and with one and the model."""
    rng = np.random.default_rng(SEED)
    prior = Ensemble(np.array([influence_of(of_prior(rng)) for _ in range(200)]))
    weights = TRIAL_KG_M * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    remaining = []
    for _ in range(MACHINES):
        bench = of_prior(rng, mass, stiffness)
        influence = influence_of(bench)
        first = influence @ bench.unbalance_kg_m
        deviation = np.broadcast_to(SCATTER * np.abs(first) / np.sqrt(2.0), (3, first.size))
        noise = rng.standard_normal((2, *deviation.shape)) * deviation
        readings = first + weights @ influence.T + noise[0] + 1j * noise[1]
        stated = np.full(first.size, np.inf)
        two = coefficients(readings, weights, deviation, stated)
        one_trial = coefficients(readings[:2], weights[:2], deviation[:2], stated, prior)
        remaining.append([
            np.linalg.norm(
                first + influence @ least_squares_moments(each.response[None], each.influence[None])
            ) / np.linalg.norm(first)
            for each in (two, one_trial)
        ])  # fmt: skip
    return np.median(remaining, axis=0)


@pytest.mark.parametrize(
    ("mass", "stiffness", "most"),
    [(1.0, 1.0, 1.2), (1.32, 1.0, 1.5), (0.72, 1.0, 1.5), (1.0, 1.44, 1.5), (1.0, 0.64, 1.5)],
)
def test_a_trial_run_with_the_model_is_as_good_as_two(mass, stiffness, most):
    """Of the prior; with masses or mounts whose mean is 20 % beyond the ends of their ranges."""
    two, with_model = residuals(mass, stiffness)
    assert with_model <= most * two, with_model / two
    assert with_model < 0.05
