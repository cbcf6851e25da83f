"""Weights of draws by the published level, and the remainder that they leave."""

import numpy as np
import pytest
from scipy.integrate import quad

from vibroacoustics.levels.agreement import (
    Prior,
    agreement,
    effective_draws,
    priors_of,
    remainder_level,
)
from vibroacoustics.machine.remainder import Remainder

DEVIATION_DB = 2.0
PRIORS = priors_of(Remainder())
FLAT, NEAR = PRIORS
EDGES = [-26.0, 4.0]


def integrand(level_db, modelled_db, prior):
    total = 10.0 * np.log10(10.0 ** (modelled_db / 10.0) + 10.0 ** (level_db / 10.0))
    return float(prior.density(np.array(level_db))) * np.exp(-0.5 * (total / DEVIATION_DB) ** 2)


@pytest.mark.parametrize("prior", PRIORS, ids=lambda prior: prior.name)
def test_weights_are_the_integrals_over_the_prior(prior):
    modelled = np.array([-40.0, -10.0, -3.0, 0.0, 2.0, 6.0])
    exact = [
        quad(integrand, -40.0, 10.0, (level, prior), points=EDGES, limit=200)[0]
        for level in modelled
    ]
    weight = agreement(modelled, DEVIATION_DB, prior)
    # a step of 0.05 dB; the edges of the flat prior lie on it
    assert weight / weight[0] == pytest.approx(np.array(exact) / exact[0], rel=5e-3)
    assert np.all((weight > 0.0) & (weight < 1.0))


def test_priors_are_settings_of_the_machine():
    """Their words and densities follow; limits that are no range are refused in one line."""
    given = Remainder(flat_lowest_db=-10.0, flat_highest_db=0.0, near_level_db=1.0)
    flat, near = priors_of(given)
    assert flat.words == "anywhere from 10 dB below to 0 dB above the published level"
    assert near.words == "1 dB above the published level, give or take 3 dB"
    level = np.array([-11.0, -9.0, 1.0])
    assert flat.density(level).tolist() == [0.0, 1.0, 0.0]
    assert near.density(level).argmax() == 2
    with pytest.raises(ValueError, match=r"flat_lowest_db = 3\.5 dB: must be at least 1 dB below"):
        Remainder(flat_lowest_db=3.5)


def test_a_loud_draw_counts_less_and_one_without_solution_not_at_all():
    weight = agreement(np.array([0.0, 4.0, 8.0, np.nan]), DEVIATION_DB, FLAT)
    assert np.all(np.diff(weight) < 0.0)
    assert weight[3] == 0.0


def test_remainder_completes_a_draw_to_the_published_level():
    """Its middle; of one that reaches the level alone it is anywhere below."""
    share = np.full(3, 0.5)
    level = remainder_level(np.array([-40.0, -3.0, 0.0]), 0.2, FLAT, share)
    assert level[0] == pytest.approx(0.0, abs=0.1)
    assert level[1] == pytest.approx(10.0 * np.log10(1.0 - 10.0**-0.3), abs=0.1)
    assert level[2] < -12.0
    low, high = (remainder_level(np.zeros(1), 2.0, NEAR, np.array([s]))[0] for s in (0.0, 1.0))
    assert low < -8.0 < 0.0 < high


def test_effective_draws():
    assert effective_draws(np.ones(7)) == pytest.approx(7.0)
    assert effective_draws(np.array([0.5, 0.0])) == pytest.approx(1.0)
    alike = agreement(np.full(5, 12.0), DEVIATION_DB, FLAT)  # all six deviations too loud
    assert effective_draws(alike) == 0.0
    assert effective_draws(np.zeros(3)) == 0.0


@pytest.mark.parametrize("machines", [pytest.param(400, marks=pytest.mark.long), 40])
@pytest.mark.long
def test_bands_hold_the_truth_as_often_as_they_say(machines):
    """Machines from the prior, their published level with noise, one bank of draws for all.

    Modelled 56 ± 6 dB(A), a flat remainder of 30 to 60: bands of 90 % of both, and of the total.
    Within three deviations of a binomial count.
    """
    rng = np.random.default_rng(11)
    bank = rng.normal(56.0, 6.0, 2000)
    modelled, rest = rng.normal(56.0, 6.0, machines), rng.uniform(30.0, 60.0, machines)
    total = 10.0 * np.log10(10.0 ** (modelled / 10.0) + 10.0 ** (rest / 10.0))
    published = total + rng.normal(0.0, DEVIATION_DB, machines)
    held = np.zeros(3)
    for truth in zip(modelled, rest, total, published, strict=True):
        prior = Prior("fixed", "", lambda level, at=truth[3]: fixed(level + at))
        weight = agreement(bank - truth[3], DEVIATION_DB, prior)
        share = rng.permutation((np.arange(bank.size) + 0.5) / bank.size)
        left = truth[3] + remainder_level(bank - truth[3], DEVIATION_DB, prior, share)
        whole = 10.0 * np.log10(10.0 ** (bank / 10.0) + 10.0 ** (left / 10.0))
        for number, values in enumerate((bank, left, whole)):
            low, high = weighted_quantiles(values, weight, (0.05, 0.95))
            held[number] += low <= truth[number] <= high
    spread = 3.0 * np.sqrt(machines * 0.9 * 0.1)
    assert np.all(np.abs(held - 0.9 * machines) <= spread), held


def fixed(level_db):
    return np.where((level_db >= 30.0) & (level_db <= 60.0), 1.0, 0.0)


def weighted_quantiles(values, weight, shares):
    order = np.argsort(values)
    return values[order][np.searchsorted(np.cumsum(weight[order]) / weight.sum(), shares)]
