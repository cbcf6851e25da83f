"""Orders changed within a signal: their levels, the residual, orders at zero, change and inverse.

The machines are synthetic: orders of known envelopes, noise, steady or in a run-up.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.signal import welch

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.crank_motion import constant_speed, from_speed
from vibroacoustics.orders.separated import changed_signal, order_sum, separated_orders
from vibroacoustics.orders.vold_kalman_equations import Track

RATE = 8192.0
DURATION = 60.0
TIME = np.arange(int(DURATION * RATE)) / RATE
EVEN = constant_speed(49.3, 0.0, DURATION)
RUN_UP = from_speed(np.array([0.0, DURATION]), np.array([20.0, 60.0]))
PEAKS = np.array([1.0, 0.5, 0.3, 0.2, 0.1, 0.05]) * np.exp(0.7j * np.arange(6))
RATIOS = np.array([0.5, 1.5 * np.exp(1.0j), 0.3, -0.7, 2.0, 0.8j])
NOISE = 0.02 * np.random.default_rng(1).standard_normal(TIME.size)
MACHINES = {
    "steady": [Track(EVEN, order) for order in range(1, 7)],
    "run-up": [Track(RUN_UP, order) for order in range(1, 7)],
}


def orders_of(tracks, envelopes):
    """Sum of orders by their definition, every envelope of shape () or (time,)."""
    return sum(
        np.real(envelope * np.exp(1j * track.order * track.motion.angle_rad(TIME)))
        for track, envelope in zip(tracks, envelopes, strict=True)
    )


def changed(signal, tracks, ratios, bandwidth_hz=1.0):
    separated = separated_orders(signal, RATE, tracks, bandwidth_hz)
    shape = separated.envelope.shape
    ratio = np.broadcast_to(np.asarray(ratios, dtype=complex)[:, None], shape)
    return changed_signal(signal, RATE, separated, ratio)


def level_by_correlation(signal, track, peak, part=slice(None)):
    """Level of an order over the expected one, dB, by correlation with it (a second method)."""
    carrier = np.exp(-1j * track.order * track.motion.angle_rad(TIME[part]))
    found = 2.0 * np.mean(signal[part] * carrier)
    return 20.0 * np.log10(np.abs(found / peak)), np.angle(found / peak)


def third_octaves(signal):
    """Mean squares by third octave, 63 Hz to 3.15 kHz, from one transform."""
    square = np.abs(np.fft.rfft(signal)) ** 2
    hertz = np.fft.rfftfreq(signal.size, 1.0 / RATE)
    centres = 1000.0 * 10.0 ** (np.arange(-12, 6) / 10.0)
    return np.array(
        [
            square[(hertz >= centre * 10.0**-0.05) & (hertz < centre * 10.0**0.05)].sum()
            for centre in centres
        ]
    )


@pytest.mark.parametrize("tracks", MACHINES.values(), ids=MACHINES)
def test_changed_orders_and_the_residual(tracks):
    """Levels within 0.1 dB, phases within 1°; the residual's third octaves within 0.05 dB."""
    after = changed(orders_of(tracks, PEAKS) + NOISE, tracks, RATIOS)
    for track, peak in zip(tracks, RATIOS * PEAKS, strict=True):
        level, phase = level_by_correlation(after, track, peak)
        assert abs(level) < 0.1
        assert abs(phase) < np.radians(1.0)
    residual = after - orders_of(tracks, RATIOS * PEAKS)
    error = 10.0 * np.log10(third_octaves(residual) / third_octaves(NOISE))
    assert np.max(np.abs(error)) < 0.05


def test_orders_that_cross_in_a_run_up():
    """A run-up crosses lines of an even shaft and the orders of a run-down: within 0.5 dB."""
    down = from_speed(np.array([0.0, DURATION]), np.array([55.0, 25.0]))
    tracks = [Track(RUN_UP, 1), Track(RUN_UP, 2), Track(EVEN, 1), Track(down, 1)]
    peaks, ratios = PEAKS[[0, 1, 0, 2]], np.array([0.5, 2.0, 1.0, 0.25j])
    after = changed(orders_of(tracks, peaks) + NOISE, tracks, ratios, 0.8)
    error = after - orders_of(tracks, ratios * peaks) - NOISE
    crossing = np.argmin(np.abs(RUN_UP.frequency_hz(TIME) - 49.3))
    around = slice(crossing - 4 * int(RATE), crossing + 4 * int(RATE))
    for track, peak in zip(tracks, ratios * peaks, strict=True):
        level, _ = level_by_correlation(orders_of([track], [peak]) + error, track, peak, around)
        assert abs(level) < 0.5
        rms = np.std(error[around]) / np.std(orders_of([track], [peak])[around])
        assert 20.0 * np.log10(rms) < -40.0


def test_an_order_with_a_resonance_in_the_run_up():
    """Order 2 passes a resonance of 5 % loss at 80 Hz: its maximum and all else within 0.1 dB."""
    tracks = MACHINES["run-up"]
    hertz = 2.0 * RUN_UP.frequency_hz(TIME)
    response = 1.0 / (1.0 - (hertz / 80.0) ** 2 + 0.05j)
    envelopes = [*PEAKS[:1], 0.05 * response, *PEAKS[2:]]
    after = changed(orders_of(tracks, envelopes) + NOISE, tracks, RATIOS, 2.0)
    wanted = [ratio * each for ratio, each in zip(RATIOS, envelopes, strict=True)]
    again = separated_orders(after, RATE, tracks, 2.0)
    expected = np.interp(again.time_s, TIME, np.abs(wanted[1]))
    top = expected > 0.5 * expected.max()
    error = 20.0 * np.log10(np.abs(again.envelope[1]) / expected)[top]
    assert np.max(np.abs(error)) < 0.1


def test_orders_at_zero_leave_what_is_beside_them():
    """The power within 2 Hz of all lines is that from 4 to 14 Hz beside them, within 1 dB."""
    tracks = MACHINES["steady"]
    after = changed(orders_of(tracks, PEAKS) + NOISE, tracks, np.zeros(6))
    hertz, density = welch(after, RATE, nperseg=int(RATE), noverlap=int(RATE) // 2)
    at_lines, beside = [], []
    for order in range(1, 7):
        distance = np.abs(hertz - order * 49.3)
        at_lines.append(density[distance < 2.0].mean())
        beside.append(density[(distance > 4.0) & (distance < 14.0)].mean())
    ratio = np.array(at_lines) / np.array(beside)
    assert np.max(np.abs(10.0 * np.log10(ratio))) < 1.0
    assert abs(10.0 * np.log10(ratio.mean())) < 0.4


def test_a_tone_beside_an_order_stays():
    """A tone of the supply 1.7 Hz beside order 2 and ten times as large is not changed."""
    tracks = MACHINES["steady"]
    tone = 5.0 * np.cos(2.0 * np.pi * 100.3 * TIME)
    after = changed(orders_of(tracks, PEAKS) + tone + NOISE, tracks, np.zeros(6))
    difference = after - tone - NOISE
    found = 2.0 * np.mean(difference * np.exp(-2j * np.pi * 100.3 * TIME))
    assert 20.0 * np.log10(np.abs(found) / 5.0) < -60.0
    left, _ = level_by_correlation(difference, tracks[1], PEAKS[1])
    assert left < -40.0


def test_orders_that_swing_are_removed_to_the_noise():
    """Amplitude and phase vary by 10 % and 0.1 rad within 0.25 Hz: 1.5 dB is left at most."""
    tracks = MACHINES["steady"]
    random, knots = np.random.default_rng(5), np.arange(-4.0, 66.0, 2.0)
    amplitude, phase = (CubicSpline(knots, random.standard_normal(35))(TIME) for _ in range(2))
    swing = (1.0 + 0.1 * amplitude) * np.exp(0.1j * phase)
    after = changed(
        orders_of(tracks, [peak * swing for peak in PEAKS]) + NOISE, tracks, np.zeros(6), 2.0
    )
    hertz, density = welch(after, RATE, nperseg=2 * int(RATE))
    for order in range(1, 7):
        distance = np.abs(hertz - order * 49.3)
        beside = density[(distance > 4.0) & (distance < 14.0)].mean()
        ratio = 10.0 * np.log10(density[distance < 2.0].mean() / beside)
        assert abs(ratio) < 1.5, order


def test_noise_without_orders_stays():
    """Nothing is taken out where there is no order: within 1e-3 of the noise."""
    after = changed(NOISE, MACHINES["steady"], np.zeros(6))
    assert np.sqrt(np.mean((after - NOISE) ** 2) / np.mean(NOISE**2)) < 1e-3


@pytest.mark.parametrize("tracks", MACHINES.values(), ids=MACHINES)
def test_change_and_inverse_return_the_signal(tracks):
    signal = orders_of(tracks, PEAKS) + NOISE
    again = changed(changed(signal, tracks, RATIOS), tracks, 1.0 / RATIOS)
    error = np.sqrt(np.mean((again - signal) ** 2) / np.mean(signal**2))
    assert 20.0 * np.log10(error) < -60.0


def test_a_sudden_ratio_over_time_is_followed():
    """A ratio of 1 in the first half and 0 in the second changes the second half alone."""
    tracks = MACHINES["steady"][:1]
    signal = orders_of(tracks, PEAKS[:1])
    separated = separated_orders(signal, RATE, tracks, 1.0)
    ratio = np.where(separated.time_s < 30.0, 1.0 + 0.0j, 0.0)[None]
    after = changed_signal(signal, RATE, separated, ratio)
    assert np.max(np.abs(after - signal)[TIME < 29.0]) < 1e-3
    assert np.max(np.abs(after)[TIME > 31.0]) < 1e-3


def test_mean_squares_of_order_and_noise():
    """Order: half its peak squared. Noise: density times ∫H² = 1.04 bandwidths of two poles."""
    tracks = MACHINES["run-up"]
    separated = separated_orders(orders_of(tracks, PEAKS) + NOISE, RATE, tracks, 2.0)
    np.testing.assert_allclose(separated.order_square, 0.5 * np.abs(PEAKS) ** 2, rtol=0.02)
    density = 0.02**2 / (0.5 * RATE)
    assert np.mean(separated.noise_square) == pytest.approx(1.04 * 2.0 * density, rel=0.1)


def test_the_sum_is_zero_where_the_shaft_is_unknown():
    motion = constant_speed(50.0, 10.0, 20.0)
    time = 10.0 + np.arange(41) / 4.0
    sound = order_sum([Track(motion, 1)], time, np.ones((1, 41), complex), TIME.size, RATE)
    inside = (TIME >= 10.0) & (TIME <= 20.0)
    np.testing.assert_array_equal(sound[~inside], 0.0)
    np.testing.assert_allclose(sound[inside], np.cos(100.0 * np.pi * TIME[inside]), atol=1e-9)


def test_a_ratio_of_another_shape_is_refused():
    tracks = MACHINES["steady"][:1]
    separated = separated_orders(NOISE, RATE, tracks, 1.0)
    with pytest.raises(ParameterError, match=r"ratio: shape \(1,\), must be \(1, \d+\)"):
        changed_signal(NOISE, RATE, separated, np.ones(1, complex))
