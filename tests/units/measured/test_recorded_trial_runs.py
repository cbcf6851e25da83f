"""Runs that are recordings with a tacho: readings, weights, bands, refusals."""

import numpy as np
import pytest
from synthetic_bench import RUNS, SENSORS, machine, recording, settings, speeds_of, weights_of

import vibroacoustics as va
from vibroacoustics.design.bench.balanced_runs import balanced
from vibroacoustics.measured.trial_runs.measured_runs import collected, entries_of
from vibroacoustics.measured.trial_runs.recorded import mean_phasor, readings_of
from vibroacoustics.measured.trial_runs.settings import load_trial_runs

SEED = 1917
TACHO = va.SpeedChannel("tacho")


@pytest.fixture(scope="module")
def of_file(tmp_path_factory):
    """Settings of the runs, and their file."""
    path = tmp_path_factory.mktemp("runs") / "balancing.toml"
    path.write_text(settings())
    return load_trial_runs(path), path


def answer(rng, bench, of_file):
    """Answer for a machine, from recordings that stay in memory."""
    file, path = of_file
    entries = [
        entry
        for number, name in enumerate(RUNS)
        for rpm in speeds_of(rng, name)
        for entry in entries_of(
            file, number, readings_of(recording(rng, bench, weights_of(name), rpm), TACHO), path
        )
    ]
    return balanced(file, collected(file, entries))


def truth(bench, result):
    """Readings that the weights really leave, at the speeds of the rows."""
    influence = [bench.influence(rpm) for rpm in dict.fromkeys(result.runs.speeds_rpm.tolist())]
    return np.concatenate(influence) @ (bench.unbalance_kg_m + result.moment_kg_m)


def test_weights_are_within_2_percent_and_2_degrees(of_file):
    """Tacho with jitter, 20 dB of noise, speeds up to 1 % off, three sensors, two speeds."""
    rng = np.random.default_rng(SEED)
    for _ in range(5):
        bench = machine(rng)
        result = answer(rng, bench, of_file)
        ratio = -result.moment_kg_m / bench.unbalance_kg_m
        assert np.all(np.abs(np.abs(ratio) - 1.0) < 0.02)
        assert np.all(np.abs(np.angle(ratio, deg=True)) < 2.0)


@pytest.mark.parametrize(
    ("amplitudes", "unit", "factor"),
    [("peak", "m/s", 1.0), ("peak to peak", "mm/s", 2e3), ("rms", "mm/s", 1e3 / np.sqrt(2.0))],
)
def test_readings_are_in_the_units_and_amplitudes_of_the_file(amplitudes, unit, factor, of_file):
    file, path = of_file
    rng = np.random.default_rng(SEED)
    recorded = readings_of(recording(rng, machine(rng), weights_of("first"), 1500.0), TACHO)
    sensors = {name: each.model_copy(update={"unit": unit}) for name, each in file.sensors.items()}
    changed = file.model_copy(update={"amplitudes": amplitudes, "sensors": sensors})
    for entry in entries_of(changed, 0, recorded, path):
        assert entry.value == pytest.approx(factor * recorded.values[entry.sensor])
        assert entry.deviation == pytest.approx(factor * recorded.deviations[entry.sensor])


@pytest.mark.long
def test_bands_hold_the_readings_that_remain(of_file):
    rng = np.random.default_rng(SEED)
    held = []
    for _ in range(200):
        bench = machine(rng)
        result = answer(rng, bench, of_file)
        remaining = np.abs(truth(bench, result))
        held.append((result.after_band[0] <= remaining) & (remaining <= result.after_band[2]))
    assert 0.75 <= np.mean(held) <= 0.85, np.mean(held)


def test_deviation_of_a_mean_phasor_is_that_of_repetitions():
    """400 repetitions: within 5 standard errors of a standard deviation, 5/√(2·2·400)."""
    rng = np.random.default_rng(SEED)
    angle = 2.0 * np.pi * np.arange(160 * 16) / 16
    means = []
    for _ in range(400):
        signal = np.cos(angle + 0.5) + rng.standard_normal(angle.size)
        means.append(mean_phasor(signal[None], 16))
    values = np.array([mean.value[0] for mean in means]) - np.exp(0.5j)
    measured = np.sqrt(0.5 * np.mean(np.abs(values) ** 2))
    stated = np.sqrt(np.mean([mean.deviation[0] ** 2 for mean in means]))
    assert stated / measured == pytest.approx(1.0, abs=5.0 / np.sqrt(1600))


def files(folder, bench, names=("first", "front", "rear")):
    """File with recordings at one speed."""
    rng = np.random.default_rng(SEED)
    for name in names:
        made = recording(rng, bench, weights_of(name), 1500.0)
        va.export_recording(made, folder / f"{name}_1500.nc")
    text = settings(names).replace(', "first_3000.nc"', "")
    for name in names:
        text = text.replace(f', "{name}_3000.nc"', "")
    path = folder / "balancing.toml"
    path.write_text(text)
    return path, text


def test_files_of_recordings_and_what_is_refused_of_them(tmp_path):
    bench = machine(np.random.default_rng(SEED))
    path, text = files(tmp_path, bench)
    result = va.balance_runs(path)
    ratio = -result.moment_kg_m / bench.unbalance_kg_m
    assert np.all(np.abs(ratio - 1.0) < 0.02)
    assert result.runs.sensors == SENSORS
    for old, new, words in (
        ('channel = "tacho"', "nominal_rpm = 1500", "phases need a mark on the shaft"),
        ('channel = "tacho"', 'channel = "tacho"\npulses_per_revolution = 2', "need a mark"),
        ("[sensors.side]", "[sensors.other]", "has no channel other of sensors; known are front"),
        ('unit = "mm/s"', 'unit = "Pa"', "is in m/s: must be sound pressure"),
        ('[speed]\nchannel = "tacho"', "", "recordings: need a table [speed]"),
        ("first_1500.nc", "missing.nc", "missing.nc"),
    ):
        path.write_text(text.replace(old, new))
        with pytest.raises(va.VibroacousticsError) as caught:
            va.balance_runs(path)
        assert words in str(caught.value.args[0])
        assert len(caught.value.args) == 1
