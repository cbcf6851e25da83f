"""Ratio of an order with and without an option, between the speeds of a study."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.errors import ParameterError

CLOSE: Final = 0.05
"""Part of a speed by which another one may differ and have its ratio."""


def ratio_over_speed(speed_rpm: Array, ratio: ComplexArray, wanted_rpm: Array) -> ComplexArray:
    """Interpolate complex ratios over the speed: amplitude and unwrapped phase, both linear.

    Below the lowest and above the highest speed they are constant.

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
    return _interpolated(speed_rpm[used], ratio[:, used], wanted_rpm)


def _interpolated(speed_rpm: Array, ratio: ComplexArray, wanted_rpm: Array) -> ComplexArray:
    phase = np.unwrap(np.angle(ratio), axis=-1)
    profile = (wanted_rpm, speed_rpm)
    values = [
        np.interp(*profile, size) * np.exp(1j * np.interp(*profile, turn))
        for size, turn in zip(np.abs(ratio), phase, strict=True)
    ]
    return np.array(values, dtype=complex).reshape(len(ratio), wanted_rpm.size)


def is_studied(speed_rpm: Array, wanted_rpm: Array) -> NDArray[np.bool_]:
    """Whether speeds are those of a study: from 5 % below its lowest to 5 % above its highest."""
    lowest, highest = speed_rpm[0] * (1.0 - CLOSE), speed_rpm[-1] * (1.0 + CLOSE)
    return np.asarray((wanted_rpm >= lowest) & (wanted_rpm <= highest))


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
        The recording has no speed of the study.
    """
    if highest_rpm < speed_rpm[0] * (1.0 - CLOSE) or lowest_rpm > speed_rpm[-1] * (1.0 + CLOSE):
        raise ParameterError(
            f"speed: the recording has {_span(lowest_rpm, highest_rpm)} rpm, the study "
            f"{_span(speed_rpm[0], speed_rpm[-1])}: they must overlap, or be at most "
            f"{100.0 * CLOSE:g} % apart; add speeds of the recording to the study's speed_rpm"
        )
    nearest = int(np.argmin(np.abs(np.log(speed_rpm**2 / (lowest_rpm * highest_rpm)))))
    distance_rpm = max(speed_rpm[nearest] - lowest_rpm, highest_rpm - speed_rpm[nearest])
    first = max(int(np.searchsorted(speed_rpm, lowest_rpm, "right")) - 1, 0)
    last = int(np.searchsorted(speed_rpm, highest_rpm, "left"))
    used = np.arange(first, min(last + 1, speed_rpm.size))
    is_wide = bool(largest_gap(speed_rpm[used]))
    return np.array([nearest]) if is_wide and distance_rpm <= CLOSE * speed_rpm[nearest] else used


def _span(lowest_rpm: float, highest_rpm: float) -> str:
    ends = dict.fromkeys((f"{lowest_rpm:.0f}", f"{highest_rpm:.0f}"))
    return " to ".join(ends)


def largest_gap(speed_rpm: Array) -> float:
    """Largest distance of neighbouring speeds, over the lower one; 0 where all are within 5 %."""
    gap = float(np.max(np.diff(speed_rpm) / speed_rpm[:-1], initial=0.0))
    return gap if gap > CLOSE else 0.0


def interpolation_error(speed_rpm: Array, ratio: ComplexArray) -> Array:
    """Largest relative error of ratios that are interpolated from the neighbouring speeds.

    Each inner speed is omitted in turn. The gap is then twice as wide: where the ratio is smooth,
    the error between the speeds is a quarter of it.

    Parameters
    ----------
    speed_rpm : rising, shape (speed,)
    ratio : not zero, shape (order, speed)

    Returns
    -------
    shape (order,); not a number with one or two speeds more than 5 % apart, 0 where all are closer
    """
    if not largest_gap(speed_rpm):
        return np.zeros(len(ratio))
    if speed_rpm.size < 3:
        return np.full(len(ratio), np.nan)
    errors = []
    for left_out in range(1, speed_rpm.size - 1):
        sides = [left_out - 1, left_out + 1]
        between = _interpolated(speed_rpm[sides], ratio[:, sides], speed_rpm[[left_out]])
        errors.append(np.abs(between[:, 0] / ratio[:, left_out] - 1.0))
    return np.asarray(np.max(errors, axis=0))
