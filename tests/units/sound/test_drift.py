"""Whether the lines of a signal rise or fall together."""

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.measured.recorded_tones import recorded_tones
from vibroacoustics.sound.mean_audibility import drift_octaves

RATE_HZ = 16000.0


def orders(rpm, noise):
    """Twelve orders of a shaft in noise, Pa."""
    turns = np.cumsum(rpm / 60.0) / RATE_HZ
    each = [0.1 * np.cos(2.0 * np.pi * k * turns + k) / np.sqrt(k) for k in range(1, 13)]
    return np.sum(each, axis=0) + noise * np.random.default_rng(1).standard_normal(turns.size)


@pytest.mark.parametrize(
    ("ends", "duration_s"),
    [((900.0, 6000.0), 20.0), ((6000.0, 900.0), 20.0), ((2000.0, 3000.0), 8.0)],
)
def test_lines_of_a_run_up_drift_as_its_speed(ends, duration_s):
    speed = np.linspace(*ends, int(duration_s * RATE_HZ))
    drift = drift_octaves(orders(speed, 0.02), RATE_HZ)
    assert 0.6 < drift / np.log2(ends[1] / ends[0]) < 1.05  # pairs that differ much count as none


@pytest.mark.parametrize("seed", range(3))
def test_noise_silence_and_a_steady_machine_do_not_drift(seed):
    noise = np.random.default_rng(seed).standard_normal(int(6.0 * RATE_HZ))
    assert drift_octaves(noise, RATE_HZ) == 0.0
    assert drift_octaves(0.0 * noise, RATE_HZ) == 0.0
    time = np.arange(noise.size) / RATE_HZ
    swinging = 2900.0 * (1.0 + 0.02 * np.sin(2.0 * np.pi * 0.2 * time))
    assert drift_octaves(orders(swinging, 0.05 * (1 + seed)), RATE_HZ) == 0.0


def test_tones_of_a_run_up_come_with_a_warning():
    signal = orders(np.linspace(1500.0, 4500.0, int(8.0 * RATE_HZ)), 0.02)
    recording = va.label_recording([signal], RATE_HZ, ["front"], ["Pa"])
    with pytest.warns(
        UserWarning, match="'front': is no steady recording: its lines rise by about 1"
    ):
        assert "is no steady recording" in recorded_tones(recording).attrs["reading_remarks"]
