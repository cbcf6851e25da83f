"""Crank motion from the signal itself, near a speed that was drawn on a map by hand."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..study.order_analysis import LINE_TOLERANCE
from .angular_plan import HIGHEST_PASS_BAND_RATIO
from .angular_stream import angular_resample
from .crank_motion import CrankMotion, from_angle, from_speed
from .mains import without_mains
from .speed_check import SpeedCheck
from .tacholess import tacholess_motion

_KNOTS_PER_REVOLUTION: Final = 4
_LARGEST_CHANGE_PER_S: Final = 1.0
"""Largest relative change of the speed against the line, 1/s."""


@dataclass(frozen=True)
class MotionNearLine:
    """Crank motion near a drawn line, with how sure it is.

    Attributes
    ----------
    motion : its angle is zero at its start, not at a mark on the shaft
    check : check of all frames together, in the order spectrum that the speed makes; a rival
        frequency is relative to the line
    """

    motion: CrankMotion
    check: SpeedCheck


def motion_near_line(
    signal: Array,
    sample_rate_hz: float,
    time_s: Array,
    shaft_frequency_hz: Array,
    orders: tuple[float, ...],
    mains_hz: float | None = None,
) -> MotionNearLine:
    """Crank motion of a shaft from the orders in a signal, near a drawn speed.

    The signal is resampled over the angle of the line. There the shaft turns nearly once a unit of
    the angle, and `tacholess_motion` finds its speed within 10 % of the line. A steep run-up is as
    easily followed as a steady speed: the line has taken most of the change.

    Parameters
    ----------
    signal : shape (time,), of one channel, any unit
    sample_rate_hz : samples per second
    time_s : time of the points of the line, rising, shape (point,), s from the first sample
    shaft_frequency_hz : at the points, shape (point,)
    orders : rising, of the comb
    mains_hz : nominal frequency of the mains, whose multiples are omitted; None where there are
        none

    Raises
    ------
    ParameterError
        See `tacholess_motion`; or the line leaves less than 24 revolutions of the signal.
    """
    end_s = (signal.size - 1) / sample_rate_hz
    if not (time_s[0] < end_s and signal.ndim == 1 and np.all(np.isfinite(signal))):
        raise ParameterError(
            f"line: begins at {time_s[0]:g} s, the signal of one channel with finite samples lasts "
            f"from 0 to {end_s:.4g} s: they must overlap"
        )
    line = from_speed(time_s, shaft_frequency_hz)
    samples = signal if mains_hz is None else without_mains(signal, sample_rate_hz, mains_hz)
    limit = HIGHEST_PASS_BAND_RATIO * sample_rate_hz / (2.0 * float(shaft_frequency_hz.max()))
    highest = min(orders[-1] * (1.0 + LINE_TOLERANCE), limit * (1.0 - 1e-9))
    angular = angular_resample(samples, sample_rate_hz, line, highest)
    per_revolution = float(angular.samples_per_revolution)
    tracked = tacholess_motion(
        angular.values,
        per_revolution,
        1.0 - LINE_TOLERANCE,
        1.0 + LINE_TOLERANCE,
        orders,
        _LARGEST_CHANGE_PER_S / float(shaft_frequency_hz.min()),
    )
    ratio = tracked.motion
    knots = int((ratio.end_s - ratio.start_s) * _KNOTS_PER_REVOLUTION)
    turned = np.linspace(ratio.start_s, ratio.end_s, knots, dtype=float)
    numbers = np.arange(angular.time_s.size) / per_revolution
    knot_s = np.interp(turned, numbers, angular.time_s)
    return MotionNearLine(from_angle(knot_s, ratio.angle_rad(turned)), tracked.check)
