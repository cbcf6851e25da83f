"""Statistics of a run with samples, computed by hand from what is kept by sample."""

import numpy as np
import pytest
from sources_study import nominal_run, sources_run

from vibroacoustics.base.ellipse import semi_major_axis
from vibroacoustics.base.rounding import FORCE_FLOOR
from vibroacoustics.base.vocabulary import VARIABLES
from vibroacoustics.levels.changes import JUDGED
from vibroacoustics.uncertainty.evidence import PAIRS
from vibroacoustics.uncertainty.sample_variables import Weighted

SHARES = {"_10_percent": 0.1, "": 0.5, "_90_percent": 0.9}


@pytest.fixture(scope="module")
def results():
    return sources_run()


@pytest.fixture(scope="module")
def weight(results):
    return results["sample_weight"].values[0]


def quantile_by_hand(values, weight, share):
    """Linear between sorted values, each at the middle of its weight, ends at 0 and 1."""
    rows = sorted((v, w) for v, w in zip(values, weight, strict=True) if w > 0.0)
    at, before = [], 0.0
    for _, own in rows:
        at.append(before + own / 2.0)
        before += own
    span = at[-1] - at[0]
    places = [(one - at[0]) / span for one in at]
    for number in range(len(rows) - 1):
        low, high = places[number], places[number + 1]
        if low <= share <= high:
            part = (share - low) / (high - low)
            return rows[number][0] + part * (rows[number + 1][0] - rows[number][0])
    raise AssertionError(share)


def assert_statistics(results, variable, by_sample, weight, of=None):
    """Value and both ends of a variable are quantiles of its values by sample, first axis."""
    for suffix, share in SHARES.items():
        own = results[f"{variable}{suffix}"]
        values = (own if of is None else of(own)).values
        for place in np.ndindex(values.shape):
            expected = quantile_by_hand(by_sample[(slice(None), *place)], weight, share)
            assert values[place] == pytest.approx(expected, abs=1e-9), (variable, suffix, place)


def by_sample(results, name, *dims):
    return results[f"{name}_by_sample"].transpose("sample", *dims).values


PLACE = ("speed", "option", "receiver")


def test_there_are_as_many_pairs_of_each_sample(results, weight):
    rows = results["sampled_value"].values.reshape(-1, PAIRS, results.sizes["uncertain_parameter"])
    assert (rows == rows[:, :1]).all()
    assert len(np.unique(rows[:, 0], axis=0)) == len(rows) > 1
    assert weight.sum() == pytest.approx(1.0)
    assert np.all(weight > 0.0)


def test_levels_are_medians_with_intervals(results, weight):
    assert_statistics(results, "level_total", by_sample(results, "level_total", *PLACE), weight)
    assert_statistics(
        results, "source_level",
        by_sample(results, "source_level", "speed", "option", "sound_source", "receiver"), weight,
    )  # fmt: skip
    assert_statistics(
        results, "level_modelled", by_sample(results, "level_modelled", *PLACE), weight,
        lambda one: one.sel(weighting="A"),
    )  # fmt: skip
    assert_statistics(results, "level_unmodelled", by_sample(results, "level_unmodelled"), weight)


def test_the_change_is_the_median_of_changes_and_not_the_change_of_medians(results, weight):
    none = results["option"].values.tolist().index("none")
    for name in ("total", "modelled"):
        level = by_sample(results, f"level_{name}", *PLACE)
        assert_statistics(results, f"change_{name}", level - level[:, :, [none]], weight)
    level = results["level_modelled"].sel(weighting="A")
    of_medians = (level - level.sel(option="none")).transpose(*PLACE)
    assert abs(results["change_modelled"].transpose(*PLACE) - of_medians).max() > 1e-3


def test_changes_of_orders_hold_that_of_the_first(results):
    """And have an interval at the second; orders that no source has do not change."""
    for suffix in ("", "_10_percent", "_90_percent", "_nominal"):
        change = results[f"order_change{suffix}"].transpose(..., "order").sel(order=1, drop=True)
        first = results[f"change_1x{suffix}"].transpose(*change.dims)
        np.testing.assert_allclose(change, first, atol=1e-4)  # in single precision
    second = results.sel(order=2).drop_sel(option="none")
    width = second["order_change_90_percent"] - second["order_change_10_percent"]
    assert float(width.max()) > 0.01


def test_changes_of_forces_are_medians_in_db(results, weight):
    none = results["option"].values.tolist().index("none")
    for name in ("force", "moment", "foot_force"):
        force = np.maximum(by_sample(results, f"{name}_1x", "speed", "option"), FORCE_FLOOR)
        change = 20.0 * np.log10(force / force[:, :, [none]])
        assert_statistics(results, f"{name}_change_1x", change, weight)


def test_forces_are_medians_of_samples(results, weight):
    for name, variable in (("force", "force_amplitude"), ("moment", "moment_amplitude"),
                           ("foot_force", "largest_foot_force")):  # fmt: skip
        force = by_sample(results, f"{name}_1x", "speed", "option")
        assert_statistics(results, variable, force, weight, lambda one: one.sel(order=1))
    largest = results["foot_force_amplitude_nominal"].max("foot")
    np.testing.assert_allclose(results["largest_foot_force_nominal"], largest)


def test_shares_are_means_and_add_up(results, weight):
    """The study has the published speed alone, and no option with an insertion loss."""
    total = by_sample(results, "level_total", *PLACE)
    unmodelled = results["unmodelled_band_level_nominal"].isel(noise_band=20)
    spread = (unmodelled - unmodelled.sel(receiver="front_1m")).transpose(*PLACE).values
    rest = by_sample(results, "level_unmodelled")[:, None, None, None] + spread
    share = 10.0 ** ((rest - total) / 10.0)
    found = results["unmodelled_share"].transpose(*PLACE)
    np.testing.assert_allclose(found, np.tensordot(weight, share, axes=1), atol=1e-9)
    for suffix, probability in (("_10_percent", 0.1), ("_90_percent", 0.9)):
        end = results[f"unmodelled_share{suffix}"].transpose(*PLACE).values
        for place in np.ndindex(end.shape):
            expected = quantile_by_hand(share[(slice(None), *place)], weight, probability)
            assert end[place] == pytest.approx(expected, abs=1e-9)
    one = results["source_share"].sum("sound_source") + results["unmodelled_share"]
    np.testing.assert_allclose(one, 1.0, atol=1e-9)


def test_probabilities_are_the_weight_of_samples_with_a_measurable_change(results, weight):
    none = results["option"].values.tolist().index("none")
    total = by_sample(results, "level_total", *PLACE)
    changes = {"level_total": (total - total[:, :, [none]], 0.5, 0.5)}
    for name in ("force", "moment", "foot_force"):
        force = np.maximum(by_sample(results, f"{name}_1x", "speed", "option"), FORCE_FLOOR)
        ratio = (force / force[:, :, [none]] - 1.0)[..., None]
        changes[name] = (np.broadcast_to(ratio, total.shape), 0.05, 0.05)
    for name, (change, up, down) in changes.items():
        for word, counts in (("increase", change > up), ("decrease", change < -down)):
            found = results[f"{word}_probability"].sel(judged_quantity=name).transpose(*PLACE)
            expected = np.tensordot(weight, counts.astype(float), axes=1)
            np.testing.assert_allclose(found, expected, atol=1e-12, err_msg=f"{word} {name}")
    assert results["judged_quantity"].values.tolist() == list(JUDGED)
    chance = results["increase_probability"].sel(judged_quantity="level_1x")
    assert ((chance >= 0.0) & (chance <= 1.0)).all()


def test_nominal_values_are_those_of_the_study_without_samples(results):
    without = nominal_run()
    names = [name for name in without.data_vars if f"{name}_nominal" in results]
    assert {"level_total", "source_level", "force_amplitude", "source_share"} <= set(names)
    for name in names:
        np.testing.assert_array_equal(results[f"{name}_nominal"], without[name], err_msg=name)
    statistics = {"median", "mean"}
    own = {name for name in without.data_vars if VARIABLES[name].statistic in statistics}
    own -= {name for name in own if "path_speed" in without[name].dims}
    assert own <= {*names, "alternative_share", "alternative_level", "alternative_change"}
    beside = [str(name) for name in without.data_vars if str(name).endswith("_percent")]
    assert all(name.startswith("alternative_") for name in beside)


def test_intervals_hold_their_values(results):
    for name in results.data_vars:
        if f"{name}_10_percent" in results and VARIABLES[name].statistic == "median":
            low, value, high = (
                results[f"{name}{suffix}"].values for suffix in ("_10_percent", "", "_90_percent")
            )
            known = np.isfinite(value)
            assert np.all(low[known] <= value[known]), name
            assert np.all(value[known] <= high[known]), name


def test_orders_of_the_representative_sample_have_the_median_amplitudes(results):
    """They keep phase and direction of one machine."""
    for name, amplitude in (("force_order", "force_amplitude"),
                            ("moment_order", "moment_amplitude")):  # fmt: skip
        phasor = results[name].sum("source").transpose("axis", "speed", "option", "order").values
        median = results[amplitude].transpose("speed", "option", "order").values
        found = semi_major_axis(phasor, 0)
        loud = found > 1e-6
        assert loud.any()
        np.testing.assert_allclose(found[loud], median[loud], rtol=1e-9)


def test_weights_count_in_median_and_mean():
    weighted = Weighted(np.array([0.5, 0.25, 0.25, 0.0]))
    values = np.array([1.0, 3.0, 2.0, np.nan])
    found = weighted.statistics("level_unmodelled", values, {})
    for suffix, share in SHARES.items():
        expected = quantile_by_hand(values[:3], weighted.weight[:3], share)
        assert found[f"level_unmodelled{suffix}"].item() == pytest.approx(expected)
    place = {"speed": [1.0], "option": ["none"], "receiver": ["front"]}
    share = weighted.statistics("unmodelled_share", values[:, None, None, None], place)
    assert share["unmodelled_share"].item() == pytest.approx(0.5 * 1.0 + 0.25 * 5.0)
    assert share["unmodelled_share"].dims == ("speed", "option", "receiver")
