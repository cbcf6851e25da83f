"""The orbiting set turns against crank pin and counterweights when the machine stops."""

from typing import NamedTuple

import numpy as np

from ..base.arrays import Array


class Shift(NamedTuple):
    """Angle of the set ahead of the crank pin and its derivatives in time, rad, rad/s, rad/s²."""

    angle: Array
    rate: Array
    acceleration: Array


def brake_shift(time_s: Array, shift_rad: float, duration_s: float) -> Shift:
    """A turn from rest to rest with the least jerk, δ (10u³ - 15u⁴ + 6u⁵) with u = t/duration.

    The thesis gives neither course nor size ("a few degrees"); the course is assumed.

    Parameters
    ----------
    time_s : from switch-off, any shape
    shift_rad : δ reached at the end
    duration_s : of the turn
    """
    u = np.clip(np.asarray(time_s) / duration_s, 0.0, 1.0)
    return Shift(
        shift_rad * u**3 * (10.0 - 15.0 * u + 6.0 * u**2),
        shift_rad / duration_s * 30.0 * u**2 * (1.0 - u) ** 2,
        shift_rad / duration_s**2 * 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
    )
