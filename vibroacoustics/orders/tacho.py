"""Crank motion from tacho pulses; the joint of a tape around a shaft is learnt."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly
from scipy.ndimage import median_filter

from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.errors import ParameterError
from ..study.order_analysis import PULSES
from .crank_motion import CrankMotion, from_curve
from .pulse_faults import PulseFault, number_pulses
from .pulse_pattern import pulse_notes
from .speed_comb import smooth_curve

_LEAST_MARKS: Final = 12
_LEAST_REVOLUTIONS: Final = 5
_NEIGHBOURS: Final = 5
"""Intervals over whose median one stands out."""
_LEAST_SIZE: Final = 0.01
_CLEAR: Final = 6.0
"""Deviation of a joint from a pitch: in pitches, and in standard errors."""
_SWING_CYCLES: Final = 3
"""Cycles per revolution of a speed that swings."""
_SIZES: Final = (0.3, 2.3)
"""Sizes of a joint in pitches; more are teeth left out of a wheel."""
_MOST_JOINTS: Final = 3
_FALL: Final = 0.5
"""Deviation of the largest interval that is no joint, over that of the smallest joint."""
_ONE_PULSE: Final = 0.5
"""Deviation of an interval from that of its mark, in pitches, by a pulse missing or too much."""
_ALIKE: Final = 0.1
_FEW: Final = 0.05
"""Different intervals, over the number of pulses, of times that are not between the samples."""
_REPEATED: Final = 0.8
"""Share of the revolutions in which a joint has its size, within a tenth of a pitch."""


def joint_sizes(time_s: Array, marks: int) -> Array | None:
    """Size of the interval behind each mark, in pitches; None where all are equal.

    Parameters
    ----------
    time_s : times of the pulses, none missing or double, shape (pulse,)
    marks : marks of a revolution

    Returns
    -------
    shape (mark,), from the first pulse on; 1 but for joints
    """
    revolutions = (time_s.size - 1) // marks - 1
    if marks < _LEAST_MARKS or revolutions < _LEAST_REVOLUTIONS:
        return None
    half = marks // 2
    # Each interval over the mean of the revolution around it.
    mean = (time_s[marks:] - time_s[:-marks]) / marks
    ratio = np.diff(time_s)[half : half + mean.size] / mean
    folded = ratio[: revolutions * marks].reshape(revolutions, marks)
    middle = np.median(folded, axis=0)
    if np.max(np.abs(folded - middle)) > _ONE_PULSE:
        return None
    scatter = 1.4826 * np.median(np.abs(folded - middle), axis=0)
    size = middle / median_filter(middle, _NEIGHBOURS, mode="wrap")
    sampled = _sampling_interval(time_s) / float(np.median(np.diff(time_s)))
    least = np.maximum(max(_LEAST_SIZE, sampled), _CLEAR * scatter / np.sqrt(revolutions))
    deviation = np.abs(size - 1.0)
    is_clear = (deviation > least) & (np.mean(np.abs(folded - middle) < _ALIKE, axis=0) > _REPEATED)
    # Joints are few, and larger than the errors of all other marks.
    ranked = np.argsort(-deviation)
    falls = deviation[ranked[1 : _MOST_JOINTS + 1]] < _FALL * deviation[ranked[:_MOST_JOINTS]]
    joints = ranked[: int(np.argmax(falls)) + 1]
    if not falls.any() or not is_clear[joints].all():
        return None
    is_usual = np.abs(folded - middle) < _ALIKE
    mean_size = (folded * is_usual).sum(axis=0) / np.maximum(is_usual.sum(axis=0), 1)
    is_joint = np.isin(np.arange(marks), joints)
    sizes = np.where(is_joint, mean_size / _even(mean_size, is_joint), 1.0)
    is_tape = bool(np.all((sizes > _SIZES[0]) & (sizes < _SIZES[1])))
    return np.roll(sizes, half) if is_tape else None


def _sampling_interval(time_s: Array) -> float:
    """Step between the times of pulses that have the samples' times; 0 where they are between."""
    steps = np.diff(np.unique(np.round(np.diff(time_s), 9)))
    return float(steps.min()) if 0 < steps.size < _FEW * time_s.size else 0.0


def _even(values: Array, is_joint: NDArray[np.bool_]) -> Array:
    """Intervals as they are without joints, from the others: a swing of a few cycles, (mark,)."""
    angle = 2.0 * np.pi * np.arange(values.size) / values.size
    cycles = np.outer(angle, np.arange(1, _SWING_CYCLES + 1))
    basis = np.concatenate([np.ones((values.size, 1)), np.cos(cycles), np.sin(cycles)], axis=1)
    fit = np.linalg.lstsq(basis[~is_joint], values[~is_joint], rcond=None)[0]
    return np.asarray(basis @ fit)


def mark_angles(pulses: int, sizes: Array) -> Array:
    """Angle of each pulse, rad, shape (pulse,); the first is at 0.

    Parameters
    ----------
    pulses : number of pulses
    sizes : size of the interval behind each mark, in pitches, shape (mark,)
    """
    angle = np.concatenate([[0.0], np.cumsum(sizes)]) * (2.0 * np.pi / sizes.sum())
    revolution, mark = np.divmod(np.arange(pulses), sizes.size)
    return np.asarray(2.0 * np.pi * revolution + angle[mark])


def joint_note(sizes: Array) -> str:
    """Sentence on the joints that are learnt.

    Parameters
    ----------
    sizes : size of the interval behind each mark, in pitches, shape (mark,)
    """
    listed = ", ".join(f"{size:.2f}" for size in sizes[sizes != 1.0])
    return f"{sizes.size} marks with a joint of {listed} pitches in every revolution: learnt"


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
