"""Bands through the chain hold the truth of synthetic machines as often as they say.

Machines are drawn from the prior; the "catalogue" of each is its own level with noise. One bank of
draws serves all: weights differ, not runs. A machine's own draw does not count for its bands.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from drawn_chain import DrawnChain
from sources_study import SOURCES_STUDY, made_up_modes
from support import ROOT

from vibroacoustics.base.decibel import level_of_power, power_of_level
from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.levels.agreement import Prior, agreement, effective_draws, remainder_level
from vibroacoustics.study.loading import load_study

DEVIATION_DB = 2.0
BELOW_DB, ABOVE_DB = 26.0, 4.0
"""Flat prior of the remainder about the middle of what is modelled."""
ENDS = (0.05, 0.95)


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
        assert list(chain.axes.options)[0] == "none"
        modelled, growth = chain.mean_squares(chain.hypercube(count))
        solved = np.isfinite(modelled).all(axis=(1, 2))
        modelled, growth = modelled[solved], growth[solved]
        return cls(modelled / np.median(modelled[:, 0, 0]), growth / growth[:, :1, :1])

    def published_at(self, speed):
        """The same with the published level at another speed."""
        scale = np.median(self.modelled[:, speed, 0])
        return Bank(self.modelled / scale, self.growth / self.growth[:, speed, 0][:, None, None])


def held(bank, machines, speed=0):
    """How often the bands hold the truth, (speed, option): level of none, changes of others.

    Parameters
    ----------
    bank : all draws; the first so many are the machines
    machines : how many
    speed : number of the speed of the published level

    Returns
    -------
    counts, number of machines whose draws suffice, mean width of the bands with the published
    level over that without
    """
    rng = np.random.default_rng(4)
    bank = bank.published_at(speed)
    rest = rng.uniform(-BELOW_DB, ABOVE_DB, machines)
    noise = rng.normal(0.0, DEVIATION_DB, machines)
    count, number, narrower = np.zeros(bank.modelled.shape[1:], int), 0, []
    for machine in range(machines):
        truth = quantities(
            bank.modelled[machine], bank.growth[machine] * power_of_level(rest[machine])
        )
        published = truth[speed, 0] + noise[machine]
        others = np.arange(len(bank.modelled)) != machine
        weight, values = weighed(bank, published, speed, rng)
        if effective_draws(weight[others]) < 16.0:
            continue
        low, high = weighted_quantiles(values[others], weight[others], ENDS)
        first, last = weighted_quantiles(values[others], np.ones(others.sum()), ENDS)
        count += (low <= truth) & (truth <= high)
        narrower.append(((high - low) / (last - first))[speed, 0])
        number += 1
    return count, number, float(np.mean(narrower))


def weighed(bank, published_db, speed, rng):
    """Weights of the draws and their quantities, (draw, speed, option)."""
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
        count, number, narrower = held(bank, 40, speed)
        assert number >= 36
        assert np.all(count >= 0.9 * number - 3.0 * np.sqrt(0.09 * number)), count
        assert 0.84 <= count.mean() / number <= 0.96
        print(count, number, narrower)
        assert narrower < 0.7


@pytest.mark.long
def test_coverage_of_the_inner_sources():
    """Four hundred machines with gas, keys and motor, at both speeds and with all options.

    The published level at one speed, then at the other: each time the other speed is foretold.
    """
    study = load_study(ROOT / "tests" / "studies" / "sources_small.toml")
    bank = Bank.of(study.replace({"operation.stopping": False}), 800)
    for speed in (0, 1):
        count, number, narrower = held(bank, 400, speed)
        print(f"\npublished at speed {speed}: {number} machines, bands {narrower:.2f} as wide")
        print(count)
        assert number == 400
        assert 344 <= count[speed, 0] <= 376
        assert count.min() >= 330
        assert count.max() <= 385
        assert 350 <= count.mean() <= 370
