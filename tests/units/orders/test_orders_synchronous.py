"""Time-synchronous average and synchronous demodulation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders import (
    OrderResolutionWarning,
    angular_resample,
    order_spectrum,
    synchronous_demodulation,
    time_synchronous_average,
    whole_revolutions,
)
from vibroacoustics.orders.crank_motion import from_speed

RIPPLE = 1e-4
"""Of the envelope's low-pass, 80 dB."""


def sampled(function, revolutions=60, samples=64):
    revolution = np.arange(revolutions * samples) / samples
    return whole_revolutions(function(revolution), revolutions, 25.0)


# --- average -------------------------------------------------------------------------------------


def test_average_of_what_repeats():
    signal = sampled(lambda r: np.cos(2 * np.pi * r) + np.cos(np.pi * r + 0.2))
    once, twice = (time_synchronous_average(signal, revolutions) for revolutions in (1, 2))
    assert (once.averages, twice.averages) == (60, 30)
    np.testing.assert_allclose(once.mean, np.cos(2 * np.pi * np.arange(64) / 64), atol=1e-14)
    np.testing.assert_allclose(twice.mean, signal.values[:128], atol=1e-13)
    assert np.max(twice.standard_error) < 1e-14
    assert np.min(np.max(once.standard_error)) > 0.1


def test_average_begins_at_crank_angle_zero():
    """Whatever the first revolution of the recording: its spectrum has the phase of the orders."""
    motion = from_speed(np.linspace(0.0, 4.0, 5), np.linspace(10.0, 30.0, 5))
    angle = motion.angle_rad(np.arange(8001) / 2000.0)
    signal = np.stack([np.cos(angle + 0.3), 2.0 * np.sin(2.5 * angle)])
    average = time_synchronous_average(angular_resample(signal, 2000.0, motion, 10.0), 2)
    spectrum = order_spectrum(average.mean, 3, 2)
    expected = np.zeros((2, 4), complex)
    expected[0, 1] = np.exp(0.3j)
    np.testing.assert_allclose(spectrum, expected, atol=3e-5)  # ripple of the resampling, 1e-5
    half_orders = order_spectrum(average.mean, 5)  # of both revolutions taken as one
    assert half_orders[1, 5] == pytest.approx(-2.0j, abs=6e-5)


def test_standard_error_of_noise():
    generator = np.random.default_rng(7)
    signal = sampled(lambda r: 3.0 * generator.standard_normal(r.size), 400)
    average = time_synchronous_average(signal)
    # χ² of 64 · 399 numbers, five standard errors.
    slack = 5.0 * np.sqrt(2.0 / (64 * 399))
    assert np.mean(average.standard_error**2) == pytest.approx(9.0 / 400, rel=slack)
    assert np.mean(average.mean**2) == pytest.approx(9.0 / 400, rel=5.0 * np.sqrt(2.0 / 64))


@pytest.mark.parametrize(("revolutions", "message"), [(31, "holds 1 whole"), (61, "holds 0 whole")])
def test_too_few_revolutions_to_average(revolutions, message):
    with pytest.raises(ParameterError, match=message):
        time_synchronous_average(sampled(np.cos), revolutions)


@given(revolutions=st.integers(max_value=0))
def test_no_revolutions_to_average(revolutions):
    with pytest.raises(ParameterError, match="must be at least 1"):
        time_synchronous_average(sampled(np.cos), revolutions)


# --- demodulation --------------------------------------------------------------------------------


def test_envelopes_of_a_run_up():
    """Orders of 10 to 40 rev/s at 600 Hz, each with its amplitude and phase all along."""
    motion = from_speed(np.linspace(0.0, 5.0, 6), np.linspace(10.0, 40.0, 6))
    angle = motion.angle_rad(np.arange(3001) / 600.0)
    peaks = {0.5: 0.5, 1.0: 1.0, 4.0: np.sqrt(2.0), 6.0: 2.0}
    signal = sum(peak * np.cos(order * angle + order) for order, peak in peaks.items())
    angular = angular_resample(signal, 600.0, motion, 6.7)
    envelope = synchronous_demodulation(angular, list(peaks), 0.5)
    assert envelope.amplitude.shape == (4, envelope.time_s.size)
    for number, (order, peak) in enumerate(peaks.items()):
        # Its own gain and what is left of the others and of all images: ripple of each.
        slack = RIPPLE * (peak + sum(peaks.values()))
        expected = peak * np.exp(1j * order)
        np.testing.assert_allclose(envelope.amplitude[number], expected, rtol=0.0, atol=slack)
    np.testing.assert_allclose(
        motion.angle_rad(envelope.time_s) / (2.0 * np.pi), envelope.revolution, atol=1e-5
    )


@pytest.mark.parametrize("order", [3.0, 3.123456, 17.9])
@pytest.mark.parametrize("modulation", [0.0, 1 / 8, 1 / 4])
def test_modulation_in_the_pass_band(order, modulation):
    def modulated(r):
        return (1.0 + 0.3 * np.cos(2 * np.pi * modulation * r)) * np.cos(2 * np.pi * order * r + 1)

    envelope = synchronous_demodulation(sampled(modulated), [order], 1.0)
    expected = 1.0 + 0.3 * np.cos(2 * np.pi * modulation * envelope.revolution)
    # The low-pass is centred on the nearest of the lines, 1/60 order: a hair into the transition.
    np.testing.assert_allclose(
        envelope.amplitude[0], expected * np.exp(1j), rtol=0.0, atol=10.0 * RIPPLE
    )


@pytest.mark.parametrize(
    ("distance", "gain", "slack"),
    [(0.25, 1.0, RIPPLE), (0.625, 0.5, 2e-3), (1.0, 0.0, RIPPLE), (1.3, 0.0, RIPPLE),
     (-1.0, 0.0, RIPPLE), (9.0, 0.0, RIPPLE)],
)  # fmt: skip
def test_gain_over_the_distance(distance, gain, slack):
    """What the envelope says of its bandwidth is so."""
    tone = sampled(lambda r: np.cos(2 * np.pi * (10.0 + distance) * r), 80)
    envelope = synchronous_demodulation(tone, [10.0], 1.0)
    # Twice: at the tone and at its image at the negative order.
    np.testing.assert_allclose(np.abs(envelope.amplitude), gain, rtol=0.0, atol=2.0 * slack)


def test_ends_know_nothing_of_each_other():
    """A signal that differs at its ends: a circular filter would mix them."""
    signal = sampled(lambda r: np.exp(r / 20.0) * np.cos(2 * np.pi * 5.0 * r))
    envelope = synchronous_demodulation(signal, [5.0], 1.0)
    lost = 60.0 - (envelope.revolution[-1] - envelope.revolution[0])
    assert 6.7 <= lost < 8.3  # the kernel and at most the grid's steps
    expected = np.exp(envelope.revolution / 20.0)
    # The kernel's mean of exp(u/20) is not 1: half its second moment, below 0.05, over 20².
    np.testing.assert_allclose(envelope.amplitude[0].real, expected, rtol=3e-4)


def test_simulated_orders_are_those_of_the_order_spectrum():
    signal = sampled(lambda r: np.cos(2 * np.pi * r + 0.1) + 0.2 * np.sin(6 * np.pi * r) + 0.7)
    orders = np.arange(1, 9)
    envelope = synchronous_demodulation(signal, orders, 1.0)
    expected = order_spectrum(signal.values, 8, 60)[1:, None]
    np.testing.assert_allclose(
        envelope.amplitude, np.broadcast_to(expected, envelope.amplitude.shape), atol=4 * RIPPLE
    )


def test_channels_are_independent():
    generator = np.random.default_rng(8)
    signal = whole_revolutions(generator.standard_normal((2, 2, 1920)), 30, 25.0)
    whole = synchronous_demodulation(signal, [2.0, 5.0], 1.5).amplitude
    one = whole_revolutions(signal.values[1, 0], 30, 25.0)
    np.testing.assert_array_equal(whole[1, 0], synchronous_demodulation(one, [2, 5], 1.5).amplitude)


def test_orders_nearer_than_the_bandwidth_are_told():
    with pytest.warns(OrderResolutionWarning, match=r"orders 2 and 2.5 leak") as caught:
        synchronous_demodulation(sampled(np.cos), [2.5, 4.0, 2.0], 1.0)
    assert len(caught) == 1
    assert caught[0].filename == __file__


@given(order=st.one_of(st.floats(max_value=0.49), st.floats(min_value=31.1), st.just(np.nan)))
def test_orders_beyond_the_signal(order):
    with pytest.raises(ParameterError, match=r"must be from 0.5, half the bandwidth, to 31"):
        synchronous_demodulation(sampled(np.cos), [order], 1.0)


@given(width=st.one_of(st.floats(max_value=0.0), st.floats(min_value=31.1), st.just(np.nan)))
def test_bandwidth(width):
    with pytest.raises(ParameterError, match="bandwidth_order = "):
        synchronous_demodulation(sampled(np.cos), [3.0], width)


def test_too_short_to_demodulate():
    with pytest.raises(ParameterError, match=r"5 revolutions are too few; the low-pass spans 6.7"):
        synchronous_demodulation(sampled(np.cos, 5), [3.0], 1.0)
