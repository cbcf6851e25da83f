"""Levels of recorded signals: weighting at the exact frequency, Fast and Slow, Leq, references."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_literature import IEC_61672_1_TABLE_3

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels import (
    FAST_TIME_CONSTANT_S,
    SILENCE_DB,
    SLOW_TIME_CONSTANT_S,
    WEIGHTING,
    band_levels,
    bands_between,
    energy_sum,
    equivalent_level,
    level_reference,
    mean_square_level,
    recorded_levels,
    time_weighted_mean_square,
    weighted_signal,
)

RATE = 51_200.0
TIME = np.arange(int(3.0 * RATE)) / RATE
MIDDLE = slice(int(RATE), int(2.0 * RATE))
"""A second, a second away from the ends."""


# --- frequency weighting -------------------------------------------------------------------------


@pytest.mark.parametrize(("n", "a_db", "c_db"), IEC_61672_1_TABLE_3)
def test_weighted_tones_of_iec_61672_1(n, a_db, c_db):
    """All 34 frequencies of Table 3, rounded to 0.1 dB, as tones through the signal's weighting.

    The second in the middle cuts a tone of 10 Hz within a turn: by sin(φ)/(4π 10) < 0.04 dB.
    """
    tone = np.cos(2.0 * np.pi * 10.0 ** (n / 10.0) * TIME)
    for weighting, expected in (("A", a_db), ("C", c_db), ("Z", 0.0)):
        weighted = weighted_signal(tone, RATE, weighting)[MIDDLE]
        change = equivalent_level(weighted, 1.0) - equivalent_level(tone[MIDDLE], 1.0)
        assert change == pytest.approx(expected, abs=0.05 + 0.001)


@pytest.mark.parametrize("weighting", ["A", "C"])
def test_weighting_is_exact_up_to_half_the_sample_rate(weighting):
    """24 kHz at 51.2 kHz, where a bilinear filter is many dB off."""
    tone = np.cos(2.0 * np.pi * 24_000.0 * TIME)
    weighted = weighted_signal(tone, RATE, weighting)[MIDDLE]
    change = equivalent_level(weighted, 1.0) - equivalent_level(tone[MIDDLE], 1.0)
    assert change == pytest.approx(float(WEIGHTING[weighting](24_000.0)), abs=1e-4)


@pytest.mark.parametrize("weighting", ["A", "C"])
def test_weighting_moves_nothing_in_time(weighting):
    pulse = np.zeros(4097)
    pulse[2048] = 1.0
    weighted = weighted_signal(pulse, RATE, weighting)
    np.testing.assert_allclose(weighted, weighted[::-1], atol=1e-12)
    assert np.argmax(weighted) == 2048


@pytest.mark.parametrize("weighting", ["A", "C"])
def test_end_does_not_wrap_to_the_start(weighting):
    """A loud last tenth of a second; at the start nothing of it, 2 s before."""
    signal = np.where(TIME > 2.9, 1.0, 0.0) * np.cos(2.0 * np.pi * 60.0 * TIME)
    weighted = weighted_signal(signal, RATE, weighting)
    assert np.max(np.abs(weighted[: int(0.5 * RATE)])) < 1e-8 * np.max(np.abs(weighted))


def test_z_weighting_changes_nothing():
    signal = np.random.default_rng(0).standard_normal((2, 1001))
    np.testing.assert_allclose(weighted_signal(signal, RATE, "Z"), signal, atol=1e-13)


def test_offset_is_taken_out():
    weighted = weighted_signal(np.full(TIME.size, 5.0), RATE, "A")
    assert np.max(np.abs(weighted[MIDDLE])) < 1e-9


# --- time weighting ------------------------------------------------------------------------------

BURSTS = [  # IEC 61672-1:2013, Table 4: duration in ms, maximum re steady tone, dB: Fast, Slow
    (1000, 0.0, -2.0), (500, -0.1, -4.1), (200, -1.0, -7.4), (100, -2.6, -10.2), (50, -4.8, -13.1),
    (20, -8.3, -17.0), (10, -11.1, -20.0), (5, -14.1, -23.0), (2, -18.0, -27.0),
    (1, -21.0, None), (0.5, -24.0, None), (0.25, -27.0, None),
]  # fmt: skip


@pytest.mark.parametrize(("duration_ms", "fast_db", "slow_db"), BURSTS)
def test_tone_bursts_of_iec_61672_1(duration_ms, fast_db, slow_db):
    """4 kHz; the table is rounded to 0.1 dB (and is 10 lg(1 - exp(-T/τ))).

    The square's ripple at 8 kHz adds at most 1/(4π 4 kHz τ), 0.7e-3 dB with Fast. A sample holds
    the square for 1/512 ms, and every burst is a whole number of them.
    """
    rate = 512_000.0
    time = np.arange(int((duration_ms + 20.0) * 1e-3 * rate)) / rate
    tone = np.where(time < duration_ms * 1e-3, np.sin(2.0 * np.pi * 4000.0 * time), 0.0)
    for constant, expected in ((FAST_TIME_CONSTANT_S, fast_db), (SLOW_TIME_CONSTANT_S, slow_db)):
        level = mean_square_level(np.max(time_weighted_mean_square(tone, rate, constant)), 1.0)
        exact = 10.0 * np.log10(1.0 - np.exp(-duration_ms * 1e-3 / constant))
        assert level - mean_square_level(0.5, 1.0) == pytest.approx(exact, abs=0.005)
        if expected is not None:
            assert level - mean_square_level(0.5, 1.0) == pytest.approx(expected, abs=0.05 + 0.005)


@pytest.mark.parametrize(
    ("constant", "rate_db_per_s"), [(FAST_TIME_CONSTANT_S, 34.7), (SLOW_TIME_CONSTANT_S, 4.3)]
)
def test_decay_after_a_tone_stops(constant, rate_db_per_s):
    """10 lg(e)/τ: 34.7 dB/s with Fast, 4.3 dB/s with Slow, both rounded."""
    signal = np.where(TIME < 1.0, np.cos(2.0 * np.pi * 4000.0 * TIME), 0.0)
    level = mean_square_level(time_weighted_mean_square(signal, RATE, constant), 1.0)
    first, last = int(1.1 * RATE), int(2.1 * RATE)
    assert level[first] - level[last] == pytest.approx(rate_db_per_s, abs=0.05)


def test_steady_square_is_reached_exactly():
    """1 - exp(-t/τ) at the end of each sample's hold."""
    mean_square = time_weighted_mean_square(np.full((2, 1000), 3.0), 1000.0, 0.125)
    expected = 9.0 * (1.0 - np.exp(-np.arange(1, 1001) / 125.0))
    np.testing.assert_allclose(mean_square, [expected, expected], rtol=1e-12)


# --- levels --------------------------------------------------------------------------------------


def test_calibrator_reads_94_db_everywhere():
    """1 Pa rms at 1 kHz, where the weightings are 0 dB: 93.979 dB.

    The tone's start and stop ring for some ms of 3 s.
    """
    signal = np.sqrt(2.0) * np.cos(2.0 * np.pi * 1000.0 * TIME)
    for weighting in WEIGHTING:
        levels = recorded_levels(signal, RATE, level_reference("Pa"), weighting)
        assert levels.equivalent_db == pytest.approx(93.979, abs=0.01)
        assert levels.fast_maximum_db == pytest.approx(93.979, abs=0.02)
        # Slow has reached 1 - e^-3 of a steady tone after 3 s.
        slow = 93.979 + 10.0 * np.log10(1.0 - np.exp(-3.0))
        assert levels.slow_maximum_db == pytest.approx(slow, abs=0.02)


@settings(max_examples=25, deadline=None)
@given(scale=st.floats(1e-6, 1e6), channels=st.integers(1, 3), samples=st.integers(1, 500))
def test_equivalent_level_follows_the_signal(scale, channels, samples):
    signal = np.random.default_rng(samples).standard_normal((channels, samples)) + 1e-3
    change = equivalent_level(scale * signal, 1.0) - equivalent_level(signal, 1.0)
    np.testing.assert_allclose(change, 20.0 * np.log10(scale), atol=1e-9)


def test_band_levels_add_up_to_the_equivalent_level():
    """Noise of 50 Hz to 16 kHz: all of it lies in the bands, but for leakage."""
    spectrum = np.zeros(TIME.size // 2 + 1, dtype=complex)
    frequency = np.fft.rfftfreq(TIME.size, 1.0 / RATE)
    inside = (frequency > 50.0) & (frequency < 16e3)
    phase = np.random.default_rng(8).uniform(0.0, 2.0 * np.pi, np.count_nonzero(inside))
    spectrum[inside] = np.exp(1j * phase)
    signal = 1e3 * np.fft.irfft(spectrum, TIME.size)
    bands = bands_between(3, 25.0, 20e3)
    for weighting in WEIGHTING:
        levels = band_levels(np.array([signal, signal]), RATE, bands, 20e-6, weighting)
        assert levels.shape == (2, len(bands))
        whole = recorded_levels(signal, RATE, 20e-6, weighting).equivalent_db
        np.testing.assert_allclose(energy_sum(levels, axis=-1), whole, atol=0.001)


def test_silence_is_finite():
    levels = recorded_levels(np.zeros(1000), RATE, 20e-6, "A")
    assert levels.equivalent_db == levels.fast_maximum_db == SILENCE_DB


def test_values_that_are_not_numbers_never_become_levels():
    signal = np.where(TIME == 1.0, np.nan, 1.0)
    with pytest.raises(ParameterError, match="signal: holds values that are not finite numbers"):
        recorded_levels(signal, RATE, 20e-6, "A")
    with pytest.raises(ParameterError, match="signal: holds values that are not finite numbers"):
        equivalent_level(np.array([1.0, np.inf]), 1.0)


def test_unknown_weighting_is_named():
    with pytest.raises(ParameterError, match="weighting 'B': must be one of Z, A, C"):
        weighted_signal(np.zeros(100), RATE, "B")


def test_reference_is_never_guessed():
    assert level_reference("Pa") == 20e-6
    assert level_reference("m/s^2", 1e-6) == 1e-6
    assert level_reference("Pa", 1.0) == 1.0
    with pytest.raises(ParameterError, match=r"unit 'm/s\^2': its levels need a reference value"):
        level_reference("m/s^2")
    with pytest.raises(ParameterError, match=r"reference = 0 m/s\^2: must be above 0"):
        level_reference("m/s^2", 0.0)
    with pytest.raises(ParameterError, match="reference = nan Pa"):
        level_reference("Pa", float("nan"))
