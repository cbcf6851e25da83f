"""Quantiles of values that count by weights."""

import numpy as np
import pytest

from vibroacoustics.base.quantiles import stepped_quantiles, weighted_quantiles

SHARES = (0.0, 0.1, 0.5, 0.9, 1.0)


def test_equal_weights_are_numpys_quantiles():
    values = np.random.default_rng(0).normal(size=(11, 3, 2))
    found = weighted_quantiles(values, np.full(11, 0.2), SHARES)
    assert found == pytest.approx(np.quantile(values, SHARES, axis=0))


def test_weights_pull_and_zeros_do_not_count():
    values = np.array([0.0, np.nan, 1.0, 2.0, 3.0])
    (middle,) = weighted_quantiles(values, np.array([1.0, 0.0, 1.0, 1.0, 9.0]), (0.5,))
    assert middle > 2.0
    many = np.random.default_rng(1).normal(size=4000)
    loud = many > 1.0
    twice = weighted_quantiles(many, np.where(loud, 2.0, 1.0), SHARES)
    repeated = np.quantile(np.concatenate([many, many[loud]]), SHARES)
    assert np.abs(twice - repeated).max() < 1e-2  # a gap between two values


def test_one_value_is_all_quantiles():
    assert weighted_quantiles(np.array([4.0]), np.ones(1), SHARES).tolist() == [4.0] * 5


def test_stepped_quantiles_are_values_themselves():
    """Those of numpy's inverted distribution function; a median between two steps is the lower."""
    steps = np.random.default_rng(2).choice([0.0, 3.0, 6.0], size=(10, 4))
    found = stepped_quantiles(steps, np.full(10, 0.1), SHARES)
    assert found.tolist() == np.quantile(steps, SHARES, axis=0, method="inverted_cdf").tolist()
    weight = np.array([0.5, 0.5, 0.0])
    assert weighted_quantiles(np.array([3.0, 6.0, 9.0]), weight, [0.5]).tolist() == [4.5]
    assert stepped_quantiles(np.array([3.0, 6.0, 9.0]), weight, [0.5]).tolist() == [3.0]
    assert stepped_quantiles(np.array([3.0, 6.0]), np.array([0.4, 0.6]), [0.4, 0.41]).tolist() == [
        3.0, 6.0,
    ]  # fmt: skip
