"""Speed from the signal alone, against known run-ups in noise."""

from functools import partial
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from synthetic_machines import RATE_HZ, synthetic_machine
from synthetic_run_ups import synthetic_run_up

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.mains import mains_frequency_hz, mains_of, without_mains
from vibroacoustics.orders.recorded_speed import LEAST_CONFIDENCE
from vibroacoustics.orders.tacholess import tacholess_motion

SAMPLE_RATE_HZ = 6400.0
LIMITS_HZ = (15.0, 70.0)

FALLING = {order: 1.0 / order for order in range(1, 7)}
SECOND_STRONGEST = {1: 0.3, 2: 1.0, 3: 0.2, 4: 0.8, 6: 0.3}
RICH = dict.fromkeys(range(1, 31), 1.0)
TWO = {1: 1.0, 2: 0.3}


def run_up(time_s):
    return 20.0 + 2.0 * time_s


def swing(time_s):
    return run_up(time_s) * (1.0 + 0.02 * np.sin(2.0 * np.pi * 0.2 * time_s))


def run_down(time_s):
    return 60.0 * np.exp(-time_s / 20.0)


def steady(time_s):
    return np.full_like(time_s, 48.7)


def sound(speed, orders, ratio_db, duration_s=20.0, seed=0):
    """Orders of a shaft in white noise; the ratio is that of their powers over the whole band."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(int(duration_s * SAMPLE_RATE_HZ)) / SAMPLE_RATE_HZ
    angle = 2.0 * np.pi * np.cumsum(speed(time_s)) / SAMPLE_RATE_HZ
    signal = sum(
        amplitude * np.cos(order * angle + rng.uniform(0.0, 2.0 * np.pi))
        for order, amplitude in orders.items()
    )
    noise = rng.standard_normal(time_s.size)
    return signal / np.std(signal) * 10.0 ** (ratio_db / 20.0) + noise


def speed_error(motion, speed, margin=0.0):
    """Relative, root mean square over the motion without a share of it at either end."""
    end_s = margin * (motion.end_s - motion.start_s)
    at = np.linspace(motion.start_s + end_s, motion.end_s - end_s, 2001)
    return np.sqrt(np.mean((motion.frequency_hz(at) / speed(at) - 1.0) ** 2))


SPEEDS = (run_up, swing, run_down, steady)
ORDERS = (FALLING, SECOND_STRONGEST, RICH, TWO)
SHORT = ((run_up, FALLING), (swing, SECOND_STRONGEST))


@pytest.mark.parametrize(
    ("speed", "orders", "ratio_db"),
    [
        pytest.param(
            *case, ratio, marks=() if case in SHORT and ratio == -10.0 else pytest.mark.long
        )
        for ratio in (20.0, 0.0, -10.0)
        for case in product(SPEEDS, ORDERS)
    ],
)
def test_speed_in_noise(speed, orders, ratio_db):
    """Below 0.5 % rms, down to -10 dB; a wrong order would be off by a third or more."""
    result = tacholess_motion(sound(speed, orders, ratio_db), SAMPLE_RATE_HZ, *LIMITS_HZ)
    assert speed_error(result.motion, speed) < 5e-3
    assert np.all((result.confidence >= 0.0) & (result.confidence <= 1.0))


def test_run_up_fourfold_in_five_seconds():
    """Frames of one second, in which the speed changes by up to half; spectra are straightened."""
    speed = lambda t: 10.0 + 6.0 * t  # noqa: E731
    signal = sound(speed, FALLING, 0.0, duration_s=5.0)
    result = tacholess_motion(signal, SAMPLE_RATE_HZ, 8.0, 50.0)
    assert speed_error(result.motion, speed) < 5e-3


@pytest.mark.parametrize(
    ("limits_hz", "comb", "times"),
    [
        ((18.0, 65.0), {"orders": (4, 8, 12)}, 1.0),
        pytest.param((70.0, 260.0), {}, 4.0, marks=pytest.mark.long),
    ],
    ids=["comb told", "comb unknown"],
)
@pytest.mark.long
def test_orders_of_a_machine_whose_first_is_silent(limits_hz, comb, times):
    """Orders 4, 8 and 12 alone: four times the speed for one who does not know the machine."""
    signal = sound(run_up, {4: 1.0, 8: 0.7, 12: 0.4}, 0.0)
    result = tacholess_motion(signal, SAMPLE_RATE_HZ, *limits_hz, **comb)
    assert speed_error(result.motion, lambda t: times * run_up(t)) < 5e-3


@pytest.mark.long
def test_a_line_that_does_not_belong_to_the_shaft():
    """Mains hum of four times the amplitude of the strongest order, crossed by three orders."""
    signal = sound(run_up, FALLING, 0.0)  # its first order has 1.16
    time_s = np.arange(signal.size) / SAMPLE_RATE_HZ
    signal += 4.6 * np.cos(2.0 * np.pi * 50.0 * time_s)
    result = tacholess_motion(signal, SAMPLE_RATE_HZ, *LIMITS_HZ)
    assert speed_error(result.motion, run_up) < 5e-3


@pytest.mark.parametrize("seed", [pytest.param(seed, marks=pytest.mark.long) for seed in range(5)])
def test_confidence_tells_noise_from_a_shaft(seed):
    """Noise prefers no speed: its path is worse than the best rival more often than not."""
    noise = np.random.default_rng(seed).standard_normal(128000)
    of_noise = tacholess_motion(noise, SAMPLE_RATE_HZ, *LIMITS_HZ).confidence
    assert of_noise.mean() < 0.5
    for orders in (FALLING, SECOND_STRONGEST, RICH):
        for ratio_db, least in ((0.0, 0.8), (10.0, 0.95)):
            signal = sound(run_up, orders, ratio_db, seed=seed)
            result = tacholess_motion(signal, SAMPLE_RATE_HZ, *LIMITS_HZ)
            assert result.confidence.mean() > least


@pytest.mark.long
def test_confidence_falls_where_the_machine_is_silent():
    signal = sound(run_up, FALLING, 10.0)
    silent = slice(8 * 6400, 12 * 6400)
    signal[silent] = np.random.default_rng(1).standard_normal(4 * 6400)
    result = tacholess_motion(signal, SAMPLE_RATE_HZ, *LIMITS_HZ)
    inside = (result.time_s > 8.5) & (result.time_s < 11.5)
    outside = (result.time_s < 7.5) | (result.time_s > 12.5)
    assert result.confidence[inside].mean() < 0.5
    assert result.confidence[outside].mean() > 0.9


@pytest.mark.long
def test_the_unit_of_the_signal_does_not_matter():
    signal = sound(run_up, FALLING, 0.0)
    of_one = tacholess_motion(signal, SAMPLE_RATE_HZ, *LIMITS_HZ)
    of_many = tacholess_motion(1024.0 * signal, SAMPLE_RATE_HZ, *LIMITS_HZ)
    np.testing.assert_allclose(of_many.confidence, of_one.confidence, atol=1e-9)
    at = of_one.time_s[1:-1]
    np.testing.assert_allclose(of_many.motion.angle_rad(at), of_one.motion.angle_rad(at), rtol=1e-9)


@pytest.mark.long
def test_motion_reaches_from_the_first_frame_to_the_last():
    result = tacholess_motion(sound(run_up, RICH, 0.0), SAMPLE_RATE_HZ, *LIMITS_HZ)
    motion = result.motion
    assert (motion.start_s, motion.end_s) == (result.time_s[0], result.time_s[-1])
    assert motion.angle_rad(motion.start_s) == 0.0
    assert motion.start_s == pytest.approx(0.5 * 8.0 / 15.0, rel=0.02)


@pytest.mark.parametrize(
    ("numbers", "least"),
    [(range(3), 2), pytest.param(range(2000, 2050), 40, marks=pytest.mark.long)],
)
@pytest.mark.long
def test_machines_with_hum_mesh_lines_and_a_weak_first_order(numbers, least):
    """None is wrong without a warning; four in five are right within 0.3 % rms, and sure.

    Off the ends by a twentieth, as with a tacho within a knot: there is less to average.
    """
    sure = 0
    for number in numbers:
        machine = synthetic_machine(number)
        limits = (machine.minimum_hz, machine.maximum_hz)
        result = tacholess_motion(
            machine.signal, RATE_HZ, *limits, machine.comb, mains_hz=machine.mains_hz
        )
        time_s = np.arange(machine.signal.size) / RATE_HZ
        true = partial(np.interp, xp=time_s, fp=machine.speed_hz)
        error = speed_error(result.motion, true, margin=0.05)
        is_sure = result.check.confidence >= LEAST_CONFIDENCE
        assert error < 3e-3 or not is_sure, number
        sure += error < 3e-3 and is_sure
    assert sure >= least


@pytest.mark.parametrize(
    ("numbers", "least"),
    [((2007, 2018), 1), pytest.param(range(2000, 2050), 30, marks=pytest.mark.long)],
)
@pytest.mark.long
def test_machines_of_which_nothing_is_known(numbers, least):
    """Neither comb nor mains are given: none is wrong without a warning, three in five are sure."""
    sure = 0
    for number in numbers:
        machine = synthetic_machine(number)
        result = tacholess_motion(machine.signal, RATE_HZ, machine.minimum_hz, machine.maximum_hz)
        time_s = np.arange(machine.signal.size) / RATE_HZ
        true = partial(np.interp, xp=time_s, fp=machine.speed_hz)
        error = speed_error(result.motion, true, margin=0.05)
        is_sure = result.check.confidence >= LEAST_CONFIDENCE
        assert error < 3e-3 or not is_sure, number
        sure += is_sure
    assert sure >= least


@pytest.mark.parametrize(
    "number",
    [pytest.param(number, marks=() if number == 32 else pytest.mark.long) for number in range(40)],
)
def test_run_ups_with_and_without_the_mains(number):
    """None is wrong without a warning; a speed that is right stays right when the mains are named.

    Without the demand that low orders stand out all along, numbers 8 and 32 become half the speed.
    """
    machine = synthetic_run_up(number)
    limits = (machine.minimum_hz, machine.maximum_hz)
    time_s = np.arange(machine.signal.size) / RATE_HZ
    true = partial(np.interp, xp=time_s, fp=machine.speed_hz)
    are_right = []
    for mains_hz in (None, machine.mains_hz):
        result = tacholess_motion(machine.signal, RATE_HZ, *limits, machine.comb, mains_hz=mains_hz)
        is_right = speed_error(result.motion, true, margin=0.05) < 3e-3
        assert is_right or result.check.confidence < LEAST_CONFIDENCE
        are_right.append(is_right)
    assert are_right != [True, False]


def test_mains_are_left_out():
    """Lines at multiples of 49.97 Hz go; an order 0.47 Hz beside one stays, and so does noise."""
    rng = np.random.default_rng(7)
    time_s = np.arange(int(20.0 * SAMPLE_RATE_HZ)) / SAMPLE_RATE_HZ
    tone = np.cos(2.0 * np.pi * 49.5 * time_s)
    noise = 0.1 * rng.standard_normal(time_s.size)
    hum = sum(np.cos(2.0 * np.pi * n * 49.97 * time_s + n) for n in (1, 2, 5))
    assert mains_frequency_hz(tone + hum, SAMPLE_RATE_HZ, 50.0) == pytest.approx(49.97, rel=1e-4)
    left = without_mains(tone + noise + hum, SAMPLE_RATE_HZ, 50.0)
    middle = slice(int(5.0 * SAMPLE_RATE_HZ), int(15.0 * SAMPLE_RATE_HZ))
    remains = np.sqrt(np.mean((left - tone - noise)[middle] ** 2))
    assert remains < 0.1 * np.sqrt(1.5)


def test_only_a_speed_that_stays_at_the_mains_may_be_hum():
    """Within 0.2 % all the time: a run-up crosses 50 Hz and is a shaft."""
    wander = np.sin(np.linspace(0.0, 6.0, 200))
    assert mains_of(50.0 * (1.0 + 0.0019 * wander)) == 50.0
    assert mains_of(120.0 * (1.0 + 0.0019 * wander)) == 120.0
    assert mains_of(50.0 * (1.0 + 0.0022 * wander)) is None
    assert mains_of(np.linspace(40.0, 60.0, 201)) is None


def test_mains_that_are_no_frequency_are_refused():
    with pytest.raises(ParameterError, match="mains_hz = 0 Hz: must be 10 to 1000 Hz"):
        tacholess_motion(NOISE, 6400.0, 15.0, 70.0, mains_hz=0.0)


@pytest.mark.long
def test_rival_within_five_percent_lowers_the_confidence():
    """Two shafts, 3 % apart, with the same orders: whichever is taken, the other is the rival."""
    slow, quick = 40.0, 41.2
    signal = sound(lambda t: np.full_like(t, slow), FALLING, 10.0)
    signal += sound(lambda t: np.full_like(t, quick), FALLING, 10.0, seed=1)
    check = tacholess_motion(signal, SAMPLE_RATE_HZ, 30.0, 55.0, tuple(FALLING)).check
    assert check.confidence < LEAST_CONFIDENCE
    assert min(abs(check.rival_hz - slow), abs(check.rival_hz - quick)) < 0.1


NOISE = np.random.default_rng(0).standard_normal(12800)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((np.zeros(0), 6400.0, 15.0, 70.0), "0 samples, all the same; no speed is in them"),
        ((np.ones(12800), 6400.0, 15.0, 70.0), "12800 samples, all the same"),
        ((np.ones((2, 9)), 6400.0, 15.0, 70.0), "finite samples of one channel"),
        ((np.array([0.0, np.nan]), 6400.0, 15.0, 70.0), "finite samples of one channel"),
        ((NOISE, 6400.0, 0.0, 70.0), "minimum_frequency_hz = 0 Hz"),
        ((NOISE, 6400.0, 70.0, 15.0), "must rise from above zero"),
        ((NOISE, 6400.0, 15.0, 4000.0), "order 1 is not below half the sample rate of 6400 Hz"),
        ((NOISE, 6400.0, 15.0, 70.0, (0.0, 1.0)), r"orders = \[0\.0, 1\.0\]: must rise"),
        ((NOISE, 6400.0, 15.0, 70.0, ()), r"orders = \[\]: must rise"),
        ((NOISE, 6400.0, 5.0, 70.0), "2 s are too short for a speed from 5 Hz; needs 4.8 s"),
    ],
)
def test_refusals(arguments, words):
    with pytest.raises(ParameterError, match=words) as caught:
        tacholess_motion(*arguments)
    assert len(str(caught.value).splitlines()) == 1


@settings(deadline=None, max_examples=50)
@given(
    arrays(
        np.float64,
        st.integers(0, 400),
        elements=st.floats(width=32) | st.floats(-1e3, 1e3),
    )
)
def test_any_signal_gives_a_rising_motion_or_one_clear_line(signal):
    try:
        motion = tacholess_motion(signal, 1000.0, 100.0, 300.0).motion
    except ParameterError:
        pass
    else:
        assert np.all(motion.frequency_hz(np.linspace(motion.start_s, motion.end_s, 99)) > 0.0)


@pytest.mark.parametrize(
    ("speed_hz", "mains_hz"), [(50.03, 50.0), pytest.param(50.4, None, marks=pytest.mark.long)]
)
def test_a_speed_that_may_be_hum_is_not_sure(speed_hz, mains_hz):
    """A steady comb at the mains frequency could be either; one 0.8 % off is a shaft."""
    signal = sound(lambda t: np.full_like(t, speed_hz), RICH, 10.0)
    check = tacholess_motion(signal, SAMPLE_RATE_HZ, *LIMITS_HZ).check
    assert check.mains_hz == mains_hz
    assert (check.confidence < LEAST_CONFIDENCE) == (mains_hz is not None)
