"""Levels and ratios: each undoes the other, on numbers, arrays and labelled arrays."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from vibroacoustics.base.decibel import (
    SILENCE_DB,
    amplitude_of_level,
    energy_mean,
    energy_sum,
    level_of_amplitude,
    level_of_power,
    power_of_level,
)

levels = st.floats(-290.0, 290.0)


@given(level=levels)
def test_level_and_ratio_undo_each_other(level):
    # lg is good to eps of its value, and an eps of the ratio is 10 / ln 10 eps dB.
    assert level_of_power(power_of_level(level)) == pytest.approx(level, rel=1e-14, abs=1e-14)
    assert level_of_amplitude(amplitude_of_level(level)) == pytest.approx(
        level, rel=1e-14, abs=1e-14
    )


@given(level=levels)
def test_power_is_amplitude_squared(level):
    assert power_of_level(level) == pytest.approx(amplitude_of_level(level) ** 2, rel=1e-12)


def test_by_hand():
    assert level_of_power(100.0) == pytest.approx(20.0)
    assert level_of_amplitude(100.0) == pytest.approx(40.0)
    assert amplitude_of_level(-6.0) == pytest.approx(0.5, abs=2e-3)


@pytest.mark.parametrize("level_of", [level_of_power, level_of_amplitude])
def test_silence_is_finite_and_the_unknown_stays_unknown(level_of):
    values = level_of(np.array([0.0, 1e-200, np.nan, 1.0]))
    np.testing.assert_array_equal(values, [SILENCE_DB, SILENCE_DB, np.nan, 0.0])


@pytest.mark.parametrize(
    "function", [level_of_power, level_of_amplitude, power_of_level, amplitude_of_level]
)
def test_labels_stay(function):
    values = np.array([0.5, 2.0, 3.0])
    labelled = xr.DataArray(values, {"receiver": ["a", "b", "c"]}, ("receiver",))
    answer = function(labelled)
    assert isinstance(answer, xr.DataArray)
    np.testing.assert_array_equal(answer.sel(receiver="b"), function(2.0))
    np.testing.assert_array_equal(answer.values, function(values))


def test_mean_is_the_sum_shared_out():
    level = np.array([[60.0, 70.0, 40.0], [30.0, 31.0, 50.0]])
    shared = energy_sum(level, axis=1) - level_of_power(3.0)
    np.testing.assert_allclose(energy_mean(level, axis=1), shared, rtol=1e-14)
