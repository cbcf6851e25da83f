"""Draws until enough of them agree with the published level, and those that go on."""

from itertools import repeat

import numpy as np
import pytest

from vibroacoustics.levels.agreement import priors_of
from vibroacoustics.machine.remainder import Remainder
from vibroacoustics.study.uncertainty import Range
from vibroacoustics.uncertainty.bank import MOST_DRAWS, MOST_ROUNDS, bank_of

PRIORS = priors_of(Remainder())
GAIN = Range(table="variation", field="mobility_change_db", lowest=-10.0, highest=10.0)


def batches_of(size):
    return repeat([{("variation", "mobility_change_db"): 0.0}] * size)


def batches():
    rng = np.random.default_rng(3)
    while True:
        yield [{("variation", "mobility_change_db"): x} for x in rng.uniform(-10.0, 10.0, 20)]


def as_drawn(batch, before, expected):
    """The drawn gain is the level over the published one."""
    assert expected > before + len(batch)
    return np.array([draw["variation", "mobility_change_db"] for draw in batch])


def test_draws_are_added_until_enough_are_effective():
    bank = bank_of(batches(), as_drawn, 2.0, PRIORS, wanted=20)
    assert 20.0 <= bank.effective < 40.0
    assert len(bank.draws) > 20
    assert bank.suffices
    labelled = bank.labelled([GAIN], 56.0)
    assert labelled["bank_weight"].values == pytest.approx(bank.weight)
    assert labelled["bank_level"].values == pytest.approx(bank.modelled_db + 56.0)
    assert labelled["bank_value"].values[:, 0] == pytest.approx(bank.modelled_db)


def test_chosen_draws_stand_for_the_weights():
    bank = bank_of(batches(), as_drawn, 2.0, PRIORS, wanted=400)
    index, weight = bank.chosen(seed=6)
    assert weight.sum(axis=1) == pytest.approx([1.0, 1.0])
    share = bank.weight[0] / bank.weight[0].sum()
    # Systematic resampling: every draw as often as its weight says, but for a rounding.
    assert np.all(np.abs(weight[0] - share[index]) * 400 <= 1.0 + 1e-9)
    for row, all_weights in zip(weight, bank.weight, strict=True):
        mean = np.average(bank.modelled_db, weights=all_weights)
        assert row @ bank.modelled_db[index] == pytest.approx(mean, abs=0.15)


def test_a_model_that_never_agrees_does_not_suffice():
    bank = bank_of(batches(), lambda b, *_: np.full(len(b), np.nan), 2.0, PRIORS, wanted=20)
    assert len(bank.draws) == 20 * MOST_ROUNDS
    assert bank.effective == 0.0
    assert not bank.suffices
    more = bank_of(batches_of(2000), lambda b, *_: np.full(len(b), np.nan), 2.0, PRIORS, 2000)
    assert len(more.draws) == MOST_DRAWS
    mostly = np.array([0.0, 40.0, 40.0, 40.0])
    few = bank_of(repeat([{}] * 4), lambda *_: mostly, 2.0, PRIORS, wanted=100)
    assert not few.suffices
