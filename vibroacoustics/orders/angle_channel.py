"""Crank motion from a recorded angle, from zero to a revolution or counting on."""

from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from .crank_motion import CrankMotion, from_angle
from .rpm_channel import Blocks

_LARGEST_STEP: Final = np.pi / 4.0
"""Step of the angle from sample to sample of a shaft that turns; a larger one is its return to
zero, which a converter's filter may spread over some samples."""
_POINTS_PER_REVOLUTION: Final = 8
_LEAST_POINTS: Final = 4
_TURN_ERROR: Final = 0.03
_UNEVEN: Final = 0.08
"""Relative error of a full turn, and of the share of each quarter, of an angle."""


def angle_motion_of(blocks: Blocks, samples: int, sample_rate_hz: float) -> CrankMotion:
    """Crank motion from a channel of the crank angle that comes in blocks.

    Parameters
    ----------
    blocks : read once, each of shape (time,), rad
    samples : number of samples of all blocks
    sample_rate_hz : samples per second

    Raises
    ------
    ParameterError
        The angle does not grow or fall steadily: the shaft stops, or it is no angle.
    """
    times, angles, added, before = [], [], 0, np.nan
    for block in blocks():
        step = np.abs(np.diff(block, prepend=block[:1]))
        is_smooth = (step < _LARGEST_STEP) & (np.append(step[1:], 0.0) < _LARGEST_STEP)
        number = np.flatnonzero(is_smooth)
        if number.size:
            start = block[number[0]] if np.isnan(before) else before
            angle = np.unwrap(np.concatenate([[start], block[number]]))[1:]
            before = float(angle[-1])
            times.append((added + number) / sample_rate_hz)
            angles.append(angle)
        added += block.size
    if sum(each.size for each in times) < max(_LEAST_POINTS, samples // 2):
        raise ParameterError(
            "angle: jumps by more than 45° from sample to sample: it is no angle in rad or °, or "
            "the sample rate is too low"
        )
    time_s, angle_rad = np.concatenate(times), np.concatenate(angles)
    turned = float(angle_rad[-1] - angle_rad[0]) / (2.0 * np.pi)
    points = int(np.clip(_POINTS_PER_REVOLUTION * abs(turned), _LEAST_POINTS, time_s.size))
    chosen = np.linspace(0, time_s.size - 1, points).round().astype(int)
    return from_angle(time_s[chosen], np.sign(turned) * angle_rad[chosen])


def is_sawtooth(samples: Array) -> bool:
    """Whether a channel without a unit looks like an angle: evenly from 0 to 2π, 360 or 1.

    Parameters
    ----------
    samples : shape (time,)
    """
    highest = float(np.quantile(samples, 0.999))
    is_turn = any(abs(highest / turn - 1.0) < _TURN_ERROR for turn in (2.0 * np.pi, 360.0, 1.0))
    if not is_turn:
        return False
    quarters = np.histogram(samples, bins=4, range=(0.0, highest))[0] / samples.size
    return bool(np.all(np.abs(quarters - 0.25) < _UNEVEN))
