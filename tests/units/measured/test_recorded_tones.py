"""Loudness of sound whose level varies has a remark, that of steady sound has none."""

import warnings

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.measured.recorded_tones import recorded_tones

RATE_HZ = 25600.0
TIME_S = np.arange(int(4.0 * RATE_HZ)) / RATE_HZ
NOISE = np.random.default_rng(1).standard_normal(TIME_S.size)


def remarks(signal):
    recording = va.label_recording([0.1 * signal], RATE_HZ, ["front"], ["Pa"])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        results = recorded_tones(recording)
    assert ("varies" in results.attrs.get("reading_remarks", "")) is bool(caught)
    return [str(each.message) for each in caught]


def test_a_level_that_varies_is_named_with_its_range():
    """Noise at half and at twice its pressure: 12 dB between the levels of the halves."""
    step = NOISE * np.where(TIME_S < 2.0, 0.5, 2.0)
    (line,) = remarks(step)
    assert "channel 'front': its level varies by 12 dB" in line


@pytest.mark.parametrize(
    "signal", [NOISE, np.sin(2.0 * np.pi * 50.0 * TIME_S), np.sin(40.0 * TIME_S) + 0.1 * NOISE]
)
def test_steady_sound_has_no_remark(signal):
    assert not remarks(signal)
