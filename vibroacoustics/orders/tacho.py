"""Crank motion from tacho pulses or from a recorded speed."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.interpolate import PPoly

from ..base.arrays import Array
from ..base.errors import ParameterError
from .crank_motion import CrankMotion, from_angle, from_curve
from .pulse_faults import PulseFault, number_pulses
from .pulse_pattern import pulse_notes
from .smoothing import smooth_curve

_POINTS_PER_S: Final = 20
"""Of a recorded speed: it holds nothing faster than the 10 Hz that drives are controlled at."""
_LEAST_POINTS: Final = 4
_STANDSTILL: Final = 0.01
"""Share of the highest speed up to which a shaft that starts or stops counts as standing."""


@dataclass(frozen=True)
class TachoResult:
    """Crank motion from a tacho with what was wrong with its pulses."""

    motion: CrankMotion
    faults: tuple[PulseFault, ...]
    """Missing and double pulses in the order of time, without teeth that are always left out."""
    jitter: float
    """Standard deviation of the pulses about the motion, in pulse periods."""
    notes: tuple[str, ...] = ()
    """What the pulses say of the wheel: teeth left out, unequal pitches."""


def tacho_motion(
    pulse_times_s: Array, pulses_per_revolution: int = 1, index_times_s: Array | None = None
) -> TachoResult:
    """Crank motion from the times of tacho pulses, from the first pulse to the last.

    Missing and double pulses are found first; the angle is then a spline through the pulses that is
    as smooth as their jitter asks for (`smooth_curve`). Within one knot distance of its ends the
    speed is less certain than inside. The pulses are taken to be equally spaced on the shaft: a
    pitch error of theirs shows as a fluctuation of the speed that repeats every revolution, from
    which nothing in the pulses can tell it; a large one is noted.

    Parameters
    ----------
    pulse_times_s : shape (pulses,), rising
    pulses_per_revolution : of the tacho
    index_times_s : shape (index pulses,), of a second channel with one pulse a revolution. Angle
        zero is its first pulse within the motion; without it, it is the tacho's first pulse.

    Raises
    ------
    ParameterError
        There are fewer than three pulses, they are no even train, the shaft stops, or the index
        pulses do not come once a revolution.
    """
    if pulses_per_revolution < 1:
        raise ParameterError(
            f"pulses_per_revolution = {pulses_per_revolution}: out of range; allowed from 1"
        )
    pulses = number_pulses(np.asarray(pulse_times_s, dtype=float))
    pitch_rad = 2.0 * np.pi / pulses_per_revolution
    smooth = smooth_curve(pulses.time_s, pitch_rad * pulses.number.astype(float))
    motion = from_curve(smooth.curve)
    if index_times_s is not None:
        motion = _from_index(motion, index_times_s, pitch_rad)
    notes, are_teeth = pulse_notes(pulses, pulses_per_revolution)
    faults = [fault for fault in pulses.faults if not (are_teeth and fault.kind == "missing")]
    return TachoResult(motion, tuple(faults), smooth.scatter / pitch_rad, notes)


def rpm_motion(speed_rpm: Array, sample_rate_hz: float) -> CrankMotion:
    """Crank motion from a recorded speed channel; its angle is zero where it begins.

    The speed is integrated over every sample; the angle is a cubic spline through twenty points a
    second, so that noise of the channel averages out. A standstill before and behind is cut off:
    the motion begins and ends there.

    Parameters
    ----------
    speed_rpm : shape (time,)
    sample_rate_hz : samples per second

    Raises
    ------
    ParameterError
        There are fewer than four samples, one is not finite, or the shaft stops.
    """
    if speed_rpm.ndim != 1 or speed_rpm.size < _LEAST_POINTS or not np.all(np.isfinite(speed_rpm)):
        raise ParameterError(
            f"speed: needs at least {_LEAST_POINTS} finite samples of one channel, got shape "
            f"{speed_rpm.shape}"
        )
    first, last = turning_part(speed_rpm)
    speed_rpm = speed_rpm[first:last]
    step_rad = 2.0 * np.pi / 60.0 / sample_rate_hz * 0.5 * (speed_rpm[1:] + speed_rpm[:-1])
    angle_rad = np.concatenate([[0.0], np.cumsum(step_rad)])
    points = max(_LEAST_POINTS, int(_POINTS_PER_S * speed_rpm.size / sample_rate_hz))
    at = np.linspace(0, speed_rpm.size - 1, min(points, speed_rpm.size)).round().astype(int)
    return from_angle((first + at) / sample_rate_hz, angle_rad[at])


def turning_part(speed_rpm: Array) -> tuple[int, int]:
    """First sample of the shaft's longest run, and the one behind its last.

    All of a channel that never falls to zero; else what lies above a hundredth of the highest
    speed. A second run or one backwards, of more than a hundredth of the first, is left in: it
    is no standstill before or behind, and the motion refuses it.

    Parameters
    ----------
    speed_rpm : shape (time,)
    """
    highest = float(np.max(speed_rpm))
    if float(np.min(speed_rpm)) > 0.0 or not highest > 0.0:
        return 0, speed_rpm.size
    turns = speed_rpm > _STANDSTILL * highest
    edges = np.flatnonzero(np.diff(np.concatenate([[False], turns, [False]]).astype(np.int8)))
    begins, ends = edges[::2], edges[1::2]
    longest = int(np.argmax(ends - begins))
    first, last = int(begins[longest]), int(ends[longest])
    others = int(np.count_nonzero(np.abs(speed_rpm) > _STANDSTILL * highest)) - (last - first)
    if others > _STANDSTILL * (last - first) or last - first < _LEAST_POINTS:
        return 0, speed_rpm.size
    return first, last


def _from_index(motion: CrankMotion, index_times_s: Array, pitch_rad: float) -> CrankMotion:
    """The motion with angle zero at the first index pulse."""
    covered = (index_times_s >= motion.start_s) & (index_times_s <= motion.end_s)
    if not covered.any():
        raise ParameterError(
            f"index: none of {index_times_s.size} pulses lies within the tacho's "
            f"{motion.start_s:.4g} to {motion.end_s:.4g} s"
        )
    angle_rad = motion.angle_rad(index_times_s[covered])
    pulses = float(np.median(np.diff(angle_rad))) / pitch_rad if angle_rad.size > 1 else 0.0
    stated = 2.0 * np.pi / pitch_rad
    if angle_rad.size > 1 and abs(pulses - stated) > 0.5:
        raise ParameterError(
            f"pulses_per_revolution = {stated:.0f}: {pulses:.1f} tacho pulses come between two "
            "index pulses"
        )
    coefficients = motion.curve.c.copy()
    coefficients[-1] -= angle_rad[0]
    return CrankMotion(PPoly(coefficients, motion.curve.x))
