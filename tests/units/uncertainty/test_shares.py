"""Shares of unknowns in the band: analytic functions, weights, pick-freeze on the chain."""

import numpy as np
import pytest
from sampled_chain import SampledChain, of_few_ranges
from scipy.stats import qmc
from sources_study import SOURCES_STUDY, made_up_modes

from vibroacoustics.study.loading import load_study
from vibroacoustics.study.sampling import sample_at
from vibroacoustics.uncertainty.shares import ASKED, BINS, information_of, shares_of

FACTORS = np.array([0.0, 1.0, 4.5, 9.0, 99.0])
CHAIN = {
    "variation.mobility_change_db",
    "structure.loss_factor_ratio",
    "structure.density_kg_per_m3",
    "structure.bearing_housing.height_m",
    "gas.polytropic_index",
}


def hypercube(samples, unknowns, seed=0):
    return 2.0 * qmc.LatinHypercube(unknowns, rng=seed).random(samples) - 1.0


def ishigami(unit):
    first, second, third = (np.pi * unit[:, :3]).T
    return np.sin(first) + 7.0 * np.sin(second) ** 2 + 0.1 * third**4 * np.sin(first)


def additive_g(unit):
    """Sobol's g-function as a sum: (|4 x - 2| + a) / (1 + a) of x from 0 to 1."""
    return ((2.0 * np.abs(unit[:, :5]) + FACTORS) / (1.0 + FACTORS)).sum(axis=1)


def resolved(shares):
    return shares.low > shares.floor


def binned(values, bins=BINS):
    """Variance of the means of a function of an even grid in bins, over its variance."""
    means = values.reshape(bins, -1).mean(axis=1)
    return means.var() / values.var()


GRID = (np.arange(100000) + 0.5) / 50000.0 - 1.0


@pytest.mark.parametrize("seed", range(3))
def test_additive_g_function_is_resolved(seed):
    """Var of each term is 1/3 / (1 + a)²; five unknowns more that do nothing.

    Ten bins miss the variance within each. The deviation of a share s of n samples is about
    √(4 s (1 − s)² / n), at most 0.025.
    """
    unit = hypercube(1000, 10, seed)
    shares = shares_of(unit, additive_g(unit), np.ones(1000))
    variance = 1.0 / (1.0 + FACTORS) ** 2
    exact = binned(np.abs(GRID)) * variance / variance.sum()
    assert shares.share[:5] == pytest.approx(exact, abs=0.05)
    assert resolved(shares)[:2].all()
    assert not resolved(shares)[4:].any()
    assert np.all(shares.low <= shares.high)


def test_ishigami():
    """Shares of first order 0.314, 0.442 and 0 (Ishigami and Homma 1990), less what bins miss."""
    unit = hypercube(4096, 5)
    shares = shares_of(unit, ishigami(unit), np.ones(4096))
    exact = [0.314 * binned(np.sin(np.pi * GRID)), 0.442 * binned(np.sin(np.pi * GRID) ** 2)]
    assert shares.share == pytest.approx([*exact, 0.0, 0.0, 0.0], abs=0.02)
    assert resolved(shares).tolist() == [True, True, False, False, False]


def test_weights_make_unknowns_depend_on_one_another():
    """What one tells of the other counts: against sums over a fine grid."""
    unit = hypercube(4000, 3)
    value = 2.0 * unit[:, 0] + unit[:, 1]
    shares = shares_of(unit, value, weights(unit[:, 0], unit[:, 1]))
    grid = np.linspace(-1.0, 1.0, 401)
    first, second = np.meshgrid(grid, grid, indexing="ij")
    weight, exact = weights(first, second), 2.0 * first + second
    mean = np.average(exact, weights=weight)
    spread = np.average((exact - mean) ** 2, weights=weight)
    for axis in (0, 1):
        expected = np.average(exact, axis=1 - axis, weights=weight)
        known = np.average((expected - mean) ** 2, weights=weight.sum(axis=1 - axis)) / spread
        assert shares.share[axis] == pytest.approx(known, abs=0.03)
    assert shares.share[:2].sum() > 1.2  # each stands for the other in part
    assert not resolved(shares)[2]


def weights(first, second):
    return np.exp(-0.5 * ((first - second) / 0.3) ** 2)


def test_chance_has_no_share_in_the_mean():
    """The mean over many unknowns that do nothing is small.

    Without the correction of Kelley it is 9/200 = 0.045; clipped at zero, half of a deviation
    of √18/200 = 0.021 is left, 0.4 of it.
    """
    unit, value = hypercube(200, 400), np.random.default_rng(1).normal(size=200)
    shares = shares_of(unit, value, np.ones(200))
    assert shares.share.mean() < 0.4 * np.sqrt(18.0) / 200.0 * 1.3
    assert shares.share.max() < 1.5 * shares.floor


def test_chance_is_seldom_resolved():
    """Forty ensembles of eighty unknowns that do nothing, with unequal weights."""
    found = 0
    for seed in range(40):
        generator = np.random.default_rng(seed)
        unit, weight = hypercube(150, 80, seed), generator.exponential(size=150)
        found += resolved(shares_of(unit, generator.normal(size=150), weight)).any()
    assert found <= 2


def test_weighted_samples_count_as_so_many():
    """A sample of weight 3 is three samples, but for what chance adds."""
    unit, times = hypercube(2001, 2), np.arange(2001) % 3 + 1
    value = unit[:, 0] + 0.5 * unit[:, 1] ** 2
    weighted = shares_of(unit, value, times)
    repeated = shares_of(np.repeat(unit, times, axis=0), np.repeat(value, times), np.ones(4002))
    assert weighted.share == pytest.approx(repeated.share, abs=0.01)


def test_samples_without_solution_do_not_count():
    unit = hypercube(300, 3)
    value = np.where(np.arange(300) % 3 == 1, np.nan, unit[:, 0])
    solved = np.isfinite(value)
    shares = shares_of(unit, value, np.ones(300))
    assert shares.share == pytest.approx(
        shares_of(unit[solved], value[solved], np.ones(200)).share, abs=1e-12
    )


def test_nothing_is_resolved_where_nothing_varies_or_counts():
    unit = hypercube(50, 2)
    assert not resolved(shares_of(unit, np.ones(50), np.ones(50))).any()
    assert np.isnan(shares_of(unit, unit[:, 0], np.zeros(50)).share).all()
    few = shares_of(unit[:4], unit[:4, 0], np.ones(4))
    assert not resolved(few).any()


def test_options_as_an_unknown_stay_together():
    """Three equally frequent options: the share is that of their means."""
    generator = np.random.default_rng(2)
    option = generator.integers(3, size=3000).astype(float)
    value = np.array([0.0, 1.0, 4.0])[option.astype(int)] + generator.normal(size=3000)
    shares = shares_of(option[:, None], value, np.ones(3000))
    between = np.var([0.0, 1.0, 4.0])
    assert shares.share[0] == pytest.approx(between / (between + 1.0), abs=0.02)


def test_knowing_the_sign_of_a_gain_is_worth_a_quarter():
    """Gain uniform from -1 to 1 against doing nothing: E max(gain, 0) = 1/4."""
    unit = hypercube(2000, 20)
    utility = np.column_stack([np.zeros(2000), unit[:, 3] + unit[:, 7] ** 3])
    told = information_of(unit, utility, np.ones(2000))
    assert told.gain[3] == pytest.approx(0.25, abs=0.02)
    # Of the cube: E max(x³, 0) = 1/8.
    assert told.gain[7] == pytest.approx(0.125, abs=0.02)
    assert told.votes[3] == ASKED
    assert np.delete(told.gain, [3, 7]).max() < 0.04
    assert 0.0 < told.floor < 0.05


def test_knowledge_that_leaves_the_best_option_is_worth_nothing():
    unit = hypercube(500, 4)
    utility = np.column_stack([np.zeros(500), 3.0 + unit[:, 0]])
    told = information_of(unit, utility, np.ones(500))
    assert told.gain == pytest.approx(np.zeros(4), abs=1e-12)
    assert not (told.gain > told.floor + 1e-12).any()


def test_the_floor_is_seldom_passed_by_chance_in_five_of_five():
    """Sixty ensembles in which what an option gains depends on no unknown."""
    found = 0
    for seed in range(60):
        generator = np.random.default_rng(seed)
        utility = np.column_stack([np.zeros(90), generator.normal(size=90)])
        told = information_of(hypercube(90, 60, seed), utility, np.ones(90))
        best = told.gain.argmax()
        found += told.gain[best] > told.floor and told.votes[best] == ASKED
    assert found <= 3


@pytest.mark.long
def test_shares_of_the_chain_are_those_of_pick_freeze():
    """Gas through the elastic shell, five unknowns, against Jansen's estimate of first order.

    Saltelli et al. 2010, Computer Physics Communications 181, table 2, (c).
    """
    study = load_study(SOURCES_STUDY)
    alone = {f"sources.{name}": None for name in ("keys", "motor", "torque_ripple")}
    study = study.replace({**alone, "operation.supply_frequency_hz": None})
    study = of_few_ranges(study.replace({"operation.stopping": False}), CHAIN)
    chain = SampledChain.of(study, lambda one, *_: (made_up_modes(one), False))
    samples = chain.hypercube(1024)
    values = np.array(
        [[sample[one.table, one.field] for one in study.ranges] for sample in samples]
    )
    shares = shares_of(values, chain.modelled_db(samples), np.ones(1024))
    frozen = pick_freeze(chain, 512)
    print(f"\nshares {shares.share.round(3)}, pick-freeze {frozen.round(3)}")
    assert shares.share == pytest.approx(frozen, abs=0.05)


def pick_freeze(chain, count):
    """Shares of first order of a chain's ranges."""
    ranges = chain.study.ranges
    points = qmc.Sobol(2 * len(ranges), rng=2).random(count)
    first, second = points[:, : len(ranges)], points[:, len(ranges) :]
    of_first, of_second = level(chain, first), level(chain, second)
    spread = np.concatenate([of_first, of_second]).var()
    shares = []
    for number in range(len(ranges)):
        mixed = first.copy()
        mixed[:, number] = second[:, number]
        off = of_second - level(chain, mixed)
        shares.append(1.0 - np.mean(off**2) / (2.0 * spread))
    return np.array(shares)


def level(chain, shares):
    """Modelled level of samples at these shares of the ranges, shape (sample,), dB."""
    return chain.modelled_db([sample_at(chain.study.ranges, row) for row in shares])
