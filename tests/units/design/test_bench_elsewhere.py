"""What the weights do at other speeds of a study, and what the runs say about its inputs."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.design.bench import elsewhere
from vibroacoustics.design.bench.elsewhere import (
    changes_elsewhere,
    effective,
    narrowed_inputs,
    sample_weights,
)
from vibroacoustics.design.bench.prior import StudyInfluence
from vibroacoustics.mechanics.balancing.coefficients import Ensemble

SPEEDS = (1500.0, 3000.0)


def answer(  # what the functions read of a `BalancedRuns`
    seed=3, samples=200, deviation=0.02, results=None, weights=((0.0,), (1.0,)), rows=2
):
    """One plane whose influence is (1 + input) of a row's own; readings are of a known input."""
    rng = np.random.default_rng(seed)
    values = rng.uniform(-0.5, 0.5, samples)
    own = rng.standard_normal(rows) + 1j * rng.standard_normal(rows)
    influence = (1.0 + values)[:, None, None] * own[:, None]
    moments = np.array(weights, dtype=complex)
    unbalance = 0.7 - 0.4j
    truth = 1.2 * own
    noise = deviation * (rng.standard_normal((len(moments), rows, 2)) @ [1.0, 1j])
    readings = truth * (unbalance + moments) + noise
    study = SimpleNamespace(
        operation=SimpleNamespace(speed_rpm=SPEEDS), receivers={"front": None, "side": None}
    )
    feet = np.repeat(influence[:, None], 2, axis=1) * np.array([1.0, 4.0])[:, None, None]
    pressure = 0.01 * feet[:, :, :2]
    return SimpleNamespace(
        runs=SimpleNamespace(readings=readings, weights=moments),
        deviation=np.full(readings.shape, deviation),
        coefficients=SimpleNamespace(freedom=np.full(rows, np.inf)),
        study=StudyInfluence(
            study, [{("mounts", "stiffness"): each} for each in values.tolist()],
            Ensemble(influence, 0.0), feet, pressure,
        ),
        settings=SimpleNamespace(study=SimpleNamespace(results=results, option="weights")),
        moment_samples=np.full((50, 1), -unbalance),
        moment_kg_m=np.array([-0.9 * unbalance]),
        answers={"least squares": np.array([-unbalance])},
    )  # fmt: skip


def test_one_plane_leaves_a_tenth_everywhere():
    """What remains of one plane's unbalance is the same share at every speed and observer."""
    changes = changes_elsewhere(answer())
    assert [each.observer for each in changes] == ["feet", "front", "side"] * 2
    assert [each.speed_rpm for each in changes] == [1500.0] * 3 + [3000.0] * 3
    for each in changes:
        np.testing.assert_allclose(each.change_db, -20.0, atol=1e-9)
        assert each.total_db is None


def test_runs_weigh_the_samples_and_narrow_the_input():
    """The input is 0.2; with σ 0.02 of readings of size 1 it is known to some 0.03."""
    result = answer()
    weight = sample_weights(result)
    assert 5.0 < effective(weight) < 60.0
    (narrowed,) = narrowed_inputs(answer(deviation=0.06))
    assert narrowed.name == "mounts.stiffness"
    assert narrowed.before[2] - narrowed.before[0] == pytest.approx(0.8, abs=0.1)
    assert narrowed.after[0] < 0.2 < narrowed.after[2]
    assert narrowed.after[2] - narrowed.after[0] < 0.4


def test_the_interval_of_the_input_is_that_of_least_squares():
    """The difference of two runs is (1 + x) a t + noise of variance 2σ² a component: a normal x."""
    result = answer(samples=20000, deviation=0.06)
    (narrowed,) = narrowed_inputs(result)
    own = result.study.ensemble.samples[0, :, 0] / (
        1.0 + result.study.samples[0]["mounts", "stiffness"]
    )
    difference = result.runs.readings[1] - result.runs.readings[0]
    middle = (own.conj() @ difference).real / np.sum(np.abs(own) ** 2) - 1.0
    deviation = np.sqrt(2.0) * 0.06 / np.linalg.norm(own)
    expected = middle + np.array([-1.2816, 0.0, 1.2816]) * deviation
    np.testing.assert_allclose(narrowed.after, expected, atol=0.05 * deviation)


def test_a_repeat_without_weights_says_nothing():
    weight = sample_weights(answer(weights=((0.0,), (0.0,))))
    np.testing.assert_allclose(weight, 1.0 / len(weight), rtol=1e-6)
    assert narrowed_inputs(answer(weights=((0.0,), (0.0,)))) == []


def test_unknown_scatter_says_nothing():
    result = answer()
    result.coefficients.freedom[0] = 0.0
    assert sample_weights(result) is None
    assert narrowed_inputs(result) == []


def test_a_run_without_a_reading_counts_for_the_other_rows_only():
    result = answer(weights=((0.0,), (1.0,), (1j,)))
    whole = sample_weights(result)
    result.runs.readings[2, 0] = np.nan
    fewer = sample_weights(result)
    assert np.all(np.isfinite(fewer))
    assert effective(fewer) > effective(whole)


def test_the_total_changes_by_the_line_of_the_bench(monkeypatch):
    """At 3000 rpm 1x is made as loud as all else: a tenth of it takes 3.0 dB off the total."""
    result = answer(results="results.nc", deviation=0.02)
    peak = np.median(np.abs(result.study.pressure[:, 1, 0, 0] * result.moment_samples[0, 0]))
    line = 20.0 * np.log10(peak / np.sqrt(2.0) / 20e-6) + float(a_weighting(50.0))
    own = -200.0
    dims = ("speed", "option", "receiver")
    results = xr.Dataset(
        {
            "level_total": (dims, np.full((1, 1, 2), line)),
            "order_level": ((*dims, "order", "weighting"), np.full((1, 1, 2, 1, 1), own)),
        },
        {"speed": [3000.0], "option": ["none"], "receiver": ["front", "side"], "order": [1.0],
         "weighting": ["A"]},
    )  # fmt: skip
    monkeypatch.setattr(elsewhere, "open_results", lambda _: results)
    result = replace_weights(result)
    changes = {(each.observer, each.speed_rpm): each.total_db for each in changes_elsewhere(result)}
    assert changes["feet", 3000.0] is None
    assert changes["front", 1500.0] is None  # not in the results
    expected = 10.0 * np.log10((1.0 + 0.01) / 2.0)
    assert changes["front", 3000.0][1] == pytest.approx(expected, abs=0.1)


def replace_weights(result):
    """The same without what the runs say, so that the median over all samples counts."""
    result.study = replace(
        result.study, ensemble=Ensemble(0.0 * result.study.ensemble.samples + 1.0)
    )
    return result
