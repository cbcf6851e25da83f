"""Influence coefficients from all runs together, their scatter, and weights in holes."""

import numpy as np
import pytest

from vibroacoustics.mechanics.balancing.bands import residual_samples
from vibroacoustics.mechanics.balancing.coefficients import (
    Ensemble,
    coefficients,
    scatter_of_runs,
)
from vibroacoustics.mechanics.balancing.planes import chosen_pieces, positions, split_moment

SEED = 1911
ROWS, PLANES = 6, 2


def normal(rng, *shape):
    return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)


def machine(rng):
    """Readings without weights and influence, as one array."""
    return normal(rng, ROWS, 1 + PLANES)


def measured(rng, truth, weights, scatter):
    readings = truth[:, 0] + weights @ truth[:, 1:].T
    return readings + scatter * normal(rng, *readings.shape)


WEIGHTS = np.array([[0, 0], [1.0, 0], [0, 1j], [0, 0], [1j, 0], [0, -1.0], [0, 0]])


def test_exact_readings_give_the_coefficients():
    """Repeats, trial weights moved in angle and a missing reading of one row."""
    rng = np.random.default_rng(SEED)
    truth = machine(rng)
    readings = measured(rng, truth, WEIGHTS, 0.0)
    readings[3, 2] = np.nan
    found = coefficients(readings, WEIGHTS, np.ones(readings.shape), np.zeros(ROWS))
    np.testing.assert_allclose(found.mean, truth, atol=1e-12)
    scatter = scatter_of_runs(readings, WEIGHTS)
    assert scatter.squares == pytest.approx(np.zeros(ROWS), abs=1e-20)
    assert scatter.freedom.tolist() == [8.0, 8.0, 6.0, 8.0, 8.0, 8.0]


def test_covariance_is_that_of_many_repetitions():
    """Standard deviation of 400 repetitions: within 5 standard errors, 5/√(2·2·400)."""
    rng = np.random.default_rng(SEED)
    truth, scatter = machine(rng), 0.1
    found, expected = [], None
    for _ in range(400):
        readings = measured(rng, truth, WEIGHTS, scatter)
        deviation = np.full(readings.shape, scatter)
        fit = coefficients(readings, WEIGHTS, deviation, np.full(ROWS, np.inf))
        found.append(fit.mean - truth)
        expected = np.sum(np.abs(fit.factor) ** 2, axis=-1)
    spread = np.mean(np.abs(np.array(found)) ** 2, axis=0)
    np.testing.assert_allclose(np.sqrt(spread / expected), 1.0, atol=5.0 / np.sqrt(1600))
    sampled = fit.sampled() - fit.mean
    np.testing.assert_allclose(
        np.sqrt(np.mean(np.abs(sampled) ** 2, axis=0) / expected), 1.0, atol=5.0 / np.sqrt(1600)
    )


def test_scatter_of_repeats_is_the_one_of_the_readings():
    rng = np.random.default_rng(SEED)
    totals = [
        scatter_of_runs(measured(rng, machine(rng), WEIGHTS, 0.1), WEIGHTS) for _ in range(100)
    ]
    variance = sum(each.squares.sum() for each in totals) / sum(
        each.freedom.sum() for each in totals
    )
    freedom = 100 * 8 * ROWS
    assert variance == pytest.approx(0.01, rel=5.0 * np.sqrt(2.0 / freedom))


def test_a_vague_prior_changes_nothing_and_a_sharp_one_replaces_runs():
    rng = np.random.default_rng(SEED)
    truth = machine(rng)
    exact = np.broadcast_to(truth[:, 1:], (50, ROWS, PLANES))
    vague = exact + 1e4 * normal(rng, 50, ROWS, PLANES)
    readings, deviation = measured(rng, truth, WEIGHTS, 0.1), np.full((7, ROWS), 0.1)
    stated = np.full(ROWS, np.inf)
    plain = coefficients(readings, WEIGHTS, deviation, stated)
    with_vague = coefficients(readings, WEIGHTS, deviation, stated, Ensemble(vague, 1e2))
    np.testing.assert_allclose(with_vague.mean, plain.mean, atol=1e-4)
    sharp = Ensemble(exact + 1e-4 * normal(rng, 50, ROWS, PLANES), 1e-4)
    first = coefficients(readings[:1], WEIGHTS[:1], deviation[:1], stated, sharp)
    np.testing.assert_allclose(first.influence, truth[:, 1:], atol=1e-3)
    np.testing.assert_allclose(first.response, readings[0], atol=1e-12)


def test_a_prior_carries_what_one_plane_says_to_the_other():
    """Samples that differ by one complex factor: one trial shows the coefficients of all planes."""
    rng = np.random.default_rng(SEED)
    shape, factor = normal(rng, ROWS, PLANES), 1.0 + 0.3 * normal(rng, 200)
    prior = Ensemble(factor[:, None, None] * shape, 1e-3)
    truth = np.concatenate([normal(rng, ROWS, 1), 1.4 * np.exp(0.3j) * shape], axis=1)
    readings = measured(rng, truth, WEIGHTS[:2], 0.0)
    found = coefficients(
        readings, WEIGHTS[:2], np.full(readings.shape, 1e-3), np.full(ROWS, np.inf), prior
    )
    np.testing.assert_allclose(found.influence, truth[:, 1:], rtol=0.01)


@pytest.mark.parametrize("angle_deg", [0.0, 10.0, 29.9, 30.0, 200.0, 345.0])
def test_a_split_moment_is_the_sum_of_its_pieces(angle_deg):
    holes = np.deg2rad(30.0 * np.arange(12))
    moment = 2.0 * np.exp(1j * np.deg2rad(angle_deg))
    pieces = split_moment(moment, holes)
    assert sum(piece.vector for piece in pieces) == pytest.approx(moment)
    assert len(pieces) == (1 if angle_deg % 30.0 == 0.0 else 2)
    for piece in pieces:
        away = (np.rad2deg(piece.angle_rad) - angle_deg + 180.0) % 360.0 - 180.0
        assert abs(away) < 30.0
        assert piece.hole == round(np.rad2deg(piece.angle_rad) / 30.0) + 1


def test_split_moments_without_neighbours_and_without_holes():
    assert split_moment(0.0, np.zeros(0)) == []
    (anywhere,) = split_moment(2.0j, np.zeros(0))
    assert (anywhere.hole, anywhere.vector) == (None, pytest.approx(2.0j))
    (only,) = split_moment(2.0 * np.exp(0.5j), np.zeros(1))
    assert only.moment == pytest.approx(2.0 * np.cos(0.5))
    assert split_moment(-2.0 + 0j, np.zeros(1)) == []


def test_single_weights_are_those_of_trying_all():
    rng = np.random.default_rng(SEED)
    response, influence = normal(rng, 1, ROWS), normal(rng, 1, ROWS, PLANES)
    pieces = positions(np.deg2rad(60.0 * np.arange(6)), np.array([0.3, 0.6, 1.2]))
    assert len(pieces) == 19
    chosen = chosen_pieces(response, influence, [pieces, pieces])
    best = min(
        np.linalg.norm(response + influence @ np.array([first.vector, second.vector]))
        for first in pieces
        for second in pieces
    )
    moment = np.array([piece.vector for piece in chosen])
    assert np.linalg.norm(response + influence @ moment) == pytest.approx(best)


def test_without_informative_runs_the_scatter_is_that_of_the_samples():
    rng = np.random.default_rng(SEED)
    prior = Ensemble(machine(rng)[:, 1:] + 0.1 * normal(rng, 40, ROWS, PLANES), 0.0)
    found = coefficients(
        normal(rng, 1, ROWS), WEIGHTS[:1], np.full((1, ROWS), 0.1), np.full(ROWS, np.inf), prior
    )
    variance = np.sum(np.abs(found.factor[:, 1:]) ** 2, axis=-1)
    expected = np.var(prior.samples, axis=0, ddof=1)
    np.testing.assert_allclose(variance, expected, rtol=1e-9)


def test_what_no_weight_changes_shrinks_to_what_exceeds_its_scatter():
    """Of a remaining reading far below its scatter none is real; of one far above it all is."""
    rng = np.random.default_rng(SEED)
    truth = machine(rng)
    truth[:, 0] = -truth[:, 1:] @ np.array([1.0, 1j])
    across = np.eye(ROWS) - truth[:, 1:] @ np.linalg.pinv(truth[:, 1:])
    for size, scatter in ((1e-6, 1e-3), (1.0, 1e-3)):
        further = across @ normal(rng, ROWS)
        shifted = truth.copy()
        shifted[:, 0] += size * further
        readings = measured(rng, shifted, WEIGHTS, 0.0)
        found = coefficients(
            readings, WEIGHTS, np.full(readings.shape, scatter), np.full(ROWS, np.inf)
        )
        samples = residual_samples(found, np.array([1.0, 1j]))
        spread = np.abs(samples @ across.T)
        if size < scatter:
            assert spread.max() < 1e-6 * scatter
        else:
            error = found.sampled() - found.mean
            plain = (error[..., 0] + error[..., 1:] @ np.array([1.0, 1j])) @ across.T
            deviation = samples @ across.T - size * further
            np.testing.assert_allclose(deviation, plain, atol=0.1 * np.abs(plain).max())
