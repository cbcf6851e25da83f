"""Speed near a line drawn by hand, against known run-ups in noise; and what is refused."""

import numpy as np
import pytest
from support import assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.speed_line import motion_near_line

RATE_HZ = 6400.0
TIME_S = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
POINTS_S = np.array([0.0, 5.0, 10.0, 15.0, 19.9])
BESIDE = np.array([1.04, 0.96, 1.04, 0.96, 1.04])
COMB = tuple(float(order) for order in range(1, 11))


def straight(time_s):
    return 20.0 + 2.0 * time_s


def steep(time_s):
    return 15.0 + 55.0 * (time_s / 20.0) ** 2


def sound(speed, ratio_db, orders=range(1, 7)):
    rng = np.random.default_rng(5)
    angle = 2.0 * np.pi * np.cumsum(speed(TIME_S)) / RATE_HZ
    signal = sum(np.cos(order * angle + rng.uniform(0.0, 6.28)) / order for order in orders)
    noise = rng.standard_normal(TIME_S.size)
    return signal / np.std(signal) * 10.0 ** (ratio_db / 20.0) + noise


def assert_is(motion, speed):
    """Within 0.3 % rms off the ends, as the method without a line is."""
    inner_s = np.linspace(motion.start_s + 1.0, motion.end_s - 1.0, 1001)
    error = motion.frequency_hz(inner_s) / speed(inner_s) - 1.0
    assert np.sqrt(np.mean(error**2)) < 0.003


@pytest.mark.parametrize("speed", [straight, steep])
@pytest.mark.parametrize("ratio_db", [0.0, -10.0])
def test_the_speed_beside_a_line(speed, ratio_db):
    """The line is 4 % beside the speed, now on one side and now on the other."""
    signal = sound(speed, ratio_db)
    drawn = motion_near_line(signal, RATE_HZ, POINTS_S, BESIDE * speed(POINTS_S), COMB)
    assert drawn.check.confidence > 0.9
    assert_is(drawn.motion, speed)
    assert drawn.motion.end_s > 19.5


def test_a_line_chooses_among_speeds_that_explain_the_signal():
    """Orders 2, 4 and 6 alone are orders 1, 2 and 3 of a shaft twice as fast."""
    signal = sound(straight, 0.0, (2, 4, 6))
    comb = (2.0, 4.0, 6.0)
    drawn = motion_near_line(signal, RATE_HZ, POINTS_S, BESIDE * straight(POINTS_S), comb)
    assert_is(drawn.motion, straight)


def test_a_part_of_the_recording_is_analysed():
    signal = sound(straight, 0.0)
    drawn = motion_near_line(
        signal, RATE_HZ, np.array([4.0, 15.0]), straight(np.array([4.0, 15.0])), COMB
    )
    assert 4.0 < drawn.motion.start_s < 5.0
    assert 14.0 < drawn.motion.end_s < 15.0
    assert_is(drawn.motion, straight)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (((0.0, 900.0),), "at least two of a time and a speed"),
        (((0.0, 900.0), (0.0, 950.0)), "points = 0 s: times must rise"),
        (((-1.0, 900.0), (0.0, 950.0)), "points = -1 s: must be 0 to "),
        (((0.0, 900.0), (float("nan"), 950.0)), "points = nan s"),
        (((0.0, 900.0), (1.0, -5.0)), "points = -5 rpm: must be 0.1 to 1e"),
    ],
)
def test_points_that_are_no_line_are_refused(points, words):
    with pytest.raises(ParameterError, match=words):
        va.SpeedLine(None, points)


def test_a_line_behind_the_end_is_refused():
    with pytest.raises(ParameterError, match="begins at 30 s, the signal"):
        motion_near_line(sound(straight, 0.0), RATE_HZ, np.array([30.0, 40.0]), POINTS_S[1:3], COMB)


def test_the_option_of_the_command(tmp_path):
    recording = va.label_recording([sound(straight, 0.0)], RATE_HZ, ["ring"], ["m/s²"])
    file = va.export_recording(recording, tmp_path / "run_up.nc")
    given = ("orders", file, "--tacholess-line", "0:1240,10:2310,19.9:3700", "--out", tmp_path)
    outcome = command_here(*given)
    assert outcome.returncode == 0
    assert "within 10 % of a drawn line of 3 points; lines at " in outcome.stdout
    for text, words in (
        ("0:1240", "--tacholess-line = 1: at least two"),
        ("0-1240,3:4", "--tacholess-line '0-1240': must be TIME:RPM"),
        ("0:a,3:4", "--tacholess-line"),
        ("5:1240,3:1500", "--tacholess-line = 3 s: times must rise"),
    ):
        refused = command_here("orders", file, "--tacholess-line", text, "--out", tmp_path)
        assert_refused(refused, words)
    both = command_here(*given, "--rpm", 1000)
    assert_refused(both, "give one of --speed-channel")
