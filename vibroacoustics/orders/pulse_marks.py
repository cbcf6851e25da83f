"""Marks of a tape around a shaft: its joint is learnt, since it comes in every revolution.

A tape of equal stripes that does not end on a whole pitch has one interval of another size (Resor,
Trethewey and Maynard 2005, Journal of Sound and Vibration 287). A speed that swings within each
revolution changes all intervals smoothly; a joint stands out of those beside it.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from ..base.arrays import Array

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
    least = np.maximum(_LEAST_SIZE, _CLEAR * scatter / np.sqrt(revolutions))
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
