"""Criteria of sound: values of every option."""

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.sound.ingredients import ingredients
from vibroacoustics.sound.loudness import loudness_of
from vibroacoustics.study.criterion import CRITERIA


def test_loudness_and_sharpness_are_the_worst_over_the_speeds_of_the_mean(results):
    names = [str(name) for name in results["receiver"].values]
    at = [
        [ingredients(results, "none", name, speed) for name in names] for speed in (900.0, 1200.0)
    ]
    sone = [np.mean([one.loudness_sone for one in loudness_of(parts)]) for parts in at]
    few = results.sel(speed=[900.0, 1200.0])
    value = CRITERIA["loudness_sone"]().value(few)
    assert value.dims == ("option",)
    assert value.sel(option="none").item() == pytest.approx(max(sone))
    acum = CRITERIA["sharpness_acum"]().value(few)
    assert np.all((acum > 1.0) & (acum < 3.0))


def test_tone_excess_is_the_worst_over_microphones_and_speeds():
    """The most prominent tone is at another microphone than the others of its speed."""
    excess = [[[-3.0, 1.0], [4.0, -2.0]], [[0.0, -1.0], [-5.0, 2.0]]]
    of_cases = xr.DataArray(excess, dims=("option", "receiver", "speed"))
    value = CRITERIA["tone_excess_db"]().value(xr.Dataset({"largest_tone_excess": of_cases}))
    assert value.dims == ("option",)
    assert value.values.tolist() == [4.0, 2.0]


def test_tone_excess_without_audible_tones_is_the_least(results):
    assert np.all(CRITERIA["tone_excess_db"]().value(results) == -60.0)  # all below 89.1 Hz


def test_audibility_is_the_worst_over_microphones_and_speeds():
    heard = [[[-10.0, 1.0], [4.0, -2.0]], [[0.0, -1.0], [-5.0, 2.0]]]
    of_cases = xr.DataArray(heard, dims=("option", "receiver", "speed"))
    value = CRITERIA["audibility_db"]().value(xr.Dataset({"decisive_audibility": of_cases}))
    assert value.values.tolist() == [4.0, 2.0]
