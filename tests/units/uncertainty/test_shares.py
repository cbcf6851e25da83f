"""Shares of unknowns in the band: analytic functions, weights, pick-freeze on the chain."""

import numpy as np
import pytest
from drawn_chain import DrawnChain, of_few_ranges
from scipy.stats import qmc
from sources_study import SOURCES_STUDY, made_up_modes

from vibroacoustics.report.unknowns import RESOLVED
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.sampling import draw_at, latin_hypercubes, position_in_range
from vibroacoustics.study.uncertainty import Range, Uncertainty
from vibroacoustics.uncertainty.shares import LEAST_DRAWS, shares_of

FACTORS = np.array([0.0, 1.0, 4.5, 9.0, 99.0])
CHAIN = {
    "variation.mobility_change_db",
    "structure.loss_factor_ratio",
    "structure.density_kg_per_m3",
    "structure.bearing_housing.height_m",
    "gas.polytropic_index",
}


def hypercube(draws, unknowns, seed=0):
    return 2.0 * qmc.LatinHypercube(unknowns, rng=seed).random(draws) - 1.0


def ishigami(unit):
    first, second, third = (np.pi * unit[:, :3]).T
    return np.sin(first) + 7.0 * np.sin(second) ** 2 + 0.1 * third**4 * np.sin(first)


def additive_g(unit):
    """Sobol's g-function as a sum: (|4 x - 2| + a) / (1 + a) of x from 0 to 1."""
    return ((2.0 * np.abs(unit[:, :5]) + FACTORS) / (1.0 + FACTORS)).sum(axis=1)


@pytest.mark.parametrize("seed", range(3))
def test_additive_g_function_is_resolved(seed):
    """Var of each term is 1/3 / (1 + a)²; five unknowns more that do nothing."""
    unit = hypercube(256, 10, seed)
    shares = shares_of(unit, additive_g(unit), np.ones(256))
    variance = 1.0 / (1.0 + FACTORS) ** 2
    exact = np.concatenate([variance / variance.sum(), np.zeros(5)])
    assert shares.quality > 0.98
    assert shares.variance == pytest.approx(variance.sum() / 3.0, rel=0.1)
    assert shares.share == pytest.approx(exact, abs=0.02)


def test_ishigami_is_not_resolved():
    """Shares of first order 0.314, 0.442 and 0 (Ishigami and Homma 1990); their sum is Q²."""
    unit = hypercube(1024, 5)
    shares = shares_of(unit, ishigami(unit), np.ones(1024))
    assert 0.7 < shares.quality < RESOLVED
    assert shares.share == pytest.approx([0.314, 0.442, 0.0, 0.0, 0.0], abs=0.02)


def test_weights_make_unknowns_hang_together():
    """What one tells of the other counts: against sums over a fine grid."""
    unit = hypercube(1000, 3)
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
    assert shares.share[2] < 0.01


def weights(first, second):
    return np.exp(-0.5 * ((first - second) / 0.3) ** 2)


def test_chance_is_no_share():
    """Eighty unknowns that do nothing, and a value that is noise."""
    unit = hypercube(100, 80)
    shares = shares_of(unit, np.random.default_rng(1).normal(size=100), np.ones(100))
    assert shares.quality < 0.1
    assert np.all(shares.share < 0.01)


def test_too_few_draws_tell_nothing():
    unit = hypercube(LEAST_DRAWS, 2)
    few = np.where(np.arange(LEAST_DRAWS) == 3, np.nan, unit[:, 0])
    for value, weight in ((few, 1.0), (unit[:, 0], 0.0), (0.0 * few, 1.0), (np.ones(16), 1.0)):
        shares = shares_of(unit, value, np.full(LEAST_DRAWS, weight))
        assert np.isnan(shares.share).all()
        assert np.isnan(shares.quality)


@pytest.mark.long
def test_position_in_range_is_what_the_draws_were_made_of():
    wide = Range(table="gas", field="a", lowest=0.01, highest=1.0)
    narrow = Range(table="gas", field="b", lowest=-2.0, highest=2.0)
    settings = Uncertainty(random_samples=200)
    draws = next(latin_hypercubes([wide, narrow], settings))
    for limits in (wide, narrow):
        position = position_in_range(
            limits, np.array([draw["gas", limits.field] for draw in draws])
        )
        assert np.sort(position) == pytest.approx(np.linspace(-0.995, 0.995, 200), abs=0.0051)


@pytest.mark.long
def test_shares_of_the_chain_are_those_of_pick_freeze():
    """Gas through the elastic shell, five unknowns, against Jansen's estimate of first order.

    Saltelli et al. 2010, Computer Physics Communications 181, table 2, (c).
    """
    study = load_study(SOURCES_STUDY)
    alone = {f"sources.{name}": None for name in ("keys", "motor", "torque_ripple")}
    study = study.replace({**alone, "operation.supply_frequency_hz": None})
    study = of_few_ranges(study.replace({"operation.stopping": False}), CHAIN)
    chain = DrawnChain.of(study, lambda one, *_: (made_up_modes(one), False))
    draws = chain.hypercube(256)
    unit = np.transpose(
        [
            position_in_range(one, np.array([draw[one.table, one.field] for draw in draws]))
            for one in study.ranges
        ]
    )
    shares = shares_of(unit, chain.modelled_db(draws), np.ones(256))
    frozen = pick_freeze(chain, 512)
    print(
        f"\nQ2 {shares.quality:.3f}, shares {shares.share.round(3)}, pick-freeze {frozen.round(3)}"
    )
    assert shares.quality >= RESOLVED
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
    """Modelled level of draws at these shares of the ranges, shape (draw,), dB."""
    return chain.modelled_db([draw_at(chain.study.ranges, row) for row in shares])
