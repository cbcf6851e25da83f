"""Samples of a shell against hammer tests: features, likelihood, and a sample that is the truth."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hammered_shell import FREQUENCY, WALL, hammered_study, mobilities, table, write
from sources_study import path_of, run_made_up

import vibroacoustics as va
from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.stages.shell import hammer_test
from vibroacoustics.study.samples import batches_of_samples
from vibroacoustics.transfer.wall_mobility import wall_of, wall_points
from vibroacoustics.uncertainty.hammer_test import CHANCE
from vibroacoustics.uncertainty.shell_features import (
    Tolerances,
    clear_peaks,
    features,
    shell_agreement,
)

TOLERANCES = Tolerances(3.0, 0.02, 0.3)
KEYS = [("variation", "mobility_change_db"), ("variation", "frequency_factor_ratio"),
        ("structure", "loss_factor_ratio")]  # fmt: skip


def modal(natural_hz, loss, frequency_hz):
    """Mobility of modes of 1 kg."""
    omega, natural = 2 * np.pi * frequency_hz, 2 * np.pi * np.asarray(natural_hz)[:, None]
    return (1j * omega / (natural**2 * (1 + 1j * loss) - omega**2)).sum(axis=0)[None]


def test_peaks_of_modes_far_apart():
    frequency = np.arange(50.0, 2000.0, 1.0)
    y = modal([300.0, 900.3], 0.02, frequency)
    natural, loss = clear_peaks((abs(y) ** 2).sum(axis=0), frequency)
    np.testing.assert_allclose(natural, [300.0, 900.3], rtol=1e-3)
    np.testing.assert_allclose(loss, 0.02, rtol=0.03)


@pytest.mark.parametrize("top_hz", [99.7, 100.0, 100.4])
def test_peak_between_lines_is_that_of_a_parabola(top_hz):
    """A level of 0.3 dB/Hz² beside it, down to -60 dB: a parabola through three lines is exact."""
    frequency = np.arange(50.0, 150.0, 1.0)
    level_db = np.maximum(-0.3 * (frequency - top_hz) ** 2, -60.0)
    natural, _ = clear_peaks(10.0 ** (level_db / 10.0), frequency)
    assert natural == pytest.approx([top_hz], rel=1e-12)


def test_ripple_is_no_clear_peak():
    frequency = np.arange(50.0, 500.0, 1.0)
    assert clear_peaks(2.0 + np.sin(frequency), frequency)[0].size == 0


@pytest.mark.parametrize("step", [1.0, 0.25])
def test_each_kind_counts_as_one_measurement_however_many_lines(step):
    frequency = np.arange(50.0, 3000.0, step)
    y = modal([300.0, 900.0, 2000.0], 0.02, frequency)
    measured = features(y, frequency)
    assert shell_agreement(measured, measured, TOLERANCES).likelihood == 1.0
    louder = features(y * 10 ** (3.0 / 20.0), frequency)
    agreement = shell_agreement(measured, louder, TOLERANCES)
    assert agreement.likelihood == pytest.approx(np.exp(-0.5), rel=1e-6)
    assert agreement.gain_db == pytest.approx(3.0)
    lossy = replace(measured, loss_ratio=1.3 * measured.loss_ratio)
    assert shell_agreement(measured, lossy, TOLERANCES).likelihood == pytest.approx(np.exp(-0.5))
    higher = replace(measured, peak_hz=1.02 * measured.peak_hz)
    agreement = shell_agreement(measured, higher, TOLERANCES)
    assert agreement.likelihood == pytest.approx(np.exp(-0.5))
    assert agreement.frequency_ratio == pytest.approx(1.02)
    without = replace(measured, peak_hz=np.zeros(0), loss_ratio=np.zeros(0))
    assert 0.0 < shell_agreement(measured, without, TOLERANCES).likelihood < 1e-5


@cache
def study_and_path():
    study = hammered_study()
    return study, path_of(study)


def samples(count, hypercube=0):
    study, _ = study_and_path()
    uncertainty = study.uncertainty.model_copy(update={"random_samples": count})
    batches = batches_of_samples(study.model_copy(update={"uncertainty": uncertainty}))
    return [next(batches) for _ in range(hypercube + 1)][-1]


def test_mobility_of_the_wall_is_the_sum_over_its_modes_and_reciprocal():
    study, path = study_and_path()
    y = mobilities(study, path, {})
    np.testing.assert_allclose(y[0, 1], y[1, 0], rtol=1e-9)
    angles = np.array([point.angle_rad for point in WALL.values()])
    heights = np.array([point.height_m for point in WALL.values()])
    points, normal = wall_points(angles, heights, path.radius_m)
    np.testing.assert_allclose(np.hypot(*points[:, :2].T), study.machine.shell.cylinder.radius_m)
    omega, total = 2.0 * np.pi * FREQUENCY, 0.0
    for mode in path.modes:
        shape = (mode.velocity(points) * normal).sum(axis=1)
        lossy = (2 * np.pi * mode.frequency_hz) ** 2 * (1 + 0.01j) - omega**2
        total = total + 1j * omega * shape[0] * shape[2] / (mode.modal_mass_kg * lossy)
    np.testing.assert_allclose(y[2, 0], total, rtol=1e-9)
    assert wall_of(path, angles, heights).rigid.shape == (3, 6)


def test_a_hammer_test_is_read_with_its_turned_points(tmp_path):
    study, path = study_and_path()
    truth = mobilities(study, path, {})
    hammered = study.replace({"measured.shell": table(write(tmp_path / "h.uff", truth))})
    test = hammer_test(hammered, path)
    y = test.mobility(study.machine)
    np.testing.assert_allclose(test.mobilities.mobility, y, atol=1e-9 * abs(y).max())
    assert test.of_machine(study.machine).likelihood == pytest.approx(1.0, abs=1e-6)


def weighed(tmp_path, truth, candidates, number, tolerances):
    """Samples by the test of a truth with 3 % noise: their likelihoods."""
    study, path = study_and_path()
    file = write(tmp_path / "h.uff", mobilities(study, path, truth), 0.03, number)
    test = hammer_test(study.replace({"measured.shell": table(file)}), path)
    frequency = test.mobilities.frequency_hz
    agreements = [shell_agreement(test.measured, one, tolerances) for one in candidates]
    assert np.array_equal(frequency, FREQUENCY)
    return np.array([one.likelihood for one in agreements])


def features_of(sampled):
    study, path = study_and_path()
    return [features(mobilities(study, path, one).reshape(9, -1), FREQUENCY) for one in sampled]


def held_and_width(tmp_path, sampled, truths, tolerances=TOLERANCES):
    """Whether the weighted 90 % band holds each truth, and its width over that before."""
    known = features_of(sampled)
    held, width = [], []
    for number, truth in enumerate(truths):
        weight = weighed(tmp_path, truth, known, number, tolerances)
        for key in KEYS:
            values = np.array([one[key] for one in sampled])
            low, high = weighted_quantiles(values, weight, [0.05, 0.95])
            before = np.quantile(values, [0.05, 0.95])
            held.append(low <= truth[key] <= high)
            width.append((high - low) / (before[1] - before[0]))
    return np.reshape(held, (-1, 3)), np.reshape(width, (-1, 3))


@pytest.mark.long
def test_the_truth_stays_in_bands_that_become_narrower(tmp_path):
    """Of three unknowns with wide tolerances; all of them are in the long test."""
    sampled, truths = (
        [{key: one[key] for key in KEYS} for one in samples(250, hypercube)] for hypercube in (0, 1)
    )
    held, width = held_and_width(tmp_path, sampled, truths[:4], Tolerances(4.0, 0.05, 0.5))
    assert held.mean() >= 0.8
    assert np.all(np.median(width, axis=0) < 0.9)


@pytest.mark.long
def test_bands_hold_nine_of_ten_truths(tmp_path):
    held, width = held_and_width(tmp_path, samples(2000), samples(200, 1)[:60])
    assert np.all(held.mean(axis=0) >= 0.85)
    assert np.all(np.median(width, axis=0) < 0.65)


FEW = {"options.twin-oldham": None, "options.damping": None, "operation.stopping": False,
       "sources.gas": None, "sources.keys": None, "options.counterweight-half": None}  # fmt: skip
WIDE = {"gain_tolerance_db": 20.0, "frequency_tolerance_percent": 50.0,
        "loss_tolerance_percent": 300.0}  # fmt: skip


def test_a_run_tells_before_and_after(tmp_path):
    study, path = study_and_path()
    file = write(tmp_path / "h.uff", mobilities(study, path, samples(4)[0]), 0.03)
    results = run_made_up(study.replace({**FEW, "measured.shell": table(file, **WIDE)}))
    assert results["shell_likelihood"].attrs["mobilities"] == 9
    count = results.sizes["shell_sample"]
    assert results["shell_value"].shape == (count, results.sizes["shell_parameter"])
    assert results.sizes["prior_sample"] <= count
    (section,) = [
        one for one in SECTIONS.values() if one.applies(results) and "hammer" in one.title
    ]
    text, _, rows, _ = section.blocks(results)
    assert "9 mobilities from 300 to 1800 Hz" in str(text)
    assert rows.head == ("", "by the ranges alone", "with the test")
    assert rows.rows[0][0].startswith("mean level of the mobilities")
    assert rows.rows[-1][0] == "modelled level at front_1m, dB(A)"


def test_weights_of_those_that_go_on_are_right_on_average(tmp_path):
    """Russian roulette: unlikely samples keep the share of the weight that their likelihoods give.

    A sample of likelihood L below c has the weight c with the probability L/c, hence the variance
    L (c - L); the bound is four standard deviations of the share.
    """
    study, path = study_and_path()
    file = write(tmp_path / "h.uff", mobilities(study, path, samples(4)[0]))
    test = hammer_test(study.replace({"measured.shell": table(file)}), path)
    likelihood = np.random.default_rng(1).uniform(size=4000) ** 8.0
    agreement = test.of_machine(study.machine)
    made = iter(likelihood)
    test._agreement = lambda sample: replace(agreement, likelihood=float(next(made)))
    batches = ([{("a", "b"): value} for value in part] for part in np.split(likelihood, 40))
    gone = [sample for batch in test.agreeing(batches, 20, lambda *_: None) for sample in batch]
    weight = test.likelihood(0, len(gone))
    least = CHANCE * likelihood.max()
    unlikely = likelihood[likelihood < least]
    share = unlikely.sum() / likelihood.sum()
    deviation = (1.0 - share) * np.sqrt(np.sum(unlikely * (least - unlikely))) / likelihood.sum()
    below = np.array([sample["a", "b"] < least for sample in gone])
    assert len(gone) < 2000
    assert np.average(below, weights=weight) == pytest.approx(share, abs=4.0 * deviation)


WRONG = [
    ({"wall.w1.node": 99, "wall.w2.node": 98, "wall.w3.node": 97}, "no frequency response has its"),
    ({"wall.w1.direction": "z"}, "measured.shell.wall.w1.direction = 'z'"),
    ({"parts.scroll.part": "rotor"}, "part = rotor: must be one of fixed_scroll"),
    ({"gain_tolerance_db": 0.0}, "gain_tolerance_db = 0.0 dB: out of range"),
    ({"wall.w2.node": 21}, "wall.w2: has node and direction of wall.w1"),
    ({"highest_frequency_hz": 301.0}, "fewer than 3 lines from 0 to 301 Hz"),
    ({"frequency_responses": ["none.uff"]}, "none.uff: no such file"),
]


@pytest.mark.parametrize(("values", "words"), WRONG)
def test_what_is_wrong_is_one_line(tmp_path, values, words):
    study, path = study_and_path()
    made = np.ones((3, 3, FREQUENCY.size), complex)
    changed = table(write(tmp_path / "h.uff", made))
    for name, value in values.items():
        *tables, key = name.split(".")
        at = changed
        for each in tables:
            at = at[each]
        at[key] = value
    with pytest.raises((va.ParameterError, va.StorageError)) as raised:
        hammer_test(study.replace({"measured.shell": changed}), path)
    assert words in str(raised.value)


def test_no_sample_that_agrees_is_one_line(tmp_path):
    study, path = study_and_path()
    file = write(tmp_path / "h.uff", 1e4 * mobilities(study, path, {}))
    test = hammer_test(study.replace({"measured.shell": table(file)}), path)
    few = iter([samples(4)])
    with pytest.raises(va.ParameterError, match="none of 4 samples agrees with the hammer test"):
        list(test.agreeing(few, 4, lambda *_: None))
