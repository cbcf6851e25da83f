"""A machine without a published level: no remainder, samples that count alike, plain words."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, run_made_up
from support import TINY, made_up_radiation

from vibroacoustics import pipeline, report
from vibroacoustics.base.decibel import SILENCE_DB
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.declaration.sheet import data_sheet
from vibroacoustics.report.data_sheet import headline
from vibroacoustics.results.validation import validations
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.summary import samples_text, study_lines

NO_LEVEL = {"machine.without": ["frame", "overall_noise"], "catalogue_receiver": None}
GAS_ALONE = {
    **{f"sources.{name}": None for name in ("keys", "torque_ripple", "motor")},
    **{f"options.{name}": None for name in ("twin-oldham", "damping")},
    "operation.stopping": False,
    "operation.supply_frequency_hz": None,
    "operation.speed_rpm": [3500.0, 2900.0],
    "radiation.maximum_frequency_hz": 1500.0,
    "uncertainty.random_samples": 20,
}


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY).replace(GAS_ALONE | NO_LEVEL)


@pytest.fixture(scope="module")
def sampled(study):
    return run_made_up(study)


@pytest.fixture(scope="module")
def rigid():
    return pipeline.run(load_study(TINY).replace(NO_LEVEL), radiation=made_up_radiation)


def text_of(results):
    return report.render(results)["comparison.md"].decode()


def test_first_microphone_and_speed_stand_for_the_catalogues(study):
    assert study.catalogue_receiver == "front_1m"
    assert study.catalogue_case == (3500.0, "none")
    said = "\n".join(study_lines(study))
    assert "none is published (overall_noise)" in said
    assert "front_1m and 3500 rpm" in said


@pytest.mark.long
def test_the_total_is_what_is_modelled(rigid, sampled):
    for results in (rigid, sampled):
        modelled = results["level_modelled"].sel(weighting="A")
        assert results["level_total"].values == pytest.approx(modelled.values)
        assert results["level_unmodelled"].item() == SILENCE_DB
    by_sample = sampled["level_total_by_sample"].values
    assert by_sample == pytest.approx(sampled["level_modelled_by_sample"].values)
    assert np.ptp(by_sample[:, 0, 0, 0]) > 1.0


def test_samples_count_alike(sampled, study):
    assert sampled["prior"].values.tolist() == ["even"]
    assert (sampled["prior_sample_weight"].values == 1.0).all()
    assert sampled.sizes["prior_sample"] == study.uncertainty.random_samples
    assert sampled["sample_weight"].values == pytest.approx(1.0 / sampled.sizes["sample"])
    assert sampled["level_share"]["knowledge"].values.tolist() == ["before"]
    names = [limits.name for limits in study.ranges]
    assert not any(name.startswith("remainder") for name in names)  # nothing hangs on it


@pytest.mark.long
def test_the_report_says_so(rigid, sampled):
    plain, of_samples = text_of(rigid), text_of(sampled)
    for text in (plain, of_samples):
        assert "gives no published level: there is no unmodelled noise" in text
        assert "What is not modelled" in text
        assert "whole machine is assumed" not in text
    assert "(no published level)" in plain
    assert "Share of the energy, mean (80 % interval)" in of_samples
    assert "weighted equally, as no level of the machine is published" in of_samples
    assert "0 dB(A) and taken as sure" not in of_samples
    assert validations(rigid) == []


def test_the_data_sheet_says_so(rigid):
    sheet = data_sheet(rigid, "none", 2900.0)
    assert sheet.sound_power.unmodelled_kind == "none"
    assert headline(sheet).endswith("of the modelled sources alone.")


def test_ranges_that_are_not_sampled_are_told(rigid):
    study = load_study(TINY)
    ranges = sum(record.lowest is not None for record in study.records)
    assert ranges > 1
    assert f"none, though {ranges} values have a range" in samples_text(study)
    count = sum(record.lowest is not None for record in load_study(TINY).replace(NO_LEVEL).records)
    assert f"{count} values have a range; they are not sampled" in text_of(rigid)
    words = data_sheet(rigid, "none", 2900.0).sound_power.uncertainty_words
    assert words.startswith(f"nothing was sampled: K_WA is not known. {count} values have a range")


def test_what_contradicts_it_is_refused():
    study = load_study(SOURCES_STUDY)
    first = next(iter(study.receivers))
    assert study.replace({"catalogue_receiver": None}).catalogue_receiver == first
    with pytest.raises(ParameterError, match=f"catalogue_receiver = {first}: stands 2.9"):
        study.replace({"catalogue_receiver": None, f"receivers.{first}.x_mm": 3000.0})
    with pytest.raises(ParameterError, match="catalogue_receiver = back: not among the receivers"):
        study.replace({"catalogue_receiver": "back"})
    with pytest.raises(ParameterError, match="catalogue_point = ari: the machine's file gives no"):
        study.replace(NO_LEVEL | {"catalogue_point": "ari"})
