"""Bootstrap weights: sums, rows of one sample together, the error of a mean."""

import numpy as np

from vibroacoustics.uncertainty.bootstrap import BOOTSTRAPS, bootstrap_weights


def test_each_ensemble_has_the_weight_one_and_rows_of_a_sample_stay_together() -> None:
    weights = bootstrap_weights(np.array([1.0, 1.0, 0.0, 2.0]), np.array([0, 0, 1, 2]))
    assert weights.shape == (BOOTSTRAPS, 4)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)
    np.testing.assert_allclose(weights[:, 0], weights[:, 1])
    assert not weights[:, 2].any()


def test_the_error_of_a_mean_is_that_of_the_samples_not_of_their_rows() -> None:
    """σ/√n of 400 samples of ten rows each, within 10 %: that of a deviation over 200 ensembles."""
    values = np.random.default_rng(5).normal(size=400)
    weights = bootstrap_weights(np.ones(4000), np.repeat(np.arange(400), 10))
    error = np.std(weights @ np.repeat(values, 10), ddof=1)
    assert abs(error / (np.std(values) / np.sqrt(400.0)) - 1.0) < 0.15
