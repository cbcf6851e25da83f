"""Estimates of a run: values with their intervals, nominal values, samples and digits."""

import numpy as np
import pytest
import xarray as xr

import vibroacoustics as va
from vibroacoustics.base import rounding
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.results.bands import FINEST_DB, Band, written
from vibroacoustics.results.estimates import (
    Estimate,
    effective_number,
    estimate,
    estimated,
    in_samples,
    interval,
    is_sampled,
    nominal,
    prior_ensemble,
    sample_numbers,
    weighted_estimate,
)

PLACE = {"speed": [1000.0, 2000.0], "option": ["none", "hood"], "receiver": ["front"]}
AT = {"speed": 2000.0, "option": "hood", "receiver": "front"}
VALUES = np.array([[[50.0], [49.0]], [[60.0], [58.0]]])


def totals(offset_db: float = 0.0, name: str = "level_total") -> xr.DataArray:
    return stamp(name, VALUES + offset_db, PLACE)


def statistics() -> xr.Dataset:
    """Median 1 dB above the nominal value, interval of 2 dB below and 3 dB above it."""
    offsets = {"": 1.0, "_10_percent": -1.0, "_90_percent": 4.0}
    return xr.Dataset(
        {f"level_total{end}": totals(by, f"level_total{end}") for end, by in offsets.items()}
    )


@pytest.fixture
def results() -> xr.Dataset:
    bare = xr.Dataset({"level_total": totals(), "change_total": totals(-50.0, "change_total")})
    return estimated(bare.assign_attrs(title="A study"), statistics())


def test_a_value_is_the_statistic_with_its_interval(results: xr.Dataset) -> None:
    assert estimate(results, "level_total", **AT) == (57.0, 59.0, 62.0)
    assert estimate(results, "level_total", **{**AT, "speed": 1000.0}) == (48.0, 50.0, 53.0)
    assert is_sampled(results, "level_total")


def test_labels_of_other_dimensions_are_not_used(results: xr.Dataset) -> None:
    assert estimate(results, "level_total", **AT, weighting="A", sound_source="gas").value == 59.0
    with pytest.raises(ParameterError, match="option = 'pendulum': must be one of"):
        estimate(results, "level_total", **{**AT, "option": "pendulum"})


def test_a_nominal_value_is_its_own_interval(results: xr.Dataset) -> None:
    assert not is_sampled(results, "change_total")
    assert estimate(results, "change_total", **AT) == (8.0, 8.0, 8.0)


def test_nominal_values_stay_beside_the_statistics(results: xr.Dataset) -> None:
    for name, expected in (("level_total", totals()), ("change_total", results["change_total"])):
        found = nominal(results, name)
        assert found.name == name
        np.testing.assert_array_equal(found, expected)
    va.check(results)
    assert results["level_total_nominal"].attrs["long_name"].endswith("nominal values")
    assert results["level_total"].attrs == totals().attrs


def test_statistics_of_what_had_no_nominal_value_are_added() -> None:
    bare = xr.Dataset({"change_total": totals(-50.0, "change_total")})
    found = estimated(bare, statistics())
    assert "level_total_nominal" not in found
    assert {"level_total", "level_total_10_percent", "change_total"} <= set(found.data_vars)


def test_interval_of_all_cases(results: xr.Dataset) -> None:
    found = interval(results, "level_total")
    assert list(found) == ["low", "value", "high"]
    np.testing.assert_array_equal(found["high"] - found["low"], 5.0)
    same = interval(results, "change_total")
    np.testing.assert_array_equal(same["low"], same["high"])


def test_samples_of_what_is_kept(results: xr.Dataset) -> None:
    weight = np.array([0.2, 0.3, 0.5])
    kept = np.stack([VALUES - 1.0, VALUES, VALUES + 2.0], axis=-1)
    dims = (*PLACE, "sample")
    results = results.assign(
        level_total_by_sample=(dims, kept), sample_weight=(("prior", "sample"), [weight, weight])
    )
    found = in_samples(results, "level_total")
    assert found.values.dims == ("sample", *PLACE)
    np.testing.assert_array_equal(found.values.sel(AT), [57.0, 58.0, 60.0])
    np.testing.assert_array_equal(found.weight, weight)


def test_median_and_ends_of_weighted_values() -> None:
    """Values at the middles of their weights, from 0 to 1."""
    assert weighted_estimate(np.arange(11.0), np.ones(11)) == Estimate(1.0, 5.0, 9.0)
    heavy = weighted_estimate(np.array([0.0, 1.0, 7.0]), np.array([1.0, 1.0, 0.0]))
    assert heavy == pytest.approx((0.1, 0.5, 0.9))


def test_effective_numbers() -> None:
    assert effective_number(np.full(7, 0.3)) == pytest.approx(7.0)
    assert effective_number(np.array([1.0, 0.0, 0.0])) == 1.0
    assert effective_number(np.array([2.0, 1.0])) == pytest.approx(9.0 / 5.0)
    assert effective_number(np.zeros(3)) == 0.0


def test_numbers_of_samples() -> None:
    weight = np.array([1.0, 1.0, 0.5, 0.0])
    results = xr.Dataset(
        {
            "prior_sample_weight": (("prior", "prior_sample"), [weight, weight[::-1]]),
            "prior_sample_level": ("prior_sample", np.arange(4.0)),
            "prior_sample_value": (("uncertain_parameter", "prior_sample"), np.ones((2, 4))),
            "sample_weight": (("prior", "sample"), np.full((2, 4), 0.25)),
            "sampled_value": (
                ("uncertain_parameter", "sample"),
                [[1.0, 1.0, 1.0, 2.0], [5.0, 5.0, 6.0, 6.0]],
            ),
        }
    )
    numbers = sample_numbers(results)
    assert (numbers.tried, numbers.computed) == (4, 3)
    assert numbers.effective == pytest.approx(2.5**2 / 2.25)
    ensemble = prior_ensemble(results)
    assert ensemble is not None
    assert ensemble.value.dims == ("prior_sample", "uncertain_parameter")
    np.testing.assert_array_equal(ensemble.before, 1.0)
    tested = results.assign(shell_weight=("prior_sample", weight))
    np.testing.assert_array_equal(prior_ensemble(tested).before, weight)  # type: ignore[union-attr]
    assert prior_ensemble(results.drop_vars("prior_sample_weight")) is None
    assert sample_numbers(results.drop_vars("sample_weight")).computed == 0


@pytest.mark.parametrize(
    ("effective", "units"),
    [
        (1.0, (10.0, 10.0, 10.0)),
        (100.0, (1.0, 1.0, 1.0)),
        (1e4, (0.1, 0.1, 0.1)),
        (1e9, (0.1, 0.1, 0.1)),
    ],
)
def test_digits_follow_the_number_of_samples(effective: float, units: tuple[float, ...]) -> None:
    """An interval of 10 dB: errors of 6.67/√n dB at its ends and of 4.89/√n dB of the median."""
    band = written(Estimate(40.0, 45.0, 50.0), effective, FINEST_DB)
    assert band == Band(40.0, 45.0, 50.0, band.units)
    assert band.units == pytest.approx(units)


def test_rounding_puts_no_part_above_its_total() -> None:
    total = Band(54.2, 56.3, 58.9, (1.0, 1.0, 1.0))
    part = Band(22.0, 44.0, 57.0, (10.0, 10.0, 10.0))
    assert part.middle_and_ends(rounding.level) == "40 (20 to 60)"
    assert part.as_part_of(total).middle_and_ends(rounding.level) == "40 (20 to 57)"
    louder = part._replace(highest=61.0)
    assert louder.as_part_of(total) == louder
    median = part._replace(middle=55.4)
    assert median.as_part_of(total).middle_and_ends(rounding.level) == "55 (20 to 57)"


def test_amounts_and_nominal_values_have_their_own_digits() -> None:
    """No finer than a hundredth of the amount; nominal values as their column writes them."""
    amount = written(Estimate(90.0, 100.0, 110.0), 1e12)
    assert amount.units == pytest.approx((1.0, 1.0, 1.0))
    assert written(Estimate(3.0, 3.0, 3.0), 10.0) == Band(3.0, 3.0, 3.0)
    assert written(Estimate(0.0, np.nan, np.inf), 10.0).units == (0.0, 0.0, 0.0)
