"""Pickups whose pulses change in height, parts without pulses, and jitter."""

import warnings

import numpy as np
import pytest

from vibroacoustics.measured.recorded_orders import analyse_orders
from vibroacoustics.orders.pulse_edges import pulse_times
from vibroacoustics.orders.pulse_heights import silent_parts
from vibroacoustics.orders.recorded_speed import PulseWarning, recorded_speed
from vibroacoustics.orders.tacho import tacho_motion
from vibroacoustics.recordings import LabelledBlocks, label_recording
from vibroacoustics.study.order_analysis import OrderAnalysis, SpeedChannel

RATE_HZ = 25600.0
STOP = (50.0, 10.0)
LOBE = 0.01
"""Width of the lobes of an inductive pickup, revolutions."""


class Pickup:
    """A shaft with one tooth before an inductive pickup: its voltage goes with the speed.

    Attributes
    ----------
    revolutions : at each sample
    volts : of the pickup, at 50 rev/s from -1 to 1
    zero_s : when the tooth passes
    """

    def __init__(self, first_hz, last_hz, duration_s=6.0, noise=0.01, sign=1.0, shape="both"):
        self.time_s = np.arange(int(duration_s * RATE_HZ)) / RATE_HZ
        self.speed_hz = first_hz + (last_hz - first_hz) * self.time_s / duration_s
        self.revolutions = 0.3 + first_hz * self.time_s
        self.revolutions += 0.5 * (last_hz - first_hz) * self.time_s**2 / duration_s
        off = (self.revolutions % 1.0 - 0.5) / LOBE
        lobes = -off * np.exp(-(off**2)) * np.sqrt(2.0 * np.e)
        if shape == "one":
            lobes = np.exp(-(off**2))
        rng = np.random.default_rng(3)
        self.volts = sign * lobes * self.speed_hz / 50.0 + noise * rng.standard_normal(off.size)
        passes = np.arange(0.5, self.revolutions[-1])
        self.zero_s = np.interp(passes, self.revolutions, self.time_s)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("speeds_hz", [STOP, STOP[::-1], (50.0, 50.0), (50.0, 5.0)])
def test_every_tooth_of_an_inductive_pickup_at_its_zero_crossing(sign, speeds_hz):
    """Noise of 0.01 over a slope of √(2e) / 0.01 a revolution and the height, 6 deviations."""
    pickup = Pickup(*speeds_hz, sign=sign)
    found = pulse_times(pickup.volts, RATE_HZ)
    assert found.size == pickup.zero_s.size
    speed_hz = np.interp(pickup.zero_s, pickup.time_s, pickup.speed_hz)
    slope = np.sqrt(2.0 * np.e) / LOBE * speed_hz / 50.0  # V a revolution
    off = (found - pickup.zero_s) * speed_hz
    linear = LOBE / 100.0  # of interpolation between samples on the curved flank
    assert np.all(np.abs(off) < 6.0 * 0.01 / slope + linear)


def test_threshold_stays_at_a_share_of_the_height_of_one_sided_pulses():
    """So it is crossed at one angle: 0.3 of the height would be 0.26 widths from 0.5 of it."""
    pickup = Pickup(*STOP, noise=0.0, shape="one")
    found = pulse_times(pickup.volts, RATE_HZ)
    assert found.size == pickup.zero_s.size
    speed_hz = np.interp(pickup.zero_s, pickup.time_s, pickup.speed_hz)
    before = (pickup.zero_s - found) * speed_hz / LOBE
    np.testing.assert_allclose(before, np.median(before), atol=0.03)


def test_edge_and_threshold_of_the_user_hold():
    """0.1 V is crossed on the falling flank above zero, or at the foot of the rising one."""
    pickup = Pickup(*STOP, noise=0.0)
    at_zero = pulse_times(pickup.volts, RATE_HZ, threshold=0.0)
    np.testing.assert_allclose(at_zero, pickup.zero_s, atol=0.02 / RATE_HZ)
    falling = pulse_times(pickup.volts, RATE_HZ, "falling", threshold=0.1)
    assert falling.size == pickup.zero_s.size
    np.testing.assert_allclose(np.interp(falling, pickup.time_s, pickup.volts), 0.1, atol=0.01)
    before = (pickup.zero_s - falling) * np.interp(falling, pickup.time_s, pickup.speed_hz)
    assert np.all((before > 0.0) & (before < 0.5 * LOBE))
    rising = pulse_times(pickup.volts, RATE_HZ, "rising", threshold=0.1)
    assert rising.size >= pickup.zero_s.size - 1
    assert np.all(np.interp(rising + 1e-4, pickup.time_s, pickup.volts) > 0.1)


def test_noise_at_standstill_is_no_pulse():
    """Two seconds of noise before a run-up, two behind it; the run-up itself is whole."""
    pickup = Pickup(10.0, 50.0)
    rest = 0.01 * np.random.default_rng(5).standard_normal(int(2.0 * RATE_HZ))
    found = pulse_times(np.concatenate([rest, pickup.volts, rest]), RATE_HZ)
    np.testing.assert_allclose(found, rest.size / RATE_HZ + pickup.zero_s, atol=2e-4)


def stop_with_a_tone(pickup):
    """Orders 1 and 2 of constant amplitude beside the pickup."""
    angle = 2.0 * np.pi * pickup.revolutions
    force = 2.0 * np.cos(angle + 0.5) + 0.5 * np.cos(2.0 * angle)
    return label_recording([force, pickup.volts], RATE_HZ, ["force", "pickup"], ["N", "V"])


def test_a_stop_is_analysed_to_the_last_revolution():
    """3000 to 600 rpm; amplitudes of every block within 2 %, without a warning."""
    pickup = Pickup(*STOP)
    recording = stop_with_a_tone(pickup)
    speed = recorded_speed(LabelledBlocks(recording), SpeedChannel("pickup"))
    assert pickup.time_s[-1] - speed.motion.end_s < 1.0 / 10.0
    assert "falling edge" in speed.source
    results = analyse_orders(recording, OrderAnalysis(SpeedChannel("pickup"), orders=(1.0, 2.0)))
    rms = results["block_order_rms"].sel(channel="force").values
    np.testing.assert_allclose(np.sqrt(2.0) * rms, np.tile([2.0, 0.5], (len(rms), 1)), rtol=0.02)
    # the last block of six revolutions has its middle three before the end
    assert results["block_speed"].values[-1] < 60.0 * np.sqrt(10.0**2 + 2.0 * 8.0 * (40.0 / 6.0))


# --- parts without pulses ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("silent_s", "words"),
    [
        ((4.0, 6.0), r"no pulses from (3\.9|4)\d* to 6 s: before the first and behind the last"),
        ((0.0, 1.0), r"no pulses from 0 to 1\.0\d* s"),
        ((2.0, 2.5), r"no pulses from (1\.9|2)\d* to 2\.5\d* s"),
    ],
)
def test_a_part_without_pulses_is_reported(silent_s, words):
    pickup = Pickup(*STOP)
    silent = (pickup.time_s >= silent_s[0]) & (pickup.time_s <= silent_s[1])
    pickup.volts[silent] = 0.0
    recording = LabelledBlocks(stop_with_a_tone(pickup))
    with pytest.warns(PulseWarning, match=f"tacho pickup: {words}"):
        speed = recorded_speed(recording, SpeedChannel("pickup"))
    assert "; no pulses from" in speed.source


def test_parts_without_pulses():
    pulses = np.array([1.0, 1.1, 1.2, 1.35, 1.5, 3.0, 3.1, 3.2])
    assert silent_parts(pulses, 0.9, 3.3) == [(1.5, 3.0)]
    assert silent_parts(pulses[:5], 0.0, 5.0) == [(0.0, 1.0), (1.5, 5.0)]
    teeth = np.arange(600)
    assert silent_parts(teeth[teeth % 60 < 58] / 1000.0, 0.0, 0.6) == []


# --- jitter --------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("speeds_hz", [STOP, (20.0, 60.0), (48.7, 48.7)])
@pytest.mark.parametrize(("jitter", "is_noted"), [(0.02, False), (0.08, True)])
def test_jitter_above_5_percent_is_noted(seed, speeds_hz, jitter, is_noted):
    pulses = Pickup(*speeds_hz).zero_s
    period = np.gradient(pulses)
    pulses = pulses + jitter * period * np.random.default_rng(seed).standard_normal(pulses.size)
    notes = tacho_motion(pulses).notes
    assert any("the jitter of the pulses is" in note for note in notes) == is_noted


def test_much_jitter_is_warned_of():
    pickup = Pickup(*STOP)
    period = np.gradient(pickup.zero_s)
    marks = pickup.zero_s + 0.08 * period * np.random.default_rng(0).standard_normal(period.size)
    volts = np.zeros(pickup.time_s.size)
    for mark in marks:
        volts[int(mark * RATE_HZ) : int(mark * RATE_HZ) + 20] = 5.0
    pickup.volts = volts
    recording = LabelledBlocks(stop_with_a_tone(pickup))
    with pytest.warns(PulseWarning, match=r"jitter of the pulses is (7|8)\.?\d* % of a period"):
        recorded_speed(recording, SpeedChannel("pickup"))


def test_constant_pulses_are_those_of_one_round():
    """A threshold that the height does not move gives the same bits as a fixed one."""
    pickup = Pickup(30.0, 50.0, noise=0.0)
    volts = np.where(pickup.revolutions % 1.0 < 0.2, 5.0, 0.0)
    fixed = pulse_times(volts, RATE_HZ, "rising", threshold=2.5, hysteresis=2.0)
    np.testing.assert_array_equal(pulse_times(volts, RATE_HZ), fixed)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pickup.volts = volts
        recorded_speed(LabelledBlocks(stop_with_a_tone(pickup)), SpeedChannel("pickup"))
