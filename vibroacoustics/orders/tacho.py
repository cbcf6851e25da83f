"""Crank motion from tacho pulses."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.interpolate import PPoly

from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.errors import ParameterError
from ..study.order_analysis import PULSES
from .crank_motion import CrankMotion, from_curve
from .pulse_faults import PulseFault, number_pulses
from .pulse_marks import joint_note, joint_sizes, mark_angles
from .pulse_pattern import pulse_notes
from .smoothing import smooth_curve

MOST_JITTER: Final = 0.05
"""Jitter of the pulses in periods, without a note."""


@dataclass(frozen=True)
class TachoResult:
    """Crank motion from a tacho with what was wrong with its pulses."""

    motion: CrankMotion
    faults: tuple[PulseFault, ...]
    """Missing and double pulses in the order of time, without teeth that are always left out."""
    jitter: float
    """Standard deviation of the pulses about the motion, in pulse periods."""
    notes: tuple[str, ...] = ()
    """Notes on the wheel from its pulses: missing teeth, unequal pitches, much jitter."""


def tacho_motion(
    pulse_times_s: Array, pulses_per_revolution: float = 1, index_times_s: Array | None = None
) -> TachoResult:
    """Crank motion from the times of tacho pulses, from the first pulse to the last.

    Missing and double pulses are found first; the angle is then a spline through the pulses that is
    as smooth as their jitter asks for (`smooth_curve`). Within one knot distance of its ends the
    speed is less certain than inside. The pulses are taken to be equally spaced on the shaft,
    but for the joint of a tape, which is learnt: a pitch error of theirs shows as a fluctuation of
    the speed that repeats every revolution, from which nothing in the pulses shows; a large one is
    noted.

    Parameters
    ----------
    pulse_times_s : shape (pulses,), rising
    pulses_per_revolution : pulses per revolution of the tacho, whole or, behind a gear, not
    index_times_s : shape (index pulses,), of a second channel with one pulse a revolution. Angle
        zero is its first pulse within the motion; without it, it is the tacho's first pulse.

    Raises
    ------
    ParameterError
        There are fewer than three pulses, they are no even train, the shaft stops, or the index
        pulses do not come once a revolution.
    """
    check_range("pulses_per_revolution", pulses_per_revolution, *PULSES)
    pitch_rad = 2.0 * np.pi / pulses_per_revolution
    times = np.asarray(pulse_times_s, dtype=float)
    is_whole = float(pulses_per_revolution).is_integer()
    sizes = joint_sizes(times, int(pulses_per_revolution)) if is_whole else None
    if sizes is not None:
        smooth = smooth_curve(times, mark_angles(times.size, sizes))
        motion = from_curve(smooth.curve)
        if index_times_s is not None:
            motion = _from_index(motion, index_times_s, pitch_rad)
        return TachoResult(motion, (), smooth.scatter / pitch_rad, (joint_note(sizes),))
    pulses = number_pulses(times)
    smooth = smooth_curve(pulses.time_s, pitch_rad * pulses.number.astype(float))
    motion = from_curve(smooth.curve)
    if index_times_s is not None:
        motion = _from_index(motion, index_times_s, pitch_rad)
    notes, are_teeth = pulse_notes(pulses, int(pulses_per_revolution)) if is_whole else ((), False)
    faults = [fault for fault in pulses.faults if not (are_teeth and fault.kind == "missing")]
    jitter = smooth.scatter / pitch_rad
    if jitter > MOST_JITTER and not notes:  # teeth or spacing that are noted make jitter too
        notes = (_jitter_note(jitter),)
    return TachoResult(motion, tuple(faults), jitter, notes)


def _jitter_note(jitter: float) -> str:
    return (
        f"the jitter of the pulses is {100.0 * jitter:.2g} % of a period, more than "
        f"{100.0 * MOST_JITTER:g} %: higher orders read too low; check channel, edge and threshold"
    )


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
    if angle_rad.size > 1 and abs(pulses - stated) > 0.5 * min(stated, 1.0):
        raise ParameterError(
            f"pulses_per_revolution = {stated:g}: {pulses:.1f} tacho pulses come between two "
            "index pulses"
        )
    coefficients = motion.curve.c.copy()
    coefficients[-1] -= angle_rad[0]
    return CrankMotion(PPoly(coefficients, motion.curve.x))
