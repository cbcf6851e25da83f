"""Ratio of an order with and without an option, between the speeds of a study."""

from itertools import pairwise, product
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.errors import ParameterError

LARGEST_GAP: Final = 0.05
"""Distance of neighbouring speeds between which a ratio is interpolated, over the lower speed."""
_BEYOND: Final = 0.005
"""Share beyond the lowest and highest speed to which a ratio is constant."""


def ratio_over_speed(speed_rpm: Array, ratio: ComplexArray, wanted_rpm: Array) -> ComplexArray:
    """Interpolate complex ratios over the speed: amplitude and unwrapped phase, both linear.

    Parameters
    ----------
    speed_rpm : rising, shape (speed,)
    ratio : shape (order, speed)
    wanted_rpm : shape (time,)

    Returns
    -------
    shape (order, time)
    """
    used = used_speeds(speed_rpm, float(np.min(wanted_rpm)), float(np.max(wanted_rpm)))
    phase = np.unwrap(np.angle(ratio[:, used]), axis=-1)
    rows = zip(np.abs(ratio[:, used]), phase, strict=True)
    profile = (wanted_rpm, speed_rpm[used])
    values = [
        np.interp(*profile, size) * np.exp(1j * np.interp(*profile, turn)) for size, turn in rows
    ]
    return np.array(values, dtype=complex).reshape(len(ratio), wanted_rpm.size)


def used_speeds(speed_rpm: Array, lowest_rpm: float, highest_rpm: float) -> IndexArray:
    """Speeds of a study that surround those of a recording, or the one near all of them.

    Parameters
    ----------
    speed_rpm : rising, shape (speed,)
    lowest_rpm, highest_rpm : lowest and highest speed of the recording

    Returns
    -------
    their numbers, rising

    Raises
    ------
    ParameterError
        The study lacks speeds; the message names those to add.
    """
    missing = speeds_to_add(speed_rpm, lowest_rpm, highest_rpm)
    if not missing.size:
        first = max(int(np.searchsorted(speed_rpm, lowest_rpm, "right")) - 1, 0)
        last = int(np.searchsorted(speed_rpm, highest_rpm, "left"))
        return np.arange(first, min(last + 1, speed_rpm.size))
    middle_rpm = np.sqrt(lowest_rpm * highest_rpm)
    nearest = int(np.argmin(np.abs(np.log(speed_rpm / middle_rpm))))
    most_rpm = LARGEST_GAP * speed_rpm[nearest]
    if max(speed_rpm[nearest] - lowest_rpm, highest_rpm - speed_rpm[nearest]) <= most_rpm:
        return np.array([nearest])
    if highest_rpm <= lowest_rpm * (1.0 + LARGEST_GAP):  # one speed is enough
        missing = np.round([middle_rpm])
    raise ParameterError(
        f"speed: the recording has {lowest_rpm:.0f} to {highest_rpm:.0f} rpm, of which the study "
        f"lacks speeds at most {100.0 * LARGEST_GAP:g} % apart; add to its speed_rpm: "
        f"{', '.join(f'{speed:.0f}' for speed in missing)}"
    )


def speeds_to_add(speed_rpm: Array, lowest_rpm: float, highest_rpm: float) -> Array:
    """Speeds, rpm, with which neighbours are at most 5 % apart from the lowest to the highest.

    Parameters
    ----------
    speed_rpm : rising, shape (speed,)
    lowest_rpm, highest_rpm : lowest and highest speed of the recording
    """
    within_range = speed_rpm[(speed_rpm >= lowest_rpm) & (speed_rpm <= highest_rpm)]
    begins = [
        speed_rpm[speed_rpm < lowest_rpm][-1:],
        np.array([np.floor(lowest_rpm) or lowest_rpm]),
    ]
    ends = [speed_rpm[speed_rpm > highest_rpm][:1], np.ceil([highest_rpm])]
    covers_begin = within_range.size and lowest_rpm >= within_range[0] * (1.0 - _BEYOND)
    covers_end = within_range.size and highest_rpm <= within_range[-1] * (1.0 + _BEYOND)
    begins = [within_range[:0]] if covers_begin else [each for each in begins if each.size]
    ends = [within_range[:0]] if covers_end else [each for each in ends if each.size]
    tried = [
        np.concatenate([*sides[:1], within_range, *sides[1:]]) for sides in product(begins, ends)
    ]
    added = [np.setdiff1d(_without_gaps(np.unique(each)), speed_rpm) for each in tried]
    return min(added, key=len)


def _without_gaps(speed_rpm: Array) -> Array:
    """Rising speeds with further ones between them, in whole rpm, so that all gaps are allowed."""
    between = []
    for low, high in pairwise(speed_rpm):
        gap = LARGEST_GAP
        if high > low * (1.0 + gap):  # rounding to whole speeds must not make a gap too large
            gap = max(gap - 1.0 / low, 0.5 * gap)
        gaps = max(1, int(np.ceil(np.log(high / low) / np.log1p(gap) - 1e-9)))
        between.append(np.round(np.geomspace(low, high, gaps + 1)[1:-1]))
    return np.sort(np.concatenate([speed_rpm, *between]))
