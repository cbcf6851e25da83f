"""Scores: fixed scales, ranks, ties, robustness; nothing may depend on which options are there."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from vibroacoustics import scoring
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import check, stamp
from vibroacoustics.study import criterion
from vibroacoustics.study.scoring import Scoring

CRITERIA = {
    "foot_force_1x_n": {"weight": 3.0, "best": 0.0, "worst": 1.0},
    "residual_moment_nm": {"weight": 2.0, "best": 0.0, "worst": 15.0},
    "level_change_db": {"weight": 2.0, "best": -20.0, "worst": 10.0},
    "speed_sensitivity_db": {"weight": 1.5, "best": 0.0, "worst": 10.0},
    "added_mass_kg": {"weight": 1.5, "best": 0.0, "worst": 0.2},
}
OPTIONS = ["none", "a", "b", "c", "d"]


def _settings(**criteria) -> Scoring:
    chosen = criteria or CRITERIA
    return Scoring.model_validate({"criteria": chosen, "random_weightings": 500})


def _results(options=OPTIONS, seed=1) -> xr.Dataset:
    """Made-up results; an option's numbers hang on its name only."""
    foot, moment, level, mass = [], [], [], []
    for option in options:
        generator = np.random.default_rng([seed, OPTIONS.index(option)])
        foot.append(generator.uniform(0.05, 1.0, (2, 4, 3)))
        moment.append(generator.uniform(0.0, 15.0, (2, 3)))
        level.append(generator.uniform(0.0, 30.0, (2, 2, 3)))
        mass.append(np.full((2, 1), generator.uniform(0.0, 0.2)))
    order = {"order": [0, 1, 2]}
    base = {"speed": [2900.0, 3500.0], "option": list(options)}

    def stacked(values):
        return np.stack(values, axis=1)

    return check(
        xr.Dataset(
            {
                "foot_force_amplitude": stamp(
                    "foot_force_amplitude", stacked(foot), {**base, **order}
                ),
                "moment_amplitude": stamp("moment_amplitude", stacked(moment), {**base, **order}),
                "level_modelled": stamp(
                    "level_modelled", stacked(level), {**base, "weighting": ["Z", "A", "C"]}
                ),
                "reported_figure": stamp(
                    "reported_figure", stacked(mass), {**base, "figure": ["added_mass_kg"]}
                ),
            }
        )
    )


def _value(name: str, results: xr.Dataset) -> xr.DataArray:
    return criterion.CRITERIA[name]().value(results)


# --- criteria ------------------------------------------------------------------------------------


def test_criteria_are_the_worst_case():
    results = _results()
    foot = results["foot_force_amplitude"].values[..., 1]
    np.testing.assert_array_equal(_value("foot_force_1x_n", results), foot.max(axis=(0, 2)))
    moment = results["moment_amplitude"].values[..., 1]
    np.testing.assert_array_equal(_value("residual_moment_nm", results), moment.max(axis=0))


def test_changes_of_none_are_zero():
    results = _results()
    assert _value("level_change_db", results).sel(option="none") == 0.0
    assert _value("speed_sensitivity_db", results).sel(option="none") == 0.0


def test_level_change_by_hand():
    results = _results(["none", "a"])
    level = results["level_modelled"]
    level.loc[{"option": "none"}] = 20.0
    level.loc[{"option": "a", "speed": 2900.0}] = 14.0
    level.loc[{"option": "a", "speed": 3500.0}] = 17.0
    assert _value("level_change_db", results).sel(option="a") == pytest.approx(-3.0)


def test_speed_sensitivity_by_hand():
    results = _results(["none", "a"])
    foot = results["foot_force_amplitude"]
    foot.loc[{"option": "none"}] = 1.0
    foot.loc[{"option": "a", "speed": 2900.0}] = 0.5
    foot.loc[{"option": "a", "speed": 3500.0}] = 0.05
    assert _value("speed_sensitivity_db", results).sel(option="a") == pytest.approx(20.0)


def test_a_perfect_option_still_gets_finite_scores():
    """No foot force at any speed: a change of -∞ dB at both, but no spread between them."""
    results = _results()
    results["foot_force_amplitude"].loc[{"option": "a"}] = 0.0
    scores = scoring.score(results, _settings())
    for name in ("criterion_value", "score", "rank", "first_place_share"):
        assert np.all(np.isfinite(scores[name])), name


def test_every_criterion_of_a_study_exists(thesis_study):
    assert set(thesis_study.scoring.criteria) <= set(criterion.CRITERIA)
    assert list(CRITERIA) == list(criterion.CRITERIA)[:5]  # a seed's weightings follow this order


# --- utilities -----------------------------------------------------------------------------------


@given(values=arrays(float, (4, 2), elements=st.floats(-1e3, 1e3)))
def test_utilities_are_shares(values):
    utility = scoring.utilities(values, np.array([0.0, -20.0]), np.array([1.0, 10.0]))
    assert np.all((utility >= 0.0) & (utility <= 1.0))


def test_utility_at_the_ends_and_the_middle():
    values = np.array([[-20.0], [10.0], [-5.0], [-99.0], [99.0]])
    utility = scoring.utilities(values, np.array([-20.0]), np.array([10.0]))
    np.testing.assert_allclose(utility[:, 0], [1.0, 0.0, 0.5, 1.0, 0.0])


def test_more_is_better_where_best_lies_above_worst():
    values = np.array([[3.0], [0.0], [1.0], [9.0]])
    utility = scoring.utilities(values, np.array([3.0]), np.array([0.0]))
    np.testing.assert_allclose(utility[:, 0], [1.0, 0.0, 1.0 / 3.0, 1.0])
    scale = {"weight": 1.0, "best": 3.0, "worst": 0.0}
    Scoring.model_validate({"criteria": {"added_mass_kg": scale}})
    with pytest.raises(ValueError, match="worst = 3: must differ from best"):
        Scoring.model_validate({"criteria": {"added_mass_kg": {**scale, "worst": 3.0}}})


def test_no_rank_is_made_of_what_is_no_number():
    results = _results()
    results["reported_figure"].loc[{"option": "a"}] = np.nan
    with pytest.raises(ParameterError, match="added_mass_kg: has no finite value for the option a"):
        scoring.score(results, _settings())


@given(values=arrays(float, 2, elements=st.floats(-2.0, 2.0)))
def test_smaller_is_never_worse(values):
    low, high = np.sort(values)
    utility = scoring.utilities(np.array([[low], [high]]), np.array([-1.0]), np.array([1.0]))
    assert utility[0, 0] >= utility[1, 0]


# --- scores and ranks ----------------------------------------------------------------------------


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 1000))
def test_adding_options_reorders_no_others(seed):
    few = scoring.score(_results(OPTIONS[:3], seed), _settings())
    many = scoring.score(_results(OPTIONS, seed), _settings())
    kept = many.sel(option=OPTIONS[:3])
    np.testing.assert_array_equal(few["score"], kept["score"])
    for method in scoring.METHODS:
        before = np.argsort(few["rank"].sel({"scoring_method": method}).values)
        after = np.argsort(kept["rank"].sel({"scoring_method": method}).values)
        np.testing.assert_array_equal(before, after)


def test_scores_are_shares_and_ranks_follow_them():
    scores = scoring.score(_results(), _settings())
    assert np.all((scores["score"] >= 0.0) & (scores["score"] <= 1.0))
    for method in scoring.METHODS:
        one = scores.sel({"scoring_method": method})
        ordered = one["score"].values[np.argsort(one["rank"].values)]
        assert np.all(np.diff(ordered) <= 0.0)


def test_ties_share_their_rank():
    results = _results(["none", "a", "b", "c"])
    for name in results.data_vars:
        results[name].loc[{"option": "b"}] = results[name].sel(option="a").values
    scores = scoring.score(results, _settings())
    for method in scoring.METHODS:
        ranks = scores["rank"].sel({"scoring_method": method})
        assert ranks.sel(option="a") == ranks.sel(option="b")
        assert sorted(ranks.values)[0] == 1.0
    shares = scores["first_place_share"]
    assert shares.sel(option="a") == pytest.approx(shares.sel(option="b"))


def test_weights_add_up_to_one_and_only_their_ratio_counts():
    doubled = {k: {**v, "weight": 2.0 * v["weight"]} for k, v in CRITERIA.items()}
    one, two = (
        scoring.score(_results(), _settings()),
        scoring.score(_results(), _settings(**doubled)),
    )
    assert one["weight"].sum() == pytest.approx(1.0)
    np.testing.assert_allclose(one["score"], two["score"], rtol=1e-12)


def test_criterion_without_weight_does_not_count():
    weightless = {**CRITERIA, "added_mass_kg": {**CRITERIA["added_mass_kg"], "weight": 0.0}}
    results = _results()
    before = scoring.score(results, _settings(**weightless))["score"]
    results["reported_figure"][:] = 0.1
    after = scoring.score(results, _settings(**weightless))["score"]
    np.testing.assert_allclose(before, after, rtol=1e-12)


def test_best_option_on_every_criterion_scores_one():
    utility = np.array([[1.0, 1.0], [0.3, 0.8]])
    shares = np.array([0.4, 0.6])
    assert scoring.weighted_sum(utility, shares)[0] == pytest.approx(1.0)
    assert scoring.topsis(utility, shares)[0] == 1.0


# --- robustness ----------------------------------------------------------------------------------


def _places(utility, weightings=200, seed=3, sample_weight=(1.0,)):
    weights = scoring.any_weights(np.shape(utility)[-1], weightings, seed)
    return scoring.rank_acceptability(np.asarray(utility), np.array(sample_weight), weights)


@given(utility=arrays(float, (2, 5, 4), elements=st.floats(0.0, 1.0)), seed=st.integers(0, 99))
def test_every_option_has_one_place_and_every_place_one_option(utility, seed):
    places = _places(utility, 100, seed, (1.0, 2.0))
    np.testing.assert_allclose(places.sum(axis=0), 1.0, atol=1e-12)
    np.testing.assert_allclose(places.sum(axis=1), 1.0, atol=1e-12)
    assert np.all(places >= 0.0)


def test_dominating_option_is_always_first():
    utility = np.array([[[0.9, 0.9, 0.9], [0.2, 0.8, 0.1]]])
    np.testing.assert_array_equal(_places(utility), np.eye(2))


def test_two_opposite_options_share_evenly():
    places = _places(np.eye(2)[None], 10_000)
    assert places[0, 0] == pytest.approx(0.5, abs=4 * 0.005)  # four standard deviations √(¼/10⁴)


def test_options_that_tie_share_their_places():
    places = _places(np.array([[[0.5], [0.5], [0.5], [0.2]]]))
    np.testing.assert_allclose(places[:3, :3], 1.0 / 3.0)
    assert places[3, 3] == 1.0


def test_samples_count_by_their_weights():
    """One sample of three quarters, one of a quarter that turns the order, one of nothing."""
    one = np.array([[0.9, 0.9], [0.1, 0.1]])
    places = _places(np.array([one, one[::-1], np.full((2, 2), np.nan)]), 10, 3, (3.0, 1.0, 0.0))
    np.testing.assert_allclose(places[0], [0.75, 0.25])


def test_samples_of_the_level_change_the_places():
    """In half of the samples `a` is the quietest, in the others the loudest, by 20 dB each."""
    results = _results(["none", "a"])
    coords = {"sample": [1, 2], "speed": results["speed"], "option": ["none", "a"]}
    level = np.zeros((2, 2, 2, 2))
    level[0, :, 1], level[1, :, 1] = -20.0, 20.0  # of (sample, speed, option, receiver)
    sampled = stamp("level_modelled_by_sample", level, coords)
    weight = stamp("sample_weight", [[0.5, 0.5]], {"prior": ["flat"], "sample": [1, 2]})
    results = results.assign(level_modelled_by_sample=sampled, sample_weight=weight)
    of_level = {"level_change_db": CRITERIA["level_change_db"]}
    scores = scoring.score(results, _settings(**of_level))
    np.testing.assert_allclose(scores["rank_acceptability"], 0.5)
    np.testing.assert_allclose(scores["first_place_share"], 0.5)
    results["sample_weight"][:] = [[1.0, 0.0]]
    scores = scoring.score(results, _settings(**of_level))
    np.testing.assert_array_equal(scores["first_place_share"], [0.0, 1.0])
    np.testing.assert_allclose(scores["criterion_value"].squeeze(), [0.0, -20.0])


def test_same_seed_same_shares():
    scores = [scoring.score(_results(), _settings())["first_place_share"] for _ in range(2)]
    np.testing.assert_array_equal(*scores)
