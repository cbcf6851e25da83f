"""Quantiles of values that count by weights."""

import numpy as np
import pytest

from vibroacoustics.base.quantiles import weighted_quantiles

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
