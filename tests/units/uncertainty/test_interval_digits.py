"""Sampling errors of quantiles: closed form, the plain quantile, samples of several rows."""

import numpy as np
import pytest
from scipy.stats import norm

from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.base.rounding import unit_of_digits
from vibroacoustics.uncertainty.interval_digits import (
    BOOTSTRAPS,
    bootstrap_weights,
    quantile_errors,
)

SHARES = (0.1, 0.5, 0.9)


def errors_of(values: np.ndarray, sample: np.ndarray | None = None) -> np.ndarray:
    weight = np.ones(values.size)
    numbers = np.arange(values.size) if sample is None else sample
    return quantile_errors(values, weight, bootstrap_weights(weight, numbers), SHARES)


def test_errors_are_those_of_the_closed_form() -> None:
    """√(p (1 - p)/n)/f(q) of 400 normal values; in the mean over 100 sets to a tenth.

    The bootstrap's own bias at this number is of the order n^(-1/2), 5 %.
    """
    random = np.random.default_rng(3)
    found = np.mean([errors_of(random.normal(size=400)) for _ in range(100)], axis=0)
    shares = np.array(SHARES)
    expected = np.sqrt(shares * (1.0 - shares) / 400) / norm.pdf(norm.ppf(shares))
    np.testing.assert_allclose(found, expected, rtol=0.1)


def test_errors_are_those_of_quantiles_of_resampled_ensembles() -> None:
    """In the mean over 40 sets of 91 weighted values, to a tenth, as above."""
    random = np.random.default_rng(4)
    ratios = []
    for _ in range(40):
        values, weight = random.normal(size=91), random.random(91)
        weights = bootstrap_weights(weight, np.arange(91))
        quantiles = [weighted_quantiles(values, one, SHARES) for one in weights]
        found = quantile_errors(values, weight, weights, SHARES)
        ratios.append(found / np.std(quantiles, axis=0, ddof=1))
    np.testing.assert_allclose(np.mean(ratios, axis=0), 1.0, atol=0.1)


def test_one_sample_has_no_error() -> None:
    assert not errors_of(np.array([3.0])).any()


def test_rows_of_one_sample_are_chosen_together() -> None:
    """Ten rows each: the error is that of 400 samples, not √10 smaller.

    Between samples the quantile of repeated rows is a step: 400^(-1/2) of its error, 5 %.
    """
    values = np.repeat(np.random.default_rng(5).normal(size=400), 10)
    together = errors_of(values, np.repeat(np.arange(400), 10))
    np.testing.assert_allclose(together, errors_of(values[::10]), rtol=0.1)
    assert (errors_of(values) < 0.6 * together).all()


def test_each_ensemble_has_as_many_samples() -> None:
    sample = np.array([0, 0, 1, 2])
    times = bootstrap_weights(np.array([0.5, 0.5, 1.0, 1.0]), sample)
    assert times.shape == (BOOTSTRAPS, 4)
    np.testing.assert_allclose(times.sum(axis=1), 1.0)
    np.testing.assert_array_equal(times[:, 0], times[:, 1])
    thirds = 3.0 * times @ np.array([[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    np.testing.assert_allclose(thirds, thirds.round(), atol=1e-12)


def test_values_without_weight_do_not_count() -> None:
    values, weight = np.array([1.0, 2.0, 3.0, np.nan]), np.array([1.0, 1.0, 1.0, 0.0])
    weights = bootstrap_weights(weight, np.arange(4))
    found = quantile_errors(values, weight, weights, SHARES)
    np.testing.assert_allclose(found, errors_of(values[:3]))


def test_infinite_levels_have_no_error() -> None:
    assert not errors_of(np.array([-np.inf, 1.0, 2.0])).any()


@pytest.mark.parametrize(
    ("error", "finest", "unit"),
    [
        (0.31, 0.1, 0.1),
        (0.32, 0.1, 1.0),
        (3.2, 0.1, 10.0),
        (0.004, 0.1, 0.1),
        (0.0, 0.48, 1.0),
        (0.0, 0.0, 0.0),
    ],
)
def test_unit_is_the_nearest_power_of_ten(error: float, finest: float, unit: float) -> None:
    assert unit_of_digits(error, finest) == pytest.approx(unit)
