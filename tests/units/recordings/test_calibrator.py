"""Calibration factor from the recording of a sound calibrator."""

import numpy as np
import pytest
import scipy.signal
from scipy.io import wavfile
from support import assert_refused, command_here

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.recordings import label_recording, read_calibrator, read_recording
from vibroacoustics.recordings.calibrator import tone_amplitude
from vibroacoustics.recordings.export import csv_bytes

RATE_HZ = 48000.0
PASCAL_AT_94_DB = 1.0023745
"""20 µPa · 10^(94/20)."""


def calibrator(
    amplitude: float = 0.1, tone_hz: float = 1000.0, noise_db: float = -200.0, seconds: float = 6.0
) -> np.ndarray:
    """A tone with noise at a level below it within its octave, handled before and behind."""
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    tone = amplitude * np.sin(2.0 * np.pi * tone_hz * time_s + 0.3)
    rng = np.random.default_rng(3)
    octave = scipy.signal.butter(4, [0.71 * tone_hz, 1.41 * tone_hz], "bandpass", fs=RATE_HZ,
                                 output="sos")  # fmt: skip
    noise = scipy.signal.sosfilt(octave, rng.standard_normal(time_s.size))
    noise *= amplitude / np.sqrt(2.0) * 10.0 ** (noise_db / 20.0) / np.std(noise)
    signal = tone + noise
    handled = round(0.9 * RATE_HZ)
    signal[:handled] = 0.002 * amplitude * rng.standard_normal(handled)
    signal[-handled:] *= np.linspace(1.0, 0.0, handled)
    return signal


@pytest.mark.parametrize("tone_hz", [999.3, 1000.0, 1012.7, 250.12])
@pytest.mark.parametrize("noise_db", [-200.0, -30.0])
def test_amplitude_within_005_db(tone_hz, noise_db):
    """Against the amplitude that made the tone."""
    signal = calibrator(0.123, tone_hz, noise_db)
    amplitude, found_hz, steady_s = tone_amplitude(signal, RATE_HZ, 250.0 if tone_hz < 300 else 1e3)
    assert abs(20.0 * np.log10(amplitude / 0.123)) < 0.02
    assert found_hz == pytest.approx(tone_hz, abs=0.05)
    assert 3.5 <= steady_s <= 4.3


def test_against_a_filter():
    """The root mean square behind a band-pass, by another method, without what was handled."""
    signal = calibrator(0.05, 1003.0, -35.0) + 0.02 * np.sin(
        2.0 * np.pi * 50.0 * np.arange(round(6 * RATE_HZ)) / RATE_HZ
    )
    sos = scipy.signal.butter(2, [800.0, 1250.0], "bandpass", fs=RATE_HZ, output="sos")
    middle = scipy.signal.sosfiltfilt(sos, signal)[round(2 * RATE_HZ) : round(4 * RATE_HZ)]
    gain = np.abs(scipy.signal.sosfreqz(sos, [1003.0], fs=RATE_HZ)[1][0]) ** 2
    rms = np.sqrt(np.mean(middle**2)) / gain
    amplitude, _, _ = tone_amplitude(signal, RATE_HZ, 1000.0)
    assert abs(20.0 * np.log10(amplitude / np.sqrt(2.0) / rms)) < 0.02


def wav(path, signal, rate_hz=RATE_HZ):
    wavfile.write(path, int(rate_hz), np.round(32767 * signal).astype(np.int16))
    return path


@pytest.mark.parametrize(("level_db", "ratio"), [(94.0, 1.0), (114.0, 10.0)])
def test_the_factor_calibrates_a_recording(tmp_path, level_db, ratio):
    """A tone of 0.1 of full scale at 94 dB: a recording at 0.01 of full scale has 74 dB."""
    found = read_calibrator(wav(tmp_path / "cal.wav", calibrator()), level_db=level_db)
    expected = ratio * PASCAL_AT_94_DB * np.sqrt(2.0) / 0.1
    assert abs(20.0 * np.log10(found.pascal_per_unit / expected)) < 0.01
    time_s = np.arange(48000) / RATE_HZ
    file = wav(tmp_path / "run.wav", 0.01 * np.sin(2.0 * np.pi * 400.0 * time_s))
    run = read_recording(
        file, units={"*": "Pa"}, calibration={found.channel: found.pascal_per_unit}
    )
    level = 20.0 * np.log10(np.std(run["signal"].values) / 20e-6)
    assert level == pytest.approx(level_db - 20.0, abs=0.02)


def test_units_of_the_file_do_not_count(tmp_path):
    recording = label_recording([calibrator(2.0)], RATE_HZ, ["mic"], ["mV"])
    (tmp_path / "cal.csv").write_bytes(csv_bytes(recording))  # in V
    found = read_calibrator(tmp_path / "cal.csv")
    assert found.pascal_per_unit == pytest.approx(PASCAL_AT_94_DB * np.sqrt(2.0) / 2e-3, rel=2e-3)


@pytest.mark.parametrize(
    ("signal", "words"),
    [
        (calibrator(tone_hz=1200.0), "no clear tone at 1000 Hz: the strongest .* is 1200"),
        (calibrator(noise_db=-10.0), "at least 20 dB are needed"),
        (calibrator(seconds=0.6 + 1.8), "no steady tone|stays within"),
        (calibrator()[:20000], "at least 1 s is needed"),
        (np.zeros(96000), "no steady tone"),
        (calibrator() * np.linspace(1.0, 3.0, round(6 * RATE_HZ)), "no steady tone at 1000 Hz"),
    ],
)
def test_what_is_no_calibrator(signal, words):
    with pytest.raises(ParameterError, match=words):
        tone_amplitude(signal, RATE_HZ, 1000.0)


def test_refusals(tmp_path):
    file = wav(tmp_path / "cal.wav", np.stack([calibrator(), calibrator()], axis=1))
    with pytest.raises(ParameterError, match=r"'channel 1', 'channel 2'.*CHANNEL=FILE"):
        read_calibrator(file)
    assert read_calibrator(file, channel="channel 2").channel == "channel 2"
    with pytest.raises(ParameterError, match="level_db = 20 dB: must be 60 to 140 dB"):
        read_calibrator(file, channel="channel 2", level_db=20.0)
    with pytest.raises(ParameterError, match="frequency_hz = 30000 Hz: must be 20 to "):
        read_calibrator(file, channel="channel 2", frequency_hz=30000.0)


def test_the_command_line(tmp_path):
    cal = wav(tmp_path / "cal.wav", calibrator())
    time_s = np.arange(48000) / RATE_HZ
    tone = 0.01 * np.sin(2.0 * np.pi * 400.0 * time_s)
    file, out = wav(tmp_path / "run.wav", tone), tmp_path / "run.csv"
    words = ("export", file, "--out", out, "--name", "channel 1=front")
    assert command_here(*words, "--calibrator", f"channel 1={cal}").returncode == 0
    read = read_recording(out)
    assert read["channel"].values.tolist() == ["front"]
    assert read["channel_unit"].values.tolist() == ["Pa"]
    level = 20.0 * np.log10(np.std(read["signal"].values) / 20e-6)
    assert level == pytest.approx(74.0, abs=0.02)
    assert command_here(*words, "--calibrator", cal, "--calibrator-level", 114).returncode == 0
    level = 20.0 * np.log10(np.std(read_recording(out)["signal"].values) / 20e-6)
    assert level == pytest.approx(94.0, abs=0.02)
    for wrong, said in [
        (("--calibrator", cal, "--unit", "channel 1=V"), "has the unit 'V', must be Pa"),
        (("--calibrator", cal, "--calibration", "channel 1=2"), "is calibrated twice"),
        (("--calibrator", tmp_path / "none.wav"), "no such file"),
    ]:
        assert_refused(command_here(*words, *wrong), said)
