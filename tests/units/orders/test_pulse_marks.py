"""Marks of a tacho: joints of a tape, ratios that are no whole number, inverted pulses."""

import warnings

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.orders.angle_channel import is_sawtooth
from vibroacoustics.orders.pulse_edges import pulse_times
from vibroacoustics.orders.tacho import joint_sizes, mark_angles, tacho_motion

RATE_HZ = 25600.0
TIME_S = np.arange(int(10.0 * RATE_HZ)) / RATE_HZ
MARKS = 60


def revolutions(history):
    """Angle in revolutions: a dwell at 25.3 Hz, a run-up, a speed that swings by 5 % in each."""
    even = 25.3 * TIME_S
    if history == "run-up":
        return 15.0 * TIME_S + 1.25 * TIME_S**2
    return even + (0.05 / (4.0 * np.pi)) * np.sin(4.0 * np.pi * even) * (history == "swing")


def taped(angle, joint):
    """Tacho of a tape of 60 stripes whose last interval is so many pitches."""
    pitch = 1.0 / (MARKS - 1 + joint)
    within = angle % 1.0
    stripe = np.minimum(np.floor(within / pitch), MARKS - 1)
    return np.where(within - stripe * pitch < 0.4 * pitch * min(joint, 1.0), 5.0, 0.0)


def analysed(angle, tacho, pulses, orders, **options):
    sound = sum(np.cos(2.0 * np.pi * order * angle) for order in (10.0,))
    recording = va.label_recording([sound, tacho], RATE_HZ, ["front", "tacho"], ["Pa", "V"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        settings = va.OrderAnalysis(
            va.SpeedChannel("tacho", pulses, **options), orders, maximum_order=16.0
        )
        return np.abs(va.analyse_orders(recording, settings)["channel_order"].values[0])


@pytest.mark.parametrize("history", ["dwell", "run-up", "swing"])
@pytest.mark.parametrize("joint", [0.5, 0.75, 0.9, 1.1, 1.3, 1.6, 2.0])
def test_a_joint_costs_nothing(joint, history):
    angle = revolutions(history)
    peak = analysed(angle, taped(angle, joint), MARKS, (8.0, 9.0, 10.0, 11.0, 12.0))
    np.testing.assert_allclose(peak[:, 2], 1.0, atol=0.01)
    assert peak[:, [0, 1, 3, 4]].max() < 0.005


def test_equal_marks_have_no_joint():
    angle = revolutions("run-up")
    assert joint_sizes(pulse_times(taped(angle, 1.0), RATE_HZ), MARKS) is None
    swing = revolutions("swing")
    assert joint_sizes(pulse_times(taped(swing, 1.0), RATE_HZ), MARKS) is None


def test_angles_of_marks_close_after_a_revolution():
    sizes = np.array([1.0, 1.0, 2.0])
    np.testing.assert_allclose(
        mark_angles(7, sizes), np.pi * np.array([0.0, 0.5, 1.0, 2.0, 2.5, 3.0, 4.0])
    )


def test_the_joint_is_named_with_its_size():
    tracked = tacho_motion(pulse_times(taped(revolutions("run-up"), 1.6), RATE_HZ), MARKS)
    assert "60 marks with a joint of 1.60 pitches in every revolution: learnt" in tracked.notes


@pytest.mark.parametrize("ratio", [0.5, 2.5, 1.0 / 3.0, 3.7])
def test_any_ratio_of_pulses(ratio):
    angle = revolutions("run-up")
    tacho = np.where((ratio * angle) % 1.0 < 0.3, 5.0, 0.0)
    peak = analysed(angle, tacho, ratio, (10.0,))
    assert np.median(peak) == pytest.approx(1.0, abs=0.01)


def test_ratio_out_of_range_is_refused():
    with pytest.raises(va.ParameterError, match=r"pulses_per_revolution = 0: must be 0.001 to"):
        va.SpeedChannel("tacho", 0.0)


def test_an_inverted_pulse_has_its_first_edge():
    """A pulse of 0.1 of a revolution at 0 V on a rest of 5 V begins where the other one does."""
    angle = revolutions("dwell") + 0.37
    pulse = np.where(angle % 1.0 < 0.1, 5.0, 0.0)
    upright, inverted = pulse_times(pulse, RATE_HZ), pulse_times(5.0 - pulse, RATE_HZ)
    np.testing.assert_allclose(upright, inverted, atol=1.0 / RATE_HZ)


def test_an_inverted_index_has_the_phase_of_an_upright_one():
    angle = revolutions("dwell") + 0.37
    encoder = np.where((40.0 * angle) % 1.0 < 0.5, 5.0, 0.0)
    index = np.where(angle % 1.0 < 0.1, 5.0, 0.0)
    phases = []
    for pulse in (index, 5.0 - index):
        recording = va.label_recording(
            [np.cos(2.0 * np.pi * angle), encoder, pulse], RATE_HZ, ["a", "e", "i"],
            ["Pa", "V", "V"],
        )  # fmt: skip
        settings = va.OrderAnalysis(va.SpeedChannel("e", 40, "i"), (1.0,))
        phases.append(np.angle(va.analyse_orders(recording, settings)["channel_order"].item()))
    assert phases == pytest.approx([0.0, 0.0], abs=np.radians(1.0))


def test_a_missing_pulse_is_no_learnt_joint():
    """A pulse that fails in one revolution must be named as before."""
    times = pulse_times(taped(revolutions("run-up"), 1.6), RATE_HZ)
    tracked = tacho_motion(np.delete(times, 30 * MARKS + 7), MARKS)
    assert tracked.faults


def test_a_tacho_below_zero_is_no_angle():
    pulses = np.where((25.0 * TIME_S) % 1.0 < 0.1, -0.1, -5.0)
    assert not is_sawtooth(pulses)
    assert is_sawtooth(360.0 * ((25.0 * TIME_S) % 1.0))
