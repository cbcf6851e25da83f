"""Samples until enough of them are effective, and those that go on."""

from itertools import repeat

import numpy as np
import pytest

from vibroacoustics.levels.agreement import PRIOR_NAMES
from vibroacoustics.study.uncertainty import Range
from vibroacoustics.uncertainty.prior_ensemble import (
    MOST_ROUNDS,
    MOST_SAMPLES,
    Weighted,
    prior_ensemble_of,
)

GAIN = Range(table="variation", field="mobility_change_db", lowest=-10.0, highest=10.0)


def batches_of(size):
    return repeat([{("variation", "mobility_change_db"): 0.0}] * size)


def batches():
    rng = np.random.default_rng(3)
    while True:
        yield [{("variation", "mobility_change_db"): x} for x in rng.uniform(-10.0, 10.0, 20)]


def by_gain(batch, before, expected):
    """The sampled gain is the level relative to the published one."""
    assert expected > before + len(batch)
    gain = np.array([sample["variation", "mobility_change_db"] for sample in batch])
    near = -0.5 * (gain / 2.0) ** 2
    return Weighted(
        [{}] * len(batch), [None] * len(batch), gain, np.array([near, near - 0.1 * gain])
    )


def without_solution(batch, *_):
    none = np.full((2, len(batch)), -np.inf)
    return Weighted([{}] * len(batch), [None] * len(batch), np.full(len(batch), np.nan), none)


def test_samples_are_added_until_enough_are_effective():
    ensemble = prior_ensemble_of(batches(), by_gain, PRIOR_NAMES, wanted=20)
    assert 20.0 <= ensemble.effective < 40.0
    assert len(ensemble.samples) > 20
    assert ensemble.suffices
    labelled = ensemble.labelled([GAIN], 56.0)
    assert labelled["prior_sample_weight"].values == pytest.approx(ensemble.weight)
    assert ensemble.weight.max(axis=1).tolist() == [1.0, 1.0]
    assert labelled["prior_sample_level"].values == pytest.approx(ensemble.modelled_db + 56.0)
    assert labelled["prior_sample_value"].values[:, 0] == pytest.approx(ensemble.modelled_db)


def test_chosen_samples_are_as_many_as_their_weights_say():
    """Systematic resampling: every sample as often as its weight says, but for a rounding."""
    ensemble = prior_ensemble_of(batches(), by_gain, PRIOR_NAMES, wanted=400)
    index, count = ensemble.chosen(seed=6)
    share = ensemble.weight[0] / ensemble.weight[0].sum()
    assert count.sum() == 400
    assert np.all(np.abs(count - 400 * share[index]) <= 1.0 + 1e-9)


def test_weights_far_from_the_data_count_relative_to_one_another():
    """All samples 100 dB too loud: that is for the conflict with the prior to say."""

    def far(batch, before, expected):
        near = by_gain(batch, before, expected)
        return near._replace(log_weight=near.log_weight - 1250.0)

    near, away = (
        prior_ensemble_of(batches(), one, PRIOR_NAMES, wanted=20) for one in (by_gain, far)
    )
    assert away.weight == pytest.approx(near.weight)


def test_a_model_without_solutions_does_not_suffice():
    ensemble = prior_ensemble_of(batches(), without_solution, PRIOR_NAMES, wanted=20)
    assert len(ensemble.samples) == 20 * MOST_ROUNDS
    assert ensemble.effective == 0.0
    assert not ensemble.suffices
    more = prior_ensemble_of(batches_of(2000), without_solution, PRIOR_NAMES, 2000)
    assert len(more.samples) == MOST_SAMPLES
