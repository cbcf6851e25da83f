"""A measured baseline: new = measured - modelled (none) + modelled (option), band by band."""

import numpy as np
import pytest
import xarray as xr
from rooms_made_up import KITCHEN, RADIUS_M, made_up_vectors
from sources_study import NO_DISCREPANCY, SOURCES_STUDY, run_made_up
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.levels.agreement import log_weight_of_points, priors_of
from vibroacoustics.levels.measured_points import evidence
from vibroacoustics.results.estimates import nominal
from vibroacoustics.stages import room as room_stage

FEW = dict.fromkeys(("sources.keys", "sources.gas", "options.twin-oldham", "options.damping"))
BANDS = np.array([
    25, 31.5, 40, 50, 63, 80, 100, 125, 160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600,
    2000, 2500, 3150, 4000, 5000, 6300, 8000, 10000,
])  # fmt: skip
NOISE_DB = 40.0 + 3.0 * np.cos(np.arange(27.0))
HOOD = {"kind": "hood", "band_hz": [100.0, 200.0], "insertion_loss_db": [10.0, 6.0]}


@pytest.fixture(scope="module")
def study():
    return va.load_study(SOURCES_STUDY).replace(FEW | NO_DISCREPANCY | {"options.hood": HOOD})


@pytest.fixture(scope="module")
def without(study):
    return run_made_up(study)


@pytest.fixture(scope="module")
def results(tmp_path_factory, study, without):
    return run_made_up(study.replace(measured(tmp_path_factory.mktemp("stand"), study, without)))


def power(level_db):
    return 10.0 ** (np.asarray(level_db) / 10.0)


def modelled_bands(results, receiver, speed):
    """Mean square of each of BANDS without an option, re (20 µPa)²."""
    at = nominal(results, "source_band_level")
    at = at.sel(option="none", receiver=receiver, speed=speed)
    by_band = dict(zip(at["band"].values.tolist(), power(at).sum(at.get_axis_num("sound_source")),
                       strict=True))  # fmt: skip
    return np.array([by_band.get(float(band), 0.0) for band in BANDS])


def measured(folder, study, results, speeds=None):
    """The study with a baseline of what it models and known noise; its receiver."""
    receiver, speed = study.catalogue_receiver, study.operation.speed_rpm[0]
    level = 10.0 * np.log10(modelled_bands(results, receiver, speed) + power(NOISE_DB))
    lines = ["# made up", "microphone,speed_rpm,band_hz,level_db"]
    for offset, at in zip((-5.0, 5.0), speeds or (speed - 100.0, speed + 100.0), strict=True):
        lines += [f"{receiver},{at},{b},{v + offset}" for b, v in zip(BANDS, level, strict=True)]
    (folder / "stand.csv").write_text("\n".join(lines))
    return {"measured.baseline.file": str(folder / "stand.csv")}


def test_levels_are_what_was_measured_less_the_model_and_the_option(study, without, results):
    """At the middle of two speeds, whose levels are 5 dB below and above."""
    receiver, speed = study.catalogue_receiver, study.operation.speed_rpm[0]
    exact_hz = 10.0 ** (np.rint(10.0 * np.log10(BANDS)) / 10.0)
    noise = power(NOISE_DB + a_weighting(exact_hz))
    loss = np.ones(27)
    loss[[6, 9]] = power([-10.0, -6.0])
    at = {"receiver": receiver, "speed": speed}
    for option in results["option"].values:
        modelled = nominal(without, "level_modelled").sel(option=option, weighting="A", **at)
        alone = power(modelled.item())
        truth = alone + np.sum(noise * (loss if option == "hood" else 1.0))
        found = power(nominal(results, "level_total").sel(option=option, **at).item())
        assert found == pytest.approx(truth, rel=1e-9), option
    share = results["baseline_share"].sel(baseline_band=BANDS, **at).values
    known = modelled_bands(without, receiver, speed)
    np.testing.assert_allclose(share, known / (known + power(NOISE_DB)), rtol=1e-9, atol=1e-30)


def test_other_microphones_and_the_model_stay_and_samples_follow(study, without, results):
    others = [name for name in study.receivers if name != study.catalogue_receiver]
    for name in others:
        np.testing.assert_array_equal(
            *(nominal(one, "level_total").sel(receiver=name) for one in (results, without))
        )
    np.testing.assert_array_equal(*(nominal(one, "level_modelled") for one in (results, without)))
    at = results.sel(receiver=study.catalogue_receiver, option="none")
    spread = at["level_total_by_sample"] - at["level_total"]
    assert float(abs(spread).median()) < 3.0


def test_samples_are_weighed_by_what_was_measured(study, without, results):
    """By the A-weighted level of the bands, which hold all that is modelled, to 1.5 dB."""
    receiver, speed = study.catalogue_receiver, study.operation.speed_rpm[0]
    exact_hz = 10.0 ** (np.rint(10.0 * np.log10(BANDS)) / 10.0)
    square = modelled_bands(without, receiver, speed) + power(NOISE_DB)
    measured_dba = 10.0 * np.log10(np.sum(square * power(a_weighting(exact_hz))))
    both = slice(results.sizes["prior_sample"])  # the level and the share need more samples
    np.testing.assert_array_equal(
        results["prior_sample_level"], without["prior_sample_level"][both]
    )
    over = results["prior_sample_level"].values - measured_dba
    for prior in priors_of(study.machine.remainder):
        weight = results["prior_sample_weight"].sel(prior=prior.name).values
        log_weight = log_weight_of_points(over[None], 1.5, prior)
        expected = np.exp(log_weight - log_weight.max())
        np.testing.assert_allclose(weight, expected, rtol=0.05, atol=1e-4)
    assert abs(results["prior_sample_weight"] / without["prior_sample_weight"] - 1.0).max() > 0.1


@pytest.mark.long
def test_measured_noise_is_in_the_room(tmp_path, study, without, monkeypatch):
    """Its power by the hemisphere about the foot, and a room as loud as that hemisphere.

    Below the crossover frequency. Gains are means over lines 1 Hz apart: in the lowest band, at
    25 Hz, they err by 4.3 dB (1/25)² = 0.007 dB.
    """
    fewer = study.replace({"uncertainty": None, "operation.stopping": False})
    baseline = measured(tmp_path, study, without)

    def vectors(study, settings, motions, _):
        highest = study.radiation.maximum_frequency_hz
        return made_up_vectors(settings.listeners, motions, highest_hz=highest), False

    monkeypatch.setattr(room_stage, "vectors_of", vectors)
    monkeypatch.setattr(room_stage, "_map", lambda *_: xr.Dataset())
    results = run_made_up(fewer.replace({"room": KITCHEN, **baseline}))
    at = {"option": "none", "speed": fewer.operation.speed_rpm[0], "listener": "table"}
    below = BANDS < 400.0
    found = results["room_noise_band_level"].sel(at).sel(noise_band=BANDS[below]).values
    away_m = fewer.receivers[fewer.catalogue_receiver].distance_m
    louder_db = 20.0 * np.log10(away_m / RADIUS_M)
    np.testing.assert_allclose(found, NOISE_DB[below] + louder_db, atol=0.007)


def test_points_that_weigh_are_the_ends_and_a_middle_at_each_microphone():
    keys = [("a", speed) for speed in (900.0, 1000.0, 1100.0, 1200.0)] + [("b", 900.0)]
    assert evidence(keys) == [("a", 900.0), ("a", 1100.0), ("a", 1200.0), ("b", 900.0)]


WRONG = [
    ("stand_1,2900,50,60", "microphone stand_1: not among the receivers"),
    ("front_1m,1000,50,60", "lies outside its 1000 to 1000 rpm"),
    ("front_1m,2900,57,60", "band_hz = 57 Hz: must be the middle of a third octave"),
    ("front_1m,2900,50", "line 2: 3 cells, the head has 4"),
    ("front_1m,2900,50,6O", "line 2: level_db = 6O: must be a finite number"),
    ("front_1m,2900,50,60\nfront_1m,2900,50,61", "line 3: band 50 Hz is there twice"),
    ("front_1m,2900,50,60\nfront_1m,3900,63,61", "has other bands at another speed"),
]


@pytest.mark.parametrize(("rows", "words"), WRONG)
def test_what_is_wrong_is_one_line(tmp_path, rows, words):
    (tmp_path / "stand.csv").write_text(f"microphone,speed_rpm,band_hz,level_db\n{rows}\n")
    study = va.load_study(ROOT / "tests" / "studies" / "tiny.toml")
    with pytest.raises(va.ParameterError) as told:
        study.replace({"measured.baseline.file": str(tmp_path / "stand.csv")})
    assert words in str(told.value)
    assert "\n" not in str(told.value)
    with pytest.raises(va.ParameterError, match=r"none\.csv: no such file"):
        study.replace({"measured.baseline.file": str(tmp_path / "none.csv")})
