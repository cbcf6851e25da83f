"""The report of a run with given transfer vectors, and the words of options in it."""

import json

import numpy as np
import pytest
import xarray as xr
from support import TINY, tiny_run

import vibroacoustics as va
from vibroacoustics.balancers.rotating_counterweight import RotatingCounterweight
from vibroacoustics.report import render


@pytest.fixture
def given() -> xr.Dataset:
    study = va.load_study(TINY)
    frequency = np.arange(10.0, study.radiation.maximum_frequency_hz + 26.0, 25.0)
    vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))
    return va.run(study, radiation=va.given_radiation(vectors, frequency))


def test_report_of_given_transfer_vectors_says_that_they_have_no_error(given: xr.Dataset) -> None:
    page = render(given)["report.html"].decode()
    assert "The transfer vectors are given, without an estimate of their error." in page


def test_words_of_an_option_are_for_its_own_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    words = {"added_mass_kg": "Mass of the counterweight", "angle_of_its_own": "Its angle"}
    monkeypatch.setattr(RotatingCounterweight, "labels", words)
    weight = "mass_g = 10.0\nradius_mm = 20.0\nangle_deg = 0.0\nheight_mm = 0.0\n"
    results = tiny_run(options=f'[options.weight]\nkind = "counterweight"\n{weight}')
    labels = json.loads(results.attrs["words"])["labels"]
    assert "added_mass_kg" not in labels  # others add a mass, too
    assert labels["angle_of_its_own"] == "Its angle"
