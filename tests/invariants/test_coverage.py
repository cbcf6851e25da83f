"""Bands through the chain hold the truth of synthetic machines as often as they say.

Machines are drawn from the prior; the "catalogue" of each is its own level with noise. One bank of
draws serves all: weights differ, not runs. A machine's own draw does not count for its bands.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np
import pytest
from drawn_chain import DrawnChain
from sources_study import SOURCES_STUDY, made_up_modes
from support import ROOT

from vibroacoustics.base.decibel import level_of_power, power_of_level
from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.levels.agreement import Prior, agreement, remainder_level
from vibroacoustics.study.loading import load_study
from vibroacoustics.uncertainty.bank import Bank as DrawBank

DEVIATION_DB = 2.0
BELOW_DB, ABOVE_DB = 26.0, 4.0
"""Flat prior of the remainder about the middle of what is modelled."""
ENDS = (0.05, 0.95)
NOISE_DB = 2.0 * 1.645 * DEVIATION_DB
"""Width of the band of the published level alone."""


@dataclass(frozen=True)
class Bank:
    """Draws through the chain; levels in dB over the middle of those at the published speed.

    Attributes
    ----------
    modelled : shape (draw, speed, option), the first option none; mean squares
    growth : of the remainder with speed and option, over that at the first speed, same shape
    """

    modelled: np.ndarray
    growth: np.ndarray

    @classmethod
    def of(cls, study, count, radiation=None):
        chain = DrawnChain.of(study, radiation)
        assert next(iter(chain.axes.options)) == "none"
        modelled, growth = chain.mean_squares(chain.hypercube(count))
        solved = np.isfinite(modelled).all(axis=(1, 2))
        modelled, growth = modelled[solved], growth[solved]
        return cls(modelled / np.median(modelled[:, 0, 0]), growth / growth[:, :1, :1])

    def published_at(self, speed):
        """The same with the published level at another speed."""
        scale = np.median(self.modelled[:, speed, 0])
        return Bank(self.modelled / scale, self.growth / self.growth[:, speed, 0][:, None, None])


def held(bank, machines, speed=0, wanted=None):
    """How often the bands hold the truth, (speed, option): level of none, changes of others.

    Parameters
    ----------
    bank : all draws; the first so many are the machines
    machines : how many
    speed : number of the speed of the published level
    wanted : draws that go on, as in a run; none for all

    Returns
    -------
    counts; how many are expected, 0.9 (n - 1) / (n + 1) for quantiles of n equal draws; mean width
    of the band of the level, dB
    """
    rng = np.random.default_rng(4)
    bank = bank.published_at(speed)
    rest = rng.uniform(-BELOW_DB, ABOVE_DB, machines)
    noise = rng.normal(0.0, DEVIATION_DB, machines)
    count, expected, width = np.zeros(bank.modelled.shape[1:], int), 0.0, 0.0
    for machine in range(machines):
        remaining = bank.growth[machine] * power_of_level(rest[machine])
        truth = quantities(bank.modelled[machine], remaining)
        weight, values = weighed(bank, truth[speed, 0] + noise[machine], speed, rng)
        weight[machine] = 0.0
        if wanted is not None:
            index, (weight,) = DrawBank([], weight, weight[None], wanted).chosen(machine)
            values = values[index]
        low, high = weighted_quantiles(values, weight, ENDS)
        count += (low <= truth) & (truth <= high)
        effective = weight.sum() ** 2 / (weight**2).sum()
        expected += 0.9 * (effective - 1.0) / (effective + 1.0)
        width += (high - low)[speed, 0] / machines
    return count, expected, width


def weighed(bank, published_db, speed, rng):
    """Weights of the draws and their quantities, (draw,) and (draw, speed, option)."""
    prior = Prior("fixed", "", lambda level: about(level + published_db))
    over = level_of_power(bank.modelled[:, speed, 0]) - published_db
    share = rng.permutation((np.arange(over.size) + 0.5) / over.size)
    rest = published_db + remainder_level(over, DEVIATION_DB, prior, share)
    remaining = bank.growth * power_of_level(rest)[:, None, None]
    return agreement(over, DEVIATION_DB, prior), quantities(bank.modelled, remaining)


def about(level_db):
    return np.where((level_db >= -BELOW_DB) & (level_db <= ABOVE_DB), 1.0, 0.0)


def quantities(modelled, remaining):
    """Level of none, and changes of the other options, shape (..., option), dB."""
    level = level_of_power(modelled + remaining)
    return np.concatenate([level[..., :1], level[..., 1:] - level[..., :1]], axis=-1)


def test_coverage_of_a_small_chain():
    """Forty machines of moving parts and unbalance; three deviations of a binomial count."""
    small = {
        "operation.speed_rpm": [2900.0, 3500.0],
        "operation.supply_frequency_hz": None,
        "operation.stopping": False,
        "options.damping": None,
        **{f"sources.{name}": None for name in ("gas", "keys", "motor", "torque_ripple")},
        "sources.unbalance.kind": "residual-unbalance",
    }
    study = load_study(SOURCES_STUDY).replace(small)
    bank = Bank.of(study, 80, lambda one, *_: (made_up_modes(one), False))
    for speed in (0, 1):
        count, expected, width = held(bank, 40, speed)
        assert 31.0 < expected < 36.0
        assert np.all(np.abs(count - expected) <= 3.0 * np.sqrt(0.09 * 40)), count
        assert abs(count.mean() - expected) < 3.0
        assert width < NOISE_DB


@pytest.mark.long
def test_coverage_of_the_inner_sources():
    """Four hundred machines with gas, keys and motor, at both speeds and with all options.

    The published level at one speed, then at the other: each time the other speed is foretold.
    With all draws, and with a hundred that go on.
    """
    study = load_study(ROOT / "tests" / "studies" / "sources_small.toml")
    bank = Bank.of(study.replace({"operation.stopping": False}), 500)
    for speed, wanted in product((0, 1), (None, 100)):
        count, expected, width = held(bank, 400, speed, wanted)
        changes = np.delete(count, 0, axis=1)
        print(f"\nspeed {speed}, draws {wanted}: of {expected:.0f}, {width:.1f} dB wide")
        print(count)
        assert width < NOISE_DB
        assert np.all((count[:, 0] >= 344) & (count[:, 0] <= 376))
        assert np.all((changes >= 330) & (changes <= 385))
        assert 350 <= count.mean() <= 370
