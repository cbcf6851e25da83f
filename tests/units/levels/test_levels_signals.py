"""Levels of recorded signals: weighting at the exact frequency, Fast and Slow, Leq, references."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from weighting_table import IEC_61672_1_TABLE_3

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels import (
    FAST_TIME_CONSTANT_S,
    SILENCE_DB,
    SLOW_TIME_CONSTANT_S,
    WEIGHTING,
    band_levels,
    band_signal,
    bands_between,
    energy_sum,
    equivalent_level,
    level_reference,
    mean_square_level,
    recorded_levels,
    time_weighted_mean_square,
    weighted_signal,
)
from vibroacoustics.levels.band_meter import BandMeter
from vibroacoustics.levels.level_meter import RUN_IN_S, LevelMeter, MeterPlan

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

    A and C begin and end 0.1 s off the ends.
    """
    signal = np.sqrt(2.0) * np.cos(2.0 * np.pi * 1000.0 * TIME)
    for weighting in WEIGHTING:
        levels = recorded_levels(signal, RATE, level_reference("Pa"), weighting)
        assert levels.equivalent_db == pytest.approx(93.979, abs=0.01)
        assert levels.fast_maximum_db == pytest.approx(93.979, abs=0.02)
        # Slow has reached 1 - exp(-t) of a steady tone after t s.
        duration_s = 3.0 if weighting == "Z" else 2.8
        slow = 93.979 + 10.0 * np.log10(1.0 - np.exp(-duration_s))
        assert levels.slow_maximum_db == pytest.approx(slow, abs=0.002)


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
        # Lines are of 2.95 s, levels of 2.8 s: independent values 2 (T = 0.15 s) 16 kHz of 9.6e4.
        tolerance_db = 0.001 if weighting == "Z" else 0.01
        np.testing.assert_allclose(energy_sum(levels, axis=-1), whole, atol=tolerance_db)


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


# --- the ends of a recording ---------------------------------------------------------------------


@pytest.mark.parametrize("weighting", ["A", "C", "Z"])
@pytest.mark.parametrize("rate", [8000.0, 51_200.0])
@pytest.mark.parametrize("duration_s", [1.0, 2.0, pytest.param(6.3, marks=pytest.mark.long)])
def test_steady_tone_reads_what_it_is(weighting, rate, duration_s):
    """From 20 Hz up, at any starting phase: within 0.05 dB, the Fast ripple included.

    The Fast mean square of a tone ripples by 1/√(1 + (2 ω τ)²): +0.136 dB at 20 Hz.
    """
    time = np.arange(int(duration_s * rate)) / rate
    for frequency in (20.0, 20.7, 29.0, 50.4, 123.0, 997.0, 3500.0):
        for phase in (0.0, 0.8, 1.6, 2.4, 3.9, 5.5):
            tone = np.cos(2.0 * np.pi * frequency * time + phase)
            levels = recorded_levels(tone, rate, 1.0, weighting)
            expected = 10.0 * np.log10(0.5) + WEIGHTING[weighting](frequency)
            assert levels.equivalent_db == pytest.approx(expected, abs=0.05)
            ripple = 1.0 / np.hypot(1.0, 4.0 * np.pi * frequency * FAST_TIME_CONSTANT_S)
            fast = expected + 10.0 * np.log10(1.0 + ripple)
            assert levels.fast_maximum_db == pytest.approx(fast, abs=0.05)


def test_low_tone_leaves_nothing_in_high_bands():
    """29 Hz for 2 s, A-weighted: its cut ends would read as much as itself, at 1 kHz."""
    tone = np.cos(2.0 * np.pi * 29.3 * np.arange(int(2.0 * RATE)) / RATE)
    bands = bands_between(3, 25.0, 20e3)
    levels = band_levels(tone, RATE, bands, 1.0, "A")
    assert energy_sum(levels, axis=-1) == pytest.approx(
        10.0 * np.log10(0.5) + WEIGHTING["A"](29.3), abs=0.1
    )
    assert levels[bands.index(bands_between(3, 1000.0, 1000.0)[0])] < levels.max() - 50.0


def test_ramps_of_a_long_recording_do_not_leak():
    """Of a tone a low band holds what its two ends leak: |Σ cos(ω₀ n + φ) e^(-iωn)|² each.

    Each of 13 transforms would leak as much again at a step. The band's edges cut lines 0.1 Hz
    apart: 0.1 % of it.
    """
    rate, tone_hz, seconds = 4000.0, 1000.033, 100.0
    (band,) = bands_between(1, 125.0, 125.0)
    turn = 2.0 * np.pi * tone_hz / rate
    tone = np.cos(turn * np.arange(int(seconds * rate)))
    meter = BandMeter(tone.size, rate, [band])
    meter.add(tone)
    hertz = np.linspace(band.lower_hz, band.upper_hz, 2001)
    omega = 2.0 * np.pi * hertz / rate
    energy = 0.0
    for phase in (0.0, -turn * (tone.size - 1)):  # the end as a begin, in reversed time
        there = np.exp(1j * phase) / (1.0 - np.exp(1j * (turn - omega)))
        back = np.exp(-1j * phase) / (1.0 - np.exp(-1j * (turn + omega)))
        energy += 2.0 * np.trapezoid(np.abs(0.5 * (there + back) / rate) ** 2, hertz)
    assert meter.mean_square() == pytest.approx([energy / seconds], rel=0.01)


def test_short_recordings_keep_their_middle():
    """At most a quarter is left out at either end, of a recording of one sample nothing."""
    assert MeterPlan(1, RATE).run_in == 0
    assert MeterPlan(400, 8000.0).run_in == 100
    assert MeterPlan(8000, 8000.0).run_in_s == pytest.approx(RUN_IN_S)
    assert np.isfinite(recorded_levels(np.array([1.0]), RATE, 1.0, "A").equivalent_db)


@settings(max_examples=20, deadline=None)
@given(cuts=st.lists(st.integers(1, 19_999), max_size=5), samples=st.integers(15_000, 20_000))
def test_pieces_of_a_recording_give_its_levels(cuts, samples):
    """2.5 s a block at 2 kHz: several blocks, however the pieces are cut."""
    signal = np.random.default_rng(samples).standard_normal(samples) + 0.5
    plan = MeterPlan(samples, 2000.0)
    at_once, by_piece = LevelMeter(plan, 0.5), LevelMeter(plan, 0.5)
    at_once.add(signal)
    for piece in np.split(signal, sorted({min(cut, samples) for cut in cuts})):
        by_piece.add(piece)
    np.testing.assert_allclose(by_piece.lines, at_once.lines, rtol=1e-12)
    for weighting in WEIGHTING:
        expected = at_once.mean_square(weighting)
        np.testing.assert_allclose(by_piece.mean_square(weighting), expected, rtol=1e-12)


@pytest.mark.parametrize("weighting", ["A", "C"])
def test_blocks_are_put_together_without_a_seam(weighting):
    """Against one transform of all of the recording, a second method."""
    signal = np.random.default_rng(4).standard_normal(40_000).cumsum() * 1e-2
    plan = MeterPlan(signal.size, 2000.0)
    meter = LevelMeter(plan, float(signal.mean()))
    meter.add(signal)
    weighted = weighted_signal(signal - signal.mean(), 2000.0, weighting)
    middle = weighted[plan.run_in : -plan.run_in]
    fast = time_weighted_mean_square(middle, 2000.0, FAST_TIME_CONSTANT_S)
    mean, most, _ = meter.mean_square(weighting)
    assert mean == pytest.approx(np.mean(middle**2), rel=1e-4)
    assert most == pytest.approx(fast.max(), rel=1e-4)


def test_meter_refuses_more_than_was_planned_and_what_is_no_number():
    meter = LevelMeter(MeterPlan(10, 1000.0), 0.0)
    with pytest.raises(ParameterError, match="holds values that are not finite"):
        meter.add(np.array([1.0, np.inf]))
    with pytest.raises(ParameterError, match="more than the 10 samples planned"):
        meter.add(np.zeros(11))


def test_filters_read_15_to_20_db_more_beside_a_strong_tone():
    """A tone in the middle of 1 kHz over noise: the skirts of the filters of 800 and 1250 Hz.

    A Butterworth of order 4 is 10 lg(1 + Ω^8) down, Ω = (f/f_m - f_m/f) / (f_2/f_m - f_1/f_m).
    """
    rng = np.random.default_rng(3)
    time = np.arange(int(8.0 * RATE)) / RATE
    signal = np.cos(2.0 * np.pi * 1000.0 * time) + 0.055 * rng.standard_normal(time.size)
    bands = bands_between(3, 800.0, 1250.0)
    sums, filters = (
        band_levels(signal, RATE, bands, 1.0, "Z", method) for method in ("sums", "filters")
    )
    assert filters[1] == pytest.approx(sums[1], abs=0.05)
    for side in (0, 2):
        band = bands[side]
        ratio = 1000.0 / band.middle_hz
        distance = abs(ratio - 1.0 / ratio) * band.middle_hz / (band.upper_hz - band.lower_hz)
        skirt = 10.0 * np.log10(0.5 / (1.0 + distance**8))
        assert filters[side] == pytest.approx(skirt, abs=0.5)
        assert 15.0 < filters[side] - sums[side] < 20.0


def test_filters_are_those_over_time():
    """Second method: the class 1 filters over time, without their run-in."""
    rng = np.random.default_rng(5)
    signal = rng.standard_normal(int(20.0 * 8000.0))
    bands = bands_between(3, 200.0, 2000.0)
    levels = band_levels(signal, 8000.0, bands, 1.0, "Z", "filters")
    for band, level in zip(bands, levels, strict=True):
        passed = band_signal(signal, 8000.0, band)[1000:]
        assert level == pytest.approx(float(equivalent_level(passed, 1.0)), abs=0.1)


def test_unknown_band_method_is_named():
    with pytest.raises(ParameterError, match="method = 'octaves': must be one of sums, filters"):
        band_levels(np.zeros(1000), RATE, bands_between(3, 1e3, 1e3), 1.0, "A", "octaves")
