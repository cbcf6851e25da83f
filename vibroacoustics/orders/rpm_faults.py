"""Faults of a recorded speed: spikes, drop-outs and frozen parts, repaired and listed."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array

_STRAY: Final = 0.3
"""Distance of a sample from the median around it, relative, from which it may be a fault."""
_STRAY_DEVIATIONS: Final = 8.0
"""Distance in standard deviations of the noise around it."""
_NEIGHBOURS: Final = 20
"""Intervals before and behind one whose medians it lies between, or else is a fault."""
_LEAST_NEIGHBOURS: Final = 3
_FROZEN: Final = 6
"""Intervals of one value from which a speed that then jumps was frozen."""
_ROUNDING: Final = 1e-9
_JUMP_STEPS: Final = 5.0
_JUMP: Final = 0.002
"""Jump behind a frozen part: over the median step of the speed, and relative."""


class SpeedFault(NamedTuple):
    """Part of a recorded speed that was no speed, and is interpolated.

    Attributes
    ----------
    kind : spike, drop-out or frozen
    start_s, end_s : when
    rpm : its value
    """

    kind: str
    start_s: float
    end_s: float
    rpm: float


def without_strays(samples: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Samples of a short part of a speed, strays replaced by their median; which were strays.

    Parameters
    ----------
    samples : shape (time,), rpm
    """
    middle = float(np.median(samples))
    distance = np.abs(samples - middle)
    deviation = 1.4826 * float(np.median(distance))
    is_stray = distance > max(_STRAY * abs(middle), _STRAY_DEVIATIONS * deviation)
    return np.where(is_stray, middle, samples), np.asarray(is_stray)


def repaired(mean_rpm: Array, is_constant: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
    """Mean speeds of intervals, faults interpolated; which intervals were faults.

    A drop-out or a spike is a run of intervals below or above all that is around it: a speed that
    rises or falls keeps between the medians before and behind. A frozen part has one value, which
    then jumps.

    Parameters
    ----------
    mean_rpm : mean of each interval, shape (interval,)
    is_constant : whether all samples of an interval are alike, shape (interval,)
    """
    is_fault = _strays_of_intervals(mean_rpm) | _frozen(mean_rpm, is_constant)
    good = np.flatnonzero(~is_fault)
    if good.size < _LEAST_NEIGHBOURS:
        return mean_rpm, np.zeros(mean_rpm.size, dtype=bool)
    return np.interp(np.arange(mean_rpm.size), good, mean_rpm[good]), is_fault


def _strays_of_intervals(mean_rpm: Array) -> NDArray[np.bool_]:
    is_stray = np.zeros(mean_rpm.size, dtype=bool)
    for number, value in enumerate(mean_rpm.tolist()):
        before = mean_rpm[max(number - _NEIGHBOURS, 0) : number]
        behind = mean_rpm[number + 1 : number + 1 + _NEIGHBOURS]
        if min(before.size, behind.size) < _LEAST_NEIGHBOURS:
            continue
        medians = float(np.median(before)), float(np.median(behind))
        is_low = value < (1.0 - _STRAY) * min(medians)
        is_stray[number] = is_low or value > (1.0 + _STRAY) * max(medians)
    return is_stray


def _frozen(mean_rpm: Array, is_constant: NDArray[np.bool_]) -> NDArray[np.bool_]:
    steps = np.abs(np.diff(mean_rpm))
    moving = steps[steps > _ROUNDING * np.abs(mean_rpm[1:])]
    step = float(np.median(moving)) if moving.size else 0.0
    is_frozen = np.zeros(mean_rpm.size, dtype=bool)
    alike = np.concatenate([[False], is_constant[1:] & is_constant[:-1] & (steps == 0.0), [False]])
    starts = np.flatnonzero(~alike[:-1] & alike[1:])
    ends = np.flatnonzero(alike[:-1] & ~alike[1:]) + 1
    for first, last in zip(starts.tolist(), ends.tolist(), strict=True):
        if last - first < _FROZEN or last + 1 >= mean_rpm.size:
            continue
        jump = abs(mean_rpm[last + 1] - mean_rpm[first])
        is_jump = jump > max(_JUMP_STEPS * step, _JUMP * abs(mean_rpm[first]))
        # The interval behind has values before and behind the jump.
        is_frozen[first : last + 1] = is_jump
    return is_frozen


def listed_faults(
    mean_rpm: Array, is_fault: NDArray[np.bool_], mended_rpm: Array, edges_s: Array
) -> list[SpeedFault]:
    """Runs of faulty intervals as faults.

    Parameters
    ----------
    mean_rpm, is_fault : mean of each interval, and whether it is a fault, shape (interval,)
    mended_rpm : mean speed without the faults, shape (interval,)
    edges_s : edges of the intervals, shape (interval + 1,)
    """
    borders = np.flatnonzero(np.diff(np.concatenate([[0], is_fault.astype(int), [0]])))
    faults = []
    for first, last in zip(borders[::2].tolist(), borders[1::2].tolist(), strict=True):
        value, expected = float(mean_rpm[first]), float(mended_rpm[first])
        kind = "frozen"
        if value < (1.0 - _STRAY) * expected:
            kind = "drop-out"
        elif value > (1.0 + _STRAY) * expected:
            kind = "spike"
        faults.append(SpeedFault(kind, float(edges_s[first]), float(edges_s[last]), value))
    return faults
