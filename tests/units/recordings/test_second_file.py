"""A tacho in a second file: on the time line of the sound, clocks compared where they can be."""

import hashlib
import warnings

import numpy as np
import pytest
import soundfile
from support import assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.recordings.second_file import SpeedFile, clock_of, with_second_file

RATE_HZ, TACHO_HZ = 8192.0, 11025.0
DURATION_S = 12.0


def angle(time_s):
    """Revolutions of a run-up from 900 to 2700 rpm."""
    return 15.0 * time_s + 0.5 * 2.5 * time_s**2


def sound(time_s):
    return 0.5 * np.cos(2.0 * np.pi * 8.0 * angle(time_s))


def pulses(time_s):
    return np.where(angle(time_s) % 1.0 < 0.1, 0.8, -0.1)


def times(rate_hz, start_s=0.0, drift=0.0):
    return start_s + (1.0 + drift) * np.arange(int(DURATION_S * rate_hz)) / rate_hz


def noise(time_s):
    """A signal of many random tones, which both recorders have."""
    frequency_hz = np.random.default_rng(2).uniform(20.0, 900.0, 60)
    return 0.1 * sum(np.cos(2.0 * np.pi * f * time_s + f) for f in frequency_hz)


def recording(time_s, rate_hz, signals, units):
    return va.label_recording(
        [each(time_s) for each in signals], rate_hz, list(units), [*units.values()]
    )


def peak(joined, channel):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        settings = va.OrderAnalysis(va.SpeedChannel(channel), (8.0,))
        orders = va.analyse_orders(joined, settings)
    return np.abs(orders["channel_order"].sel(order=8.0).values[0]), orders


def test_a_tacho_in_another_wav_needs_its_channel_alone(tmp_path):
    soundfile.write(tmp_path / "sound.wav", sound(times(RATE_HZ)), int(RATE_HZ), "FLOAT")
    soundfile.write(tmp_path / "tacho.wav", pulses(times(TACHO_HZ)), int(TACHO_HZ), "PCM_16")
    options = ["--unit", "*=Pa", "--calibration", "*=2", "--orders", "8", "--no-map"]
    speed = ["--speed-file", str(tmp_path / "tacho.wav"), "--speed-channel", "channel 1"]
    out = ["--out", str(tmp_path / "out")]
    outcome = command_here("orders", tmp_path / "sound.wav", *options, *speed, *out)
    assert outcome.returncode == 0, outcome.stderr
    orders = va.open_results(tmp_path / "out" / "orders.nc")
    found = np.abs(orders["channel_order"].sel(order=8.0, channel="channel 1").values)
    np.testing.assert_allclose(found, 1.0, rtol=0.01)
    assert "tacho.wav channel 1" in orders.attrs["speed_source"]
    assert "drift is unknown" in orders.attrs["reading_remarks"]
    for command in ("track", "map"):
        more = ["--bandwidth", "3"] if command == "track" else []
        files = [tmp_path / "sound.wav", *options[:4], *speed, *out]
        assert command_here(command, *files, *more).returncode == 0


@pytest.mark.parametrize(("start_s", "drift"), [(0.35, 0.0), (0.0, 4e-4), (-0.2, -5e-5)])
def test_clocks_are_found_by_a_signal_that_both_have(tmp_path, start_s, drift):
    """Without the shared signal the run-up's orders would be off by the lag."""
    first = recording(times(RATE_HZ), RATE_HZ, (sound, noise), {"front": "Pa", "ring": "m/s²"})
    time_s = times(TACHO_HZ, start_s, drift)
    second = recording(time_s, TACHO_HZ, (pulses, noise), {"tacho": "V", "ring": "m/s²"})
    clock = clock_of(first, second)
    assert clock.start_s == pytest.approx(start_s, abs=2e-5)
    assert clock.drift == pytest.approx(drift, abs=3e-6)
    va.export_recording(second, tmp_path / "second.nc")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        joined = with_second_file(first, SpeedFile(tmp_path / "second.nc", ("tacho",)))
    assert "by channel 'ring' of both" in joined.attrs["reading_remarks"]
    found, _ = peak(joined, "second.nc tacho")
    np.testing.assert_allclose(found, 0.5, rtol=0.01)


@pytest.mark.parametrize("kind", ["tone", "noise"])
def test_signals_that_fix_no_clock_are_said_to_fix_none(kind):
    """A steady tone has a lag in every period, noise of its own has none."""

    def signal(seed):
        if kind == "tone":
            return lambda time_s: np.sin(2.0 * np.pi * 50.0 * time_s)
        return lambda time_s: np.random.default_rng(seed).standard_normal(time_s.size)

    units = {"ring": "m/s²"}
    first = recording(times(RATE_HZ), RATE_HZ, (signal(0),), units)
    second = recording(times(TACHO_HZ), TACHO_HZ, (signal(1),), units)
    assert "drift is unknown" in clock_of(first, second).note


def test_start_times_of_both_files_are_used():
    units = {"front": "Pa"}
    first = recording(times(RATE_HZ), RATE_HZ, (sound,), units)
    second = recording(times(RATE_HZ), RATE_HZ, (pulses,), {"tacho": "V"})
    first.attrs["start_time"] = "2026-11-28T10:00:00"
    second.attrs["start_time"] = "2026-11-28T10:00:02.500"
    first.attrs["part_start_s"] = 1.0
    clock = clock_of(first, second)
    assert clock.start_s == 1.5
    assert "as both files state" in clock.note


def test_settings_name_a_second_file_for_each_recording(tmp_path):
    """One recording with its settings, and two that are averaged, each with a tacho of its own."""
    for name in ("a", "b"):
        samples = 0.01 * ord(name) * sound(times(RATE_HZ))
        soundfile.write(tmp_path / f"{name}.wav", samples, int(RATE_HZ), "FLOAT")
        tacho = pulses(times(TACHO_HZ, 1e-5 * ord(name)))
        soundfile.write(tmp_path / f"{name}_tacho.wav", tacho, int(TACHO_HZ), "PCM_16")
    (tmp_path / "settings.toml").write_text(
        '[channels]\n"channel 1" = { unit = "Pa", calibration = 2.0 }\n'
        '[speed]\nchannel = "channel 1"\nchannel_file = "{recording}_tacho.wav"\n'
        "[analysis]\norders = [8]\n"
    )
    options = ["--settings", tmp_path / "settings.toml", "--out", tmp_path / "out"]
    outcome = command_here("orders", tmp_path / "a.wav", *options)
    assert outcome.returncode == 0, outcome.stderr
    orders = va.open_results(tmp_path / "out" / "orders.nc")
    digest = hashlib.sha256((tmp_path / "a_tacho.wav").read_bytes()).hexdigest()
    assert orders.attrs["speed_file_sha256"] == digest
    assert "a_tacho.wav channel 1" in orders.attrs["speed_source"]
    outcome = command_here("orders", tmp_path / "a.wav", tmp_path / "b.wav", *options)
    assert outcome.returncode == 0, outcome.stderr
    mean = va.open_results(tmp_path / "out" / "campaign.nc")
    assert mean.sizes["run"] == 2
    outcome = command_here("track", tmp_path / "a.wav", *options, "--bandwidth", 3, "--orders", 8)
    assert outcome.returncode == 0, outcome.stderr


def test_a_channel_that_the_second_file_does_not_have(tmp_path):
    first = recording(times(RATE_HZ), RATE_HZ, (sound,), {"front": "Pa"})
    va.export_recording(first, tmp_path / "second.nc")
    with pytest.raises(ParameterError, match=r"second.nc: no channel 'tacho' among 'front'"):
        with_second_file(first, SpeedFile(tmp_path / "second.nc", ("tacho",)))


def test_a_second_file_belongs_to_a_channel(tmp_path):
    first = recording(times(RATE_HZ), RATE_HZ, (sound,), {"front": "Pa"})
    file = str(va.export_recording(first, tmp_path / "a.nc"))
    outcome = command_here("orders", file, "--rpm", 900, "--speed-file", file)
    assert_refused(outcome, "--speed-file: belongs to --speed-channel")
