"""Loudness of sound whose level varies has a remark, of low sample rates it is a bound."""

import warnings

import numpy as np
import pytest
from scipy.signal import resample_poly

import vibroacoustics as va
from vibroacoustics.commands.tone_tables import analysis_of_tones
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


@pytest.fixture(scope="module")
def whole():
    """Noise to 24 kHz with a tone, and its loudness and sharpness."""
    time_s = np.arange(4 * 48000) / 48000.0
    noise = 0.1 * np.random.default_rng(2).standard_normal(time_s.size)
    return noise + 0.1 * np.cos(2.0 * np.pi * 1000.0 * time_s)


def at_rate(signal, up, down):
    """Analysis of the tones of a signal of 48 kHz at another sample rate, and its results."""
    rate_hz = 48000.0 * up / down
    samples = resample_poly(signal, up, down) if down > 1 else signal
    results = recorded_tones(va.label_recording([samples], rate_hz, ["front"], ["Pa"]))
    values = [results[f"recorded_{name}"].item() for name in ("loudness", "sharpness")]
    return analysis_of_tones(results), np.array(values)


@pytest.fixture(scope="module")
def true(whole):
    return at_rate(whole, 1, 1)[1]


@pytest.mark.parametrize(
    ("up", "down", "highest"), [(1, 6, "3.15"), (1, 3, "6.3"), (147, 320, "8")]
)
def test_loudness_at_low_sample_rates_is_a_bound(whole, true, up, down, highest):
    """At 8, 16 and 22.05 kHz, in terminal, page, CSV and JSON."""
    analysis, values = at_rate(whole, up, down)
    assert np.all(values < true)
    reason = f"(bands above {highest} kHz are missing)"
    loud, sharp = f"at least {values[0]:.3g} sone", f"at least {values[1]:.2f} acum"
    for words in (loud, sharp):
        assert f"{words} {reason}" in analysis.text()
        assert f"{words} {reason}" in analysis.html().decode()
        for file in ("tones.csv", "tones_conditions.csv"):
            assert f"{words} {reason}" in analysis.files()[file].decode()
    data = analysis.json()
    texts = {each["text"]: each["statistic"] for each in data["numbers"]}
    assert texts[loud] == texts[sharp] == "at least"
    assert data["tables"]["tones"]["loudness"][0] == f"{loud} {reason}"


@pytest.mark.parametrize(("up", "down"), [(2, 3), (147, 160)])
def test_loudness_from_32_khz_on_is_that_of_48_khz(whole, true, up, down):
    analysis, values = at_rate(whole, up, down)
    np.testing.assert_allclose(values, true, rtol=1e-3)
    assert "loudness at least" not in analysis.text()
