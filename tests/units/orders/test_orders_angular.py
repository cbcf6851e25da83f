"""Angular resampling: gain, phase, aliasing, ends, limits."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders import angular_resample, whole_revolutions
from vibroacoustics.orders.angular_plan import ATTENUATION_DB, HIGHEST_PASS_BAND_RATIO
from vibroacoustics.orders.crank_motion import constant_speed, from_angle, from_speed

RIPPLE = 10.0 ** (-ATTENUATION_DB / 20.0)
"""Of the kernel, in the pass band and in the stop band."""
SLACK = 2.0 * RIPPLE
"""Ripple of a tone at its own order and of its images beyond the sample rate, which lie deeper in
the stop band."""
TARGET_DB = -90.0


def run_up(low_hz, high_hz, duration_s, points=9):
    return from_speed(np.linspace(0.0, duration_s, points), np.linspace(low_hz, high_hz, points))


def times(motion, sample_rate_hz):
    return np.arange(int(motion.end_s * sample_rate_hz) + 1) / sample_rate_hz


def tone(motion, sample_rate_hz, order, phase=0.0):
    return np.cos(order * motion.angle_rad(times(motion, sample_rate_hz)) + phase)


def over_angle(angular, order, phase=0.0):
    return np.cos(2.0 * np.pi * order * angular.revolution + phase)


@pytest.mark.parametrize("order", [0.0, 0.5, 1.0, 2.75, 30.0, 59.0, 60.0])
def test_orders_of_a_run_up_come_out_as_they_are(order):
    """Amplitude and phase at every angle, to the kernel's ripple; at the maximum order too."""
    motion = run_up(20.0, 100.0, 3.0)
    angular = angular_resample(tone(motion, 25600.0, order, 0.7), 25600.0, motion, 60.0)
    expected = over_angle(angular, order, 0.7)
    np.testing.assert_allclose(angular.values, expected, rtol=0.0, atol=SLACK)


def test_speed_that_swings_within_a_revolution():
    """A single-cylinder compressor: ±10 % twice a revolution, while it runs up."""
    time_s = np.linspace(0.0, 2.0, 4001)
    mean = 20.0 + 10.0 * time_s
    speed = mean * (1.0 + 0.1 * np.sin(2.0 * np.pi * 2.0 * np.cumsum(mean) * 5e-4))
    motion = from_speed(time_s, speed)
    angular = angular_resample(tone(motion, 25600.0, 24.0), 25600.0, motion, 40.0)
    np.testing.assert_allclose(angular.values, over_angle(angular, 24.0), rtol=0.0, atol=SLACK)


def test_crank_angle_zero_within_the_recording():
    """The grid counts from the motion's zero, also where that lies before or after the start."""
    revolution = np.linspace(-7.3, 50.2, 100)
    motion = from_angle(np.linspace(0.1, 2.0, 100), 2.0 * np.pi * revolution)
    time_s = np.arange(5000) / 2000.0
    known = (time_s >= 0.1) & (time_s <= 2.0)
    signal = np.where(known, np.cos(3.0 * motion.angle_rad(np.clip(time_s, 0.1, 2.0)) + 1.0), 9.0)
    angular = angular_resample(signal, 2000.0, motion, 10.0)
    assert angular.first_sample < 0
    np.testing.assert_allclose(angular.values, over_angle(angular, 3.0, 1.0), rtol=0, atol=SLACK)
    np.testing.assert_allclose(
        motion.angle_rad(angular.time_s) / (2.0 * np.pi), angular.revolution, atol=1e-12
    )


@pytest.mark.parametrize("frequency_hz", np.linspace(6100.0, 25500.0, 15))
def test_tone_above_the_grid_leaves_nothing(frequency_hz):
    """Half of 240 samples a revolution at 50 rev/s is 6 kHz; all above is gone."""
    motion = constant_speed(50.0, 0.0, 1.0)
    time_s = times(motion, 51200.0)
    signal = tone(motion, 51200.0, 1.0) + np.cos(2.0 * np.pi * frequency_hz * time_s + 0.3)
    angular = angular_resample(signal, 51200.0, motion, 60.0)
    spurious = angular.values - over_angle(angular, 1.0)
    assert 10.0 * np.log10(np.mean(spurious**2) / 0.5) <= TARGET_DB


@pytest.mark.parametrize("frequency_hz", [3500.0, 6500.0, 9000.0, 12700.0])
def test_tone_above_the_order_range_of_a_run_up(frequency_hz):
    """It may stay where it is, above the maximum order; below that nothing of it is found."""
    motion = run_up(20.0, 50.0, 4.0)
    time_s = times(motion, 25600.0)
    signal = np.cos(2.0 * np.pi * frequency_hz * time_s)
    angular = angular_resample(signal, 25600.0, motion, 60.0)
    window = np.blackman(angular.time_s.size)  # its side lobes fall below -90 dB within 0.3 orders
    lines = np.abs(np.fft.rfft(angular.values * window)) * 2.0 / window.sum()
    order = np.arange(lines.size) * angular.samples_per_revolution / angular.time_s.size
    assert frequency_hz / 50.0 > 60.3
    assert 20.0 * np.log10(np.max(lines[order <= 60.0])) <= TARGET_DB


def test_direct_interpolation_aliases_where_this_does_not():
    """20 kHz is order 400 at 50 rev/s; 256 samples a revolution show it as order 112."""
    motion = constant_speed(50.0, 0.0, 1.0)
    time_s = times(motion, 102400.0)
    signal = tone(motion, 102400.0, 1.0) + np.cos(2.0 * np.pi * 20000.0 * time_s)
    angular = angular_resample(signal, 102400.0, motion, 64.0)
    assert angular.samples_per_revolution == 256
    fundamental = over_angle(angular, 1.0)
    direct = np.interp(angular.time_s, time_s, signal) - fundamental
    assert 10.0 * np.log10(np.mean(direct**2) / 0.5) > -2.0
    ours = angular.values - fundamental
    assert 10.0 * np.log10(np.mean(ours**2) / 0.5) <= TARGET_DB


def test_linear_and_channel_by_channel():
    generator = np.random.default_rng(1)
    motion = run_up(10.0, 30.0, 2.0)
    signal = generator.standard_normal((2, 3, 4001))
    whole = angular_resample(signal, 2000.0, motion, 20.0)
    assert whole.values.shape == (2, 3, whole.time_s.size)
    one = angular_resample(signal[1, 2], 2000.0, motion, 20.0)
    np.testing.assert_array_equal(whole.values[1, 2], one.values)
    mixed = angular_resample(2.0 * signal[0, 0] - 3.0 * signal[1, 2], 2000.0, motion, 20.0)
    # Sums of at most 2000/10 samples a revolution of size 1 round to eps each.
    expected = 2.0 * whole.values[0, 0] - 3.0 * whole.values[1, 2]
    np.testing.assert_allclose(mixed.values, expected, rtol=0.0, atol=200 * 5 * 2.3e-16)


def test_single_precision_signal_that_is_not_contiguous():
    motion = constant_speed(25.0, 0.0, 1.0)
    signal = np.random.default_rng(2).standard_normal((1001, 2)).astype(np.float32)
    strided = angular_resample(signal.T, 1000.0, motion, 10.0)
    plain = angular_resample(signal.T.astype(float).copy(), 1000.0, motion, 10.0)
    np.testing.assert_array_equal(strided.values, plain.values)


def test_outputs_lie_where_the_whole_kernel_has_samples():
    """What lies outside the recording has no say: the ends are as good as the middle."""
    motion = constant_speed(30.0, 0.0, 2.0)
    long = tone(motion, 3000.0, 5.0)
    angular = angular_resample(long[900:4500], 3000.0, constant_speed(30.0, 0.0, 1.2), 20.0)
    lost = 36.0 - (angular.time_s.size - 1) / angular.samples_per_revolution
    assert 0.0 < lost < 0.5
    np.testing.assert_allclose(  # 900 samples are nine revolutions
        angular.values, over_angle(angular, 5.0), rtol=0.0, atol=SLACK
    )


# --- what it refuses -----------------------------------------------------------------------------


@settings(max_examples=25, deadline=None)
@given(order=st.one_of(st.floats(max_value=0.0), st.floats(min_value=46.0), st.just(np.nan)))
def test_highest_possible_order_is_named(order):
    motion = run_up(10.0, 50.0, 1.0)
    limit = HIGHEST_PASS_BAND_RATIO * 5000.0 / (2.0 * 50.0)
    assert limit == pytest.approx(45.0)
    with pytest.raises(ParameterError, match=r"maximum_order = .* at most 45 at .* 3000 rpm"):
        angular_resample(np.zeros(5001), 5000.0, motion, order)


def test_highest_possible_order_is_possible():
    motion = run_up(10.0, 50.0, 1.0)
    angular = angular_resample(tone(motion, 5000.0, 45.0), 5000.0, motion, 45.0)
    np.testing.assert_allclose(angular.values, over_angle(angular, 45.0), rtol=0.0, atol=SLACK)


@given(value=st.sampled_from([np.nan, np.inf, -np.inf]), at=st.integers(0, 999))
def test_samples_that_are_not_finite(value, at):
    signal = np.zeros(1000)
    signal[at] = value
    with pytest.raises(ParameterError, match="not finite"):
        angular_resample(signal, 1000.0, constant_speed(20.0, 0.0, 1.0), 5.0)


def test_motion_beside_the_signal():
    with pytest.raises(ParameterError, match=r"known from 5 s to 6 s.*0 s to 0.999 s"):
        angular_resample(np.zeros(1000), 1000.0, constant_speed(20.0, 5.0, 6.0), 5.0)


def test_too_few_revolutions():
    with pytest.raises(ParameterError, match="revolutions are too few"):
        angular_resample(np.zeros(10), 1000.0, constant_speed(20.0, 0.0, 1.0), 5.0)


@pytest.mark.parametrize("rate", [0.0, -1.0, np.nan])
def test_sample_rate(rate):
    with pytest.raises(ParameterError, match="sample_rate_hz"):
        angular_resample(np.zeros(10), rate, constant_speed(20.0, 0.0, 1.0), 5.0)


def test_simulated_revolutions_must_divide_the_samples():
    with pytest.raises(ParameterError, match=r"100 samples .* 3 revolutions"):
        whole_revolutions(np.zeros(100), 3, 50.0)
