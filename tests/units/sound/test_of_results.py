"""Criteria of sound: values of every option."""

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.sound import of_results
from vibroacoustics.sound.ingredients import ingredients
from vibroacoustics.sound.loudness import loudness_of
from vibroacoustics.sound.tonality import Tone
from vibroacoustics.study.criterion import CRITERIA


def test_loudness_and_sharpness_are_the_worst_over_the_speeds_of_the_mean(results):
    pytest.importorskip("mosqito")
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


def test_tone_excess_is_that_of_the_most_prominent_tone(results):
    assert np.all(CRITERIA["tone_excess_db"]().value(results) == -60.0)  # all below 89.1 Hz
    by_noise = Tone("order 20", 1000.0, 50.0, 11.0, 7.0)
    by_bands = Tone("order 40", 2000.0, 45.0, 5.0, 14.0)
    quiet = Tone("order 10", 500.0, -30.0, 40.0, 40.0)
    alone = Tone("order 30", 1500.0, 40.0, np.inf, np.inf)
    assert of_results.excess_db(by_noise) == pytest.approx(3.0)
    assert of_results.excess_db(by_bands) == pytest.approx(5.0)
    assert of_results.excess_db(quiet) == -60.0
    assert of_results.excess_db(alone) == 60.0
    assert of_results.most_prominent([by_noise, by_bands, quiet]) == by_bands


def test_tone_excess_is_the_worst_over_microphones_and_speeds(monkeypatch):
    """The most prominent tone stands at another microphone than the others of its speed."""
    excess = [[[-3.0, 1.0], [4.0, -2.0]], [[0.0, -1.0], [-5.0, 2.0]]]
    of_cases = xr.DataArray(excess, dims=("option", "receiver", "speed"))
    monkeypatch.setattr(of_results, "tone_excess", lambda _: of_cases)
    value = CRITERIA["tone_excess_db"]().value(xr.Dataset())
    assert value.dims == ("option",)
    assert value.values.tolist() == [4.0, 2.0]
