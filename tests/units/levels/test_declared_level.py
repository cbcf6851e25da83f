"""Upper limit of a declared level: closed forms of ISO 4871 and of normal and split samples."""

import numpy as np
import pytest
from scipy import stats

from vibroacoustics.levels.declared_level import combined_deviation_db, upper_limit_db


def test_deviations_of_measurement_and_batch_add_as_squares() -> None:
    assert combined_deviation_db(None) == 1.5
    assert combined_deviation_db(2.0) == 2.5


def test_equal_samples_give_the_formula_of_a_single_machine() -> None:
    limit = upper_limit_db(np.full(7, 60.0), np.full(7, 1.0 / 7.0), 1.5)
    assert limit == pytest.approx(60.0 + 1.6449 * 1.5, abs=1e-3)


@pytest.mark.parametrize("deviation_db", [0.5, 1.5, 2.5])
def test_normal_samples_add_as_squares(deviation_db: float) -> None:
    quantile = (np.arange(4000) + 0.5) / 4000.0
    level = 60.0 + 2.0 * stats.norm.ppf(quantile)
    limit = upper_limit_db(level, np.full(4000, 1.0 / 4000.0), deviation_db)
    assert limit == pytest.approx(60.0 + 1.6449 * np.hypot(2.0, deviation_db), abs=0.01)


def test_weights_count_and_samples_without_weight_do_not() -> None:
    level = np.array([60.0, 90.0, 60.0])
    limit = upper_limit_db(level, np.array([0.25, 0.0, 0.75]), 1.5)
    assert limit == pytest.approx(60.0 + 1.6449 * 1.5, abs=1e-3)


def test_a_mixture_is_below_its_limit_in_95_percent() -> None:
    """Of skewed samples, by random numbers."""
    rng = np.random.default_rng(3)
    level, weight = rng.gamma(2.0, 2.0, 300), rng.dirichlet(np.ones(300))
    limit = upper_limit_db(level, weight, 1.5)
    measured = rng.choice(level, 200_000, p=weight) + rng.normal(0.0, 1.5, 200_000)
    assert np.mean(measured <= limit) == pytest.approx(0.95, abs=0.003)


def test_two_clusters_are_not_below_the_quantile_of_the_samples() -> None:
    """The 95 % quantile is low in the upper cluster: scatter alone would lower the limit."""
    level = np.concatenate([np.zeros(90), np.linspace(20.0, 20.2, 10)])
    limit = upper_limit_db(level, np.full(100, 0.01), 1.5)
    assert limit >= np.quantile(level, 0.95) - 0.05
