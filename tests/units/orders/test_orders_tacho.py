"""Tacho: edges between samples, faults, and the motion that follows, against known run-ups."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.pulse_edges import pulse_times
from vibroacoustics.orders.pulse_faults import number_pulses
from vibroacoustics.orders.pulse_pattern import sampling_note
from vibroacoustics.orders.recorded_speed import StandstillWarning, recorded_speed
from vibroacoustics.orders.rpm_channel import rpm_motion
from vibroacoustics.orders.speed_comb import smooth_curve
from vibroacoustics.orders.tacho import tacho_motion
from vibroacoustics.recordings import LabelledBlocks, label_recording
from vibroacoustics.study.order_analysis import SpeedChannel

SAMPLE_RATE_HZ = 51200.0


class Shaft:
    """Truth: a speed over time, its angle and the times of its pulses."""

    def __init__(self, frequency_hz, duration_s):
        self.frequency_hz, self.duration_s = frequency_hz, duration_s
        self.time_s = np.linspace(0.0, duration_s, int(duration_s * 20000.0) + 1)
        speed = frequency_hz(self.time_s)
        steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(self.time_s)
        self.revolutions = np.concatenate([[0.0], np.cumsum(steps)])

    def angle_rad(self, time_s):
        return 2.0 * np.pi * np.interp(time_s, self.time_s, self.revolutions)

    def pulse_times(self, per_revolution=1):
        pulses = np.arange(int(self.revolutions[-1] * per_revolution))
        return np.interp(pulses / per_revolution, self.revolutions, self.time_s)

    def speed_error(self, motion, margin_s):
        """Relative, between `margin_s` from both ends."""
        at = np.linspace(motion.start_s + margin_s, motion.end_s - margin_s, 5001)
        return motion.frequency_hz(at) / self.frequency_hz(at) - 1.0


def run_up(time_s):
    """1200 to 6000 rpm in 60 s."""
    return 20.0 + 80.0 * time_s / 60.0


def slow_swing(time_s):
    return run_up(time_s) * (1.0 + 0.02 * np.sin(2.0 * np.pi * 0.2 * time_s))


def quick_swing(time_s):
    return run_up(time_s) * (1.0 + 0.01 * np.sin(2.0 * np.pi * 0.5 * time_s))


def spoiled(times_s, rng, share=0.01, jitter=0.02):
    """Pulses with jitter, with a share of them missing and as many doubled: not side by side.

    A double beside a missing pulse is the same as one late pulse: nothing could tell them apart.
    """
    period = np.gradient(times_s)
    jittered = times_s + jitter * period * rng.standard_normal(times_s.size)
    pick = rng.permutation(np.arange(2, times_s.size - 2, 3))
    count = int(share * times_s.size)
    missing, doubled = np.sort(pick[:count]), np.sort(pick[count : 2 * count])
    extra = jittered[doubled] + rng.uniform(0.12, 0.88, count) * period[doubled]
    return np.sort(np.concatenate([np.delete(jittered, missing), extra])), times_s[missing], extra


def rendered(times_s, width_s, rise=2.0, duration_s=None):
    """Tacho signal of 0 and 1 whose edges are straight over `rise` samples, at 51.2 kHz."""
    duration_s = times_s[-1] + 0.1 if duration_s is None else duration_s
    at = np.arange(int(duration_s * SAMPLE_RATE_HZ)) / SAMPLE_RATE_HZ
    last = np.searchsorted(times_s, at + 2.0 * rise / SAMPLE_RATE_HZ) - 1
    signal = np.zeros(at.size)
    for back in (0, 1):
        edge = times_s[np.maximum(last - back, 0)]
        up = np.clip((at - edge) * SAMPLE_RATE_HZ / rise + 0.5, 0.0, 1.0)
        down = np.clip((at - edge - width_s) * SAMPLE_RATE_HZ / rise + 0.5, 0.0, 1.0)
        signal = np.maximum(signal, np.where(last >= back, up - down, 0.0))
    return signal


# --- edges ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-3.0, 2.0), (5.0, 0.1)])
@pytest.mark.parametrize("width_s", [5.0 / SAMPLE_RATE_HZ, 0.008])
def test_edges_lie_between_the_samples(low, high, width_s):
    """Two samples lie on every straight edge, so linear interpolation is exact."""
    exact = 0.01 + Shaft(lambda t: 20.0 + 10.0 * t, 2.0).pulse_times()
    edge = "rising" if high > low else "falling"
    found = pulse_times(low + (high - low) * rendered(exact, width_s), SAMPLE_RATE_HZ, edge)
    np.testing.assert_allclose(found, exact, atol=1e-9)


def test_other_edge_comes_a_pulse_width_later():
    exact = 0.01 + Shaft(lambda t: 20.0 + 10.0 * t, 2.0).pulse_times()
    found = pulse_times(rendered(exact, 0.003), SAMPLE_RATE_HZ, "falling")
    np.testing.assert_allclose(found, exact + 0.003, atol=1e-9)


@pytest.mark.parametrize("width_s", [4.0 / SAMPLE_RATE_HZ, 1e-4, 0.005])
def test_noise_makes_no_pulses(width_s):
    """Duty from 0.2 % on; noise of 10 % of the swing moves an edge by 0.1 of its 2 samples."""
    exact = 0.01 + Shaft(run_up, 20.0).pulse_times()
    signal = rendered(exact, width_s)
    signal += 0.1 * np.random.default_rng(0).standard_normal(signal.size)
    found = pulse_times(signal, SAMPLE_RATE_HZ)
    assert found.size == exact.size
    error = (found - exact) * SAMPLE_RATE_HZ
    assert np.sqrt(np.mean(error**2)) < 0.1 * 2.0


def test_noise_on_a_slow_edge_makes_one_pulse():
    """A sine takes 1000 samples through its hysteresis band; the noise there crosses many times."""
    time_s = np.arange(51200) / SAMPLE_RATE_HZ
    signal = np.sin(2.0 * np.pi * 10.0 * time_s)
    signal += 0.05 * np.random.default_rng(0).standard_normal(time_s.size)
    assert pulse_times(signal, SAMPLE_RATE_HZ).size in (9, 10)  # the first edge is at time zero


def test_inductive_pickup_crosses_zero_amid_its_pulse():
    """A positive lobe, then a negative one, with nothing between the pulses."""
    exact = 0.01 + Shaft(lambda t: 30.0 + 0.0 * t, 2.0).pulse_times()
    at = np.arange(int(2.1 * SAMPLE_RATE_HZ)) / SAMPLE_RATE_HZ
    signal = sum(-(at - t) / 2e-4 * np.exp(-(((at - t) / 2e-4) ** 2)) for t in exact)
    signal += 0.01 * np.random.default_rng(0).standard_normal(at.size)
    found = pulse_times(signal, SAMPLE_RATE_HZ, "falling")
    assert found.size == exact.size
    # noise of 0.01 over a slope of 1 / 0.2 ms, five standard deviations
    np.testing.assert_allclose(found, exact, atol=5.0 * 0.01 * 2e-4)


def test_two_spikes_do_not_set_the_levels():
    exact = 0.01 + Shaft(lambda t: 20.0 + 10.0 * t, 2.0).pulse_times()
    signal = rendered(exact, 0.003)
    signal[[3000, 60000]] = 50.0
    assert pulse_times(signal, SAMPLE_RATE_HZ).size == exact.size + 2


def test_threshold_of_the_user():
    exact = 0.01 + Shaft(lambda t: 20.0 + 10.0 * t, 2.0).pulse_times()
    signal = rendered(exact, 0.003, rise=8.0)
    found = pulse_times(signal, SAMPLE_RATE_HZ, threshold=0.25, hysteresis=0.1)
    np.testing.assert_allclose(found, exact - 0.25 * 8.0 / SAMPLE_RATE_HZ, atol=1e-9)


@pytest.mark.parametrize(
    ("signal", "words"),
    [
        (np.zeros(0), r"needs samples of one channel, got shape \(0,\)"),
        (np.zeros((2, 9)), r"got shape \(2, 9\)"),
        (np.full(9, 2.5), r"no pulses: the signal is constant at 2\.5"),
        (np.array([0.0, np.nan, 1.0]), "1 of 3 samples are not finite"),
        (
            np.array([1.0, 1.0, 0.0, 0.0]),
            "no rising edge in 4 samples; the signal goes from 0 to 1",
        ),
    ],
)
def test_signals_without_pulses_are_refused(signal, words):
    with pytest.raises(ParameterError, match=words):
        pulse_times(signal, SAMPLE_RATE_HZ)


# --- faults --------------------------------------------------------------------------------------


def assert_faults(faults, missing_s, double_s, shaft):
    """Exactly these: doubles at their very times, missing ones within 20 % of a period."""
    found = {
        kind: np.array([fault.time_s for fault in faults if fault.kind == kind])
        for kind in ("missing", "double")
    }
    np.testing.assert_array_equal(found["double"], double_s)
    assert found["missing"].size == missing_s.size
    assert np.all(np.abs(found["missing"] - missing_s) * shaft.frequency_hz(missing_s) < 0.2)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("speed", [run_up, slow_swing, quick_swing])
def test_one_percent_missing_one_percent_double_two_percent_jitter(speed, seed):
    """Speed error below 0.1 % rms from 1 s after the start to 1 s before the end; all faults."""
    shaft = Shaft(speed, 60.0)
    pulses, missing, double = spoiled(shaft.pulse_times(), np.random.default_rng(seed))
    result = tacho_motion(pulses)
    assert_faults(result.faults, missing, double, shaft)
    assert np.sqrt(np.mean(shaft.speed_error(result.motion, 1.0) ** 2)) < 1e-3
    # the standard deviation from 3600 pulses is known to 1.2 %; four of them
    assert result.jitter == pytest.approx(0.02, rel=0.05)


@pytest.mark.parametrize("seed", range(5))
def test_run_up_fourfold_in_five_seconds(seed):
    """125 pulses; jitter of 2 % leaves the speed of a parabola 0.04 % uncertain, rms."""
    shaft = Shaft(lambda t: 10.0 + 6.0 * t, 5.0)
    pulses, missing, double = spoiled(shaft.pulse_times(), np.random.default_rng(seed))
    result = tacho_motion(pulses)
    assert_faults(result.faults, missing, double, shaft)
    assert np.sqrt(np.mean(shaft.speed_error(result.motion, 0.5) ** 2)) < 1e-3


@pytest.mark.parametrize(("missing", "double"), [(3, 0), (8, 0), (0, 3), (0, 5), (4, 4)])
@pytest.mark.parametrize("seed", range(5))
def test_faults_in_a_row(missing, double, seed):
    shaft, rng = Shaft(run_up, 20.0), np.random.default_rng(seed)
    exact = shaft.pulse_times()
    period = np.gradient(exact)
    first = rng.integers(50, exact.size - 50)
    gap = np.arange(first, first + missing)
    at = np.arange(first + missing + 2, first + missing + 2 + double)
    jittered = exact + 0.02 * period * rng.standard_normal(exact.size)
    extra = jittered[at] + rng.uniform(0.12, 0.88, double) * period[at]
    pulses = number_pulses(np.sort(np.concatenate([np.delete(jittered, gap), extra])))
    assert pulses.number[-1] == exact.size - 1
    assert sum(fault.kind == "missing" for fault in pulses.faults) == missing
    np.testing.assert_array_equal(
        [fault.time_s for fault in pulses.faults if fault.kind == "double"], extra
    )


def test_clean_pulses_have_no_faults():
    for speed, duration in ((run_up, 60.0), (lambda t: 10.0 + 6.0 * t, 5.0), (quick_swing, 60.0)):
        pulses = number_pulses(Shaft(speed, duration).pulse_times())
        assert pulses.faults == ()
        np.testing.assert_array_equal(pulses.number, np.arange(pulses.time_s.size))


def test_wheel_with_two_teeth_left_out():
    """60 - 2 teeth: the gap of every revolution is counted, so the angle stays right."""
    teeth = np.arange(3000)
    pulses = number_pulses(teeth[teeth % 60 < 58] / 1000.0)
    np.testing.assert_array_equal(pulses.number, teeth[teeth % 60 < 58])
    assert len(pulses.faults) == 2 * 49  # no tooth follows the last gap


@pytest.mark.parametrize(
    ("times_s", "words"),
    [
        (np.zeros(0), "0 pulses; a speed needs at least 3"),
        (np.array([0.1, 0.2]), "2 pulses; a speed needs at least 3"),
        (np.array([0.0, 2.0, 1.0]), "times of the pulses do not rise"),
        (np.array([0.0, np.nan, 1.0]), "times of the pulses do not rise"),
        (np.array([0.0, np.inf, np.inf]), "times of the pulses do not rise"),
        (np.array([0.0, 5e-324, 1.0]), "times of the pulses do not rise"),
        (np.append(np.arange(50) * 1e-7, 1e3), "missing or double pulses among 51"),
        (np.cumsum(np.random.default_rng(0).exponential(size=500)), "do not follow each other"),
    ],
)
def test_pulses_that_tell_no_speed(times_s, words):
    with pytest.raises(ParameterError, match=words) as caught:
        tacho_motion(times_s)
    assert len(str(caught.value).splitlines()) == 1


# --- motion --------------------------------------------------------------------------------------


def test_clean_run_up_has_its_exact_angle():
    """The angle is a parabola, which the spline holds: what is left is rounding and the truth's."""
    shaft = Shaft(run_up, 60.0)
    result = tacho_motion(shaft.pulse_times())
    at = np.linspace(result.motion.start_s, result.motion.end_s, 20001)
    assert np.abs(result.motion.angle_rad(at) - shaft.angle_rad(at)).max() < 1e-6
    assert np.abs(shaft.speed_error(result.motion, 0.0)).max() < 1e-7
    assert result.jitter < 1e-9


def test_clean_pulses_are_not_smoothed_away():
    """1 % of swing at 3 Hz, seven periods or more of the tacho: cubic interpolation all through.

    Its error is 5/384 h⁴ θ'''' at most (inside), h the period: 5.4e-4 rad at 20 rev/s where
    θ'''' = 2π 0.2 (6π)³; below 1e-4 rad from 31 rev/s.
    """
    shaft = Shaft(lambda t: run_up(t) * (1.0 + 0.01 * np.sin(2.0 * np.pi * 3.0 * t)), 60.0)
    motion = tacho_motion(shaft.pulse_times()).motion
    at = np.linspace(1.0, 59.0, 20001)
    error = np.abs(motion.angle_rad(at) - shaft.angle_rad(at))
    assert error.max() < 5.4e-4
    assert error[at > 10.0].max() < 1e-4


def test_from_samples_to_the_angle():
    """Edges of one sample are told to 0.07 samples rms; 1200 pulses of a parabola average that."""
    exact = 0.01 + Shaft(run_up, 20.0).pulse_times()
    result = tacho_motion(pulse_times(rendered(exact, 1e-3, rise=1.0), SAMPLE_RATE_HZ))
    np.testing.assert_allclose(
        result.motion.angle_rad(exact[1:-1]), 2.0 * np.pi * np.arange(1, exact.size - 1), atol=1e-4
    )
    assert result.faults == ()


def test_encoder_with_an_index_pulse():
    """Angle zero at the first index pulse, a third of a revolution after the encoder's first."""
    shaft = Shaft(lambda t: 20.0 + 8.0 * t, 10.0)
    index = np.interp(np.arange(500) + 1.0 / 3.0, shaft.revolutions, shaft.time_s)
    motion = tacho_motion(shaft.pulse_times(60), 60, index).motion
    np.testing.assert_allclose(motion.angle_rad(index), 2.0 * np.pi * np.arange(500), atol=1e-6)


def test_encoder_follows_a_torsional_oscillation():
    """2 % at the shaft's first order, from 60 pulses a revolution with 0.5 % jitter.

    Four to eight knots a cycle follow it to 1 %; between knots 7 to 14 pulses apart the speed is
    uncertain by 4 · 0.005 / 7^1.5 = 0.11 % of itself at worst: 0.06 of the oscillation.
    """
    at = np.arange(0.0, 2.0, 1e-5)
    revolutions = 30.0 * at + 0.02 / (2.0 * np.pi) * np.sin(2.0 * np.pi * 30.0 * at)
    exact = np.interp(np.arange(3600) / 60.0, revolutions, at)
    jitter = 0.005 * np.gradient(exact) * np.random.default_rng(0).standard_normal(exact.size)
    motion = tacho_motion(exact + jitter, 60).motion
    inside = at[(at > 0.1) & (at < 1.9)]
    exact_hz = 30.0 * (1.0 + 0.02 * np.cos(2.0 * np.pi * 30.0 * inside))
    assert np.std(motion.frequency_hz(inside) / exact_hz - 1.0) < 0.07 * 0.02


def test_index_pulses_that_contradict_the_encoder():
    pulses = Shaft(lambda t: 20.0 + 0.0 * t, 10.0).pulse_times(58)
    with pytest.raises(ParameterError, match=r"pulses_per_revolution = 60: 58\.0 tacho pulses"):
        tacho_motion(pulses, 60, np.arange(0.5, 9.5, 0.05))
    with pytest.raises(ParameterError, match="none of 1 pulses lies within the tacho's 0 to"):
        tacho_motion(pulses, 58, np.array([20.0]))
    with pytest.raises(ParameterError, match=r"pulses_per_revolution = 0: must be 0.001 to"):
        tacho_motion(pulses, 0)


@pytest.mark.parametrize("count", range(3, 20))
def test_few_pulses(count):
    motion = tacho_motion(np.arange(count) / 25.0).motion
    at = np.linspace(motion.start_s, motion.end_s, 50)
    np.testing.assert_allclose(motion.frequency_hz(at), 25.0)


def test_many_pulses_of_an_encoder():
    """1024 pulses a revolution over 4 s."""
    pulses = np.arange(100_000) / 1024.0
    time_s = (np.sqrt(400.0 + 8.0 * pulses) - 20.0) / 4.0
    motion = tacho_motion(time_s, 1024).motion
    at = np.linspace(0.0, motion.end_s, 1001)
    np.testing.assert_allclose(motion.frequency_hz(at), 20.0 + 4.0 * at, rtol=1e-6)


# --- recorded speed ------------------------------------------------------------------------------


def test_recorded_speed():
    """Noise of 20 rpm at 6.4 kHz: 0.05 s average 320 samples, then a spline through sums."""
    time_s = np.arange(64000) / 6400.0
    exact = 1200.0 + 400.0 * time_s
    noise = 20.0 * np.random.default_rng(0).standard_normal(time_s.size)
    motion = rpm_motion(exact + noise, 6400.0)
    assert (motion.start_s, motion.end_s) == (0.0, time_s[-1])
    error_rpm = 60.0 * motion.frequency_hz(time_s) - exact
    assert np.sqrt(np.mean(error_rpm**2)) < 3.0 * 20.0 / np.sqrt(320.0)
    np.testing.assert_allclose(
        motion.angle_rad(time_s),
        2.0 * np.pi / 60.0 * (1200.0 * time_s + 200.0 * time_s**2),
        atol=5.0 * 2.0 * np.pi / 60.0 * 20.0 * np.sqrt(64000.0) / 6400.0,
    )


@pytest.mark.parametrize(
    ("speed", "words"),
    [
        (np.zeros(6400), "speed: falls to 0 rpm"),
        (np.full(6400, -300.0), "speed: falls to -300 rpm"),
        (np.full(3, 300.0), "needs at least 4 finite samples"),
        (np.array([300.0, np.nan, 300.0, 300.0]), "needs at least 4 finite samples"),
    ],
)
def test_recorded_speed_of_a_shaft_that_stands(speed, words):
    with pytest.raises(ParameterError, match=words):
        rpm_motion(speed, 6400.0)


def test_recorded_speed_from_standstill():
    """A second and a half at rest, noise about zero, a run-up, a second and a half at rest."""
    time_s = np.arange(64000) / 6400.0
    run = np.clip(300.0 * (time_s - 1.5), 0.0, None) * (time_s < 8.5)
    noise = 2.0 * np.random.default_rng(0).standard_normal(time_s.size)
    motion = rpm_motion(run + noise, 6400.0)
    assert 1.5 < motion.start_s < 1.6  # at 1 % of 2100 rpm, 0.07 s behind the start
    assert motion.end_s == pytest.approx(8.5, abs=1e-3)
    inner = time_s[(time_s > 2.0) & (time_s < 8.4)]
    exact = 300.0 * (inner - 1.5)
    assert np.sqrt(np.mean((60.0 * motion.frequency_hz(inner) - exact) ** 2)) < 1.0


def test_recorded_speed_with_a_stop_between_two_runs():
    speed = np.tile(np.concatenate([np.full(3000, 600.0), np.zeros(3000)]), 2)
    with pytest.raises(ParameterError, match="speed: falls to"):
        rpm_motion(speed, 6400.0)


def test_a_standstill_is_told():
    speed = np.concatenate([np.zeros(640), np.full(6400, 600.0)])
    recording = label_recording(
        [np.sin(np.arange(7040.0)), speed], 6400.0, ["a", "n"], ["Pa", "rpm"]
    )
    with pytest.warns(
        StandstillWarning, match=r"channel n: standstill cut off: 0\.1 s before, 0 s"
    ):
        found = recorded_speed(LabelledBlocks(recording), SpeedChannel("n"))
    assert found.motion.start_s == pytest.approx(0.1, abs=1e-9)
    assert "standstill cut off: 0.1 s before" in found.source


# --- smoothing -----------------------------------------------------------------------------------


def test_smooth_curve_keeps_a_cubic():
    x = np.sort(np.random.default_rng(0).uniform(0.0, 10.0, 300))
    y = x**3 - 4.0 * x**2 + 7.0
    smooth = smooth_curve(x, y)
    np.testing.assert_allclose(smooth.curve(x), y, atol=1e-9)
    assert smooth.scatter < 1e-9


def test_smooth_curve_tells_the_noise():
    """Of 2000 points: the standard deviation is known to 1.6 %; four of them."""
    x = np.linspace(0.0, 10.0, 2000)
    exact = np.sin(2.0 * x)
    noise = 0.1 * np.random.default_rng(0).standard_normal(x.size)
    smooth = smooth_curve(x, exact + noise)
    assert smooth.scatter == pytest.approx(0.1, rel=0.065)
    # 35 coefficients at most would describe it; the error's variance is their share of the noise's
    assert np.std(smooth.curve(x) - exact) < 0.1 * np.sqrt(35.0 / 2000.0)


# --- any input -----------------------------------------------------------------------------------

ANY = st.floats(allow_nan=True, allow_infinity=True, width=32)
FINITE = st.floats(-1e6, 1e6, width=32)


@settings(deadline=None)
@given(
    arrays(np.float64, st.integers(0, 60), elements=ANY)
    | arrays(np.float64, st.integers(0, 60), elements=FINITE)
)
def test_any_signal_gives_a_rising_motion_or_one_clear_line(signal):
    try:
        motion = tacho_motion(pulse_times(signal, 1000.0)).motion
    except ParameterError:
        pass
    else:
        assert np.all(motion.frequency_hz(np.linspace(motion.start_s, motion.end_s, 99)) > 0.0)


@settings(deadline=None)
@given(arrays(np.float64, st.integers(0, 40), elements=st.floats(0.0, 10.0) | st.just(np.nan)))
def test_any_pulse_times_give_a_rising_motion_or_one_clear_line(times_s):
    try:
        result = tacho_motion(np.sort(times_s))
    except ParameterError:
        pass
    else:
        motion = result.motion
        assert np.all(motion.frequency_hz(np.linspace(motion.start_s, motion.end_s, 99)) > 0.0)
        assert np.isfinite(result.jitter)


@pytest.mark.parametrize("seed", range(5))
def test_random_noise_is_no_tacho(seed):
    noise = np.random.default_rng(seed).standard_normal(51200)
    with pytest.raises(ParameterError, match="tacho: "):
        tacho_motion(pulse_times(noise, SAMPLE_RATE_HZ))


# --- what the pulses say of their wheel ----------------------------------------------------------


def test_teeth_left_out_are_counted_and_noted():
    """60 - 2 teeth in a run-up: no faults, a note, and the angle of 60 teeth."""
    shaft = Shaft(run_up, 20.0)
    pulses = shaft.pulse_times(60)
    result = tacho_motion(pulses[np.arange(pulses.size) % 60 < 58], 60)
    assert result.faults == ()
    (note,) = result.notes
    assert note.startswith("2 of 60 pulses are missing regularly, as on a wheel of 60 - 2 teeth")
    assert np.abs(shaft.speed_error(result.motion, 0.5)).max() < 1e-3


def test_teeth_left_out_that_are_not_stated_are_noted():
    pulses = Shaft(run_up, 20.0).pulse_times(60)
    result = tacho_motion(pulses[np.arange(pulses.size) % 60 < 58], 58)
    assert result.notes[0].endswith("58 pulses a revolution are stated: give 60")


def unequal(marks_degrees, duration_s=20.0):
    """Pulses of marks at these angles in a run-up."""
    shaft = Shaft(run_up, duration_s)
    turns = np.arange(int(shaft.revolutions[-1]))[:, None] + np.array(marks_degrees) / 360.0
    return np.interp(turns.ravel(), shaft.revolutions, shaft.time_s)


def test_two_unequal_marks_are_noted():
    """170° and 190°: 2 · 20/360 of a pitch, 11 %."""
    stated = tacho_motion(unequal([0.0, 170.0]), 2)
    assert (
        "the 2 pulses of a revolution are unequally spaced, by 11 % of a pitch" in stated.notes[0]
    )
    as_one = tacho_motion(unequal([0.0, 170.0]), 1)
    assert "intervals repeat every 2 pulses and differ by 11 %" in as_one.notes[0]


def test_unequal_teeth_of_a_wheel_are_noted():
    marks = 6.0 * np.arange(60)
    marks[20] += 0.3  # 5 % of a pitch: one pitch 5 % longer, the next one shorter
    assert "joint of 1.05, 0.95 pitches" in tacho_motion(unequal(marks, 5.0), 60).notes[0]
    marks[::7] += 0.3
    assert "unequally spaced, by 10 % of a pitch" in tacho_motion(unequal(marks, 5.0), 60).notes[0]


@pytest.mark.parametrize("per_revolution", [1, 2, 60])
@pytest.mark.parametrize("speed", [run_up, slow_swing, quick_swing])
def test_even_pulses_need_no_note(speed, per_revolution):
    pulses = Shaft(speed, 30.0).pulse_times(per_revolution)
    assert tacho_motion(pulses, per_revolution).notes == ()
    rng = np.random.default_rng(1)
    assert tacho_motion(spoiled(pulses, rng)[0], per_revolution).notes == ()


def test_aliasing_encoder_is_noted():
    """1024 pulses a revolution at 6.4 kHz pass half the sample rate at 3.1 rev/s."""
    rate = 6400.0
    time_s = np.arange(int(10.0 * rate)) / rate
    turns = time_s + 0.25 * time_s**2  # 1 to 6 rev/s
    encoder = np.where((1024.0 * turns) % 1.0 < 0.5, 5.0, 0.0)
    note = sampling_note(pulse_times(encoder, rate), rate)
    assert "4 are needed: pulses are missed or alias" in note
    slow = np.where((16.0 * turns) % 1.0 < 0.5, 5.0, 0.0)
    assert sampling_note(pulse_times(slow, rate), rate) is None
    assert sampling_note(np.array([1.0]), rate) is None
