"""Shares of unknowns, labelled: of the level of a bank, of changes over its draws."""

import numpy as np
import pytest
import xarray as xr
from sources_study import SOURCES_STUDY

from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.sampling import latin_hypercubes, position_in_range
from vibroacoustics.uncertainty.bank import Bank, Weighted
from vibroacoustics.uncertainty.draws import drawn_values
from vibroacoustics.uncertainty.share_variables import REMAINDER, change_shares, level_shares

DRAWS = 100
GAIN, PITCH = "variation.mobility_change_db", "mounts.pitch_m"


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY)


@pytest.fixture(scope="module")
def draws(study):
    settings = study.uncertainty.model_copy(update={"random_samples": DRAWS})
    return next(latin_hypercubes(study.ranges, settings))


def position(study, draws, name):
    (limits,) = (one for one in study.ranges if one.name == name)
    return position_in_range(limits, np.array([draw[one_key(name)] for draw in draws]))


def one_key(name):
    table, _, field = name.rpartition(".")
    return table, field


def test_level_shares_before_and_after(study, draws):
    """The level is the gain, and the mounts' a little; without enough weight only before."""
    level = 10.0 * position(study, draws, GAIN) + 3.0 * position(study, draws, PITCH)
    alike, few = (
        Bank(draws, Weighted([], [], level, np.full((2, DRAWS), one)), DRAWS)
        for one in (0.0, -np.inf)
    )
    labelled = level_shares(study.ranges, alike, np.ones(DRAWS))
    for knowledge in ("before", "flat", "near"):
        share = labelled["level_share"].sel(knowledge=knowledge)
        assert float(share.sel(drawn_parameter=GAIN)) == pytest.approx(100.0 / 109.0, abs=0.02)
        assert float(share.sel(drawn_parameter=PITCH)) == pytest.approx(9.0 / 109.0, abs=0.02)
        assert float(labelled["level_share_quality"].sel(knowledge=knowledge)) > 0.99
    few = level_shares(study.ranges, few, np.ones(DRAWS))
    assert np.isfinite(few["level_share_quality"].values).tolist() == [True, False, False]


def test_change_shares_know_the_remainder_too(study, draws):
    """At the speed nearest to that of the published level, in whatever order the speeds are."""
    rest = np.random.default_rng(3).permutation(np.linspace(30.0, 50.0, DRAWS))
    axes = {"draw": np.arange(1, DRAWS + 1), "speed": [3500.0, 2950.0, 3200.0]}
    axes |= {"option": ["none", "damping"], "receiver": ["front_1m"]}
    total = np.full((DRAWS, 3, 2, 1), 56.0)
    total[:, 1, 1, 0] += 4.0 * position(study, draws, GAIN) + 0.2 * (rest - 40.0)
    prior = {"prior": ["flat", "near"], "draw": axes["draw"]}
    made = {
        "level_total_by_draw": stamp("level_total_by_draw", total, axes),
        "level_remainder_by_draw": stamp("level_remainder_by_draw", rest, {"draw": axes["draw"]}),
        "draw_weight": stamp("draw_weight", np.full((2, DRAWS), 1.0 / DRAWS), prior),
    }
    labelled = change_shares(study, xr.Dataset(made).merge(drawn_values(study.ranges, draws)))
    share = labelled["change_share"].sel(option="damping")
    assert float(share.sel(unknown=GAIN)) == pytest.approx(0.8, abs=0.03)  # 16/3 beside 4/3
    assert float(share.sel(unknown=REMAINDER)) == pytest.approx(0.2, abs=0.03)
    assert float(labelled["change_variance"].sel(option="damping")) == pytest.approx(6.67, rel=0.2)
    assert float(labelled["change_variance"].sel(option="none")) == 0.0
    assert np.isnan(labelled["change_share"].sel(option="none")).all()
