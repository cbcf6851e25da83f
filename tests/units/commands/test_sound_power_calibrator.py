"""`vibroacoustics sound-power --calibrator`: factors of microphones from their calibrator."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import wavfile
from support import command_here
from synthetic_microphones import BANDS, RATE_HZ, recording

import vibroacoustics as va
from vibroacoustics.radiation.arrangements import hemisphere_positions

RUNNING = recording(hemisphere_positions(1.0), np.full(len(BANDS), 70.0), None, with_source=True)
FACTORS = np.geomspace(4.0, 9.0, RUNNING.sizes["channel"])
"""Pascal at full scale of each microphone."""
WITHIN_DB = 0.05


def calibrator(folder: Path, number: int, pascal: float, level_db: float = 94.0) -> Path:
    """A recording at 94 dB, 4 Hz off 1 kHz, with noise 30 dB below and hum, handled at its ends."""
    time_s = np.arange(int(5.0 * RATE_HZ)) / RATE_HZ
    random = np.random.default_rng(number)
    rms = 20e-6 * 10.0 ** (level_db / 20.0) / pascal
    tone = np.sqrt(2.0) * rms * np.sin(2.0 * np.pi * (1000.0 + 4.0 * (-1) ** number) * time_s)
    hum = 0.1 * rms * np.sin(2.0 * np.pi * 50.0 * time_s)
    noise = 10.0 ** (-30.0 / 20.0) * rms * random.standard_normal(time_s.size)
    tone[: int(0.7 * RATE_HZ)] = 0.0
    tone[-int(0.7 * RATE_HZ) :] *= np.linspace(1.0, 0.0, int(0.7 * RATE_HZ))
    file = folder / f"calibrator_{number}.wav"
    wavfile.write(file, int(RATE_HZ), (tone + hum + noise).astype(np.float32))
    return file


def samples(file: Path, numbers: range) -> Path:
    """Microphones in fractions of their full scale, written by another library."""
    fractions = RUNNING["signal"].values[numbers] / FACTORS[numbers, None]
    wavfile.write(file, int(RATE_HZ), fractions.T.astype(np.float32))
    return file


def levels(folder: Path) -> np.ndarray:
    return va.open_results(folder / "sound_power.nc")["measured_power_level"].values


def measured(files: list[Path], words: list[str], out: Path) -> np.ndarray:
    done = command_here("sound-power", *files, "--hemisphere", 1.0, *words, "--out", out)
    assert done.returncode == 0, done.stderr
    return levels(out)


@pytest.mark.parametrize("files", [1, 2])
def test_power_with_a_calibrator_of_each_microphone(tmp_path: Path, files: int) -> None:
    """Against the known power, and against exact factors; equal names in two files."""
    size = len(FACTORS) // files
    stored, by_calibrator, exact = [], [], []
    for file in range(files):
        numbers = range(file * size, (file + 1) * size)
        stored.append(samples(tmp_path / f"part{file}.wav", numbers))
        for channel, number in enumerate(numbers, 1):
            name = f"part{file}:channel {channel}" if files > 1 else f"channel {channel}"
            tone = calibrator(tmp_path, number, FACTORS[number])
            by_calibrator += ["--calibrator", f"{name}={tone}"]
            exact += ["--calibration", f"{name}={FACTORS[number]}"]
    found = measured(stored, by_calibrator, tmp_path / "calibrator")
    wanted = measured(stored, [*exact, "--unit", "*=Pa"], tmp_path / "exact")
    np.testing.assert_allclose(found, wanted, atol=WITHIN_DB)
    bands = found[np.isfinite(found)]
    assert np.abs(bands[3] - 70.0) < 0.1
