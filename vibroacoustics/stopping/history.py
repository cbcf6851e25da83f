"""Motion of the shaft at uniform times: steady, coasting, turning back, standing."""

from typing import NamedTuple

import numpy as np

from ..base.arrays import Array
from .equation import Coasting, acceleration
from .reversal import Reversal


class TimeHistory(NamedTuple):
    """Motion of the shaft over time, shape (times,) each: rad, rad/s, rad/s²; share of the gas;
    N."""

    angle: Array
    speed: Array
    acceleration: Array
    gas_share: Array
    brake_force_n: Array


def history_of(
    coasting: Coasting,
    motion: Array,
    reversal: Reversal | None,
    time_s: Array,
    rest_angle: float,
    speed_rad_per_s: float,
) -> TimeHistory:
    """Return the time history of the shaft from steady running to the last rest.

    Parameters
    ----------
    coasting : equation of motion
    motion : angle, speed and acceleration from switch-off to the first rest, shape (3, samples)
    reversal : reversal after it; none where the shaft stays
    time_s : time from switch-off, shape (times,), before it at constant speed
    rest_angle : at the first rest, rad
    speed_rad_per_s : before switch-off
    """
    before = time_s < 0.0
    angle = np.where(before, speed_rad_per_s * time_s, rest_angle)
    speed = np.where(before, speed_rad_per_s, 0.0)
    share = np.where(before, 1.0, coasting.stopping.gas_share_ratio)
    history = TimeHistory(angle, speed, np.zeros_like(time_s), share, np.zeros_like(time_s))
    coasts = np.flatnonzero(~before)[: motion.shape[1]]
    for values, of_motion in zip(history, motion, strict=False):
        values[coasts] = of_motion[: coasts.size]
    if reversal is not None:
        _add_reversal(coasting, reversal, time_s, history)
    return history


def _add_reversal(
    coasting: Coasting, reversal: Reversal, time_s: Array, history: TimeHistory
) -> None:
    """Put the stretches of turning back, and the rest after them, into a time history."""
    gas, final = reversal.gas, coasting.stopping.gas_share_ratio
    for stretch in reversal.stretches:
        during = (time_s > stretch.start_s) & (time_s <= stretch.end_s)
        jamming, radius = stretch.jamming, stretch.jamming.table.wall_radius_m
        angle, speed = stretch.state(time_s[during])
        share = gas.share(jamming.rest_angle - angle)
        force = np.array([jamming.force_n(*each) for each in zip(angle, speed, strict=True)])
        history.angle[during], history.speed[during] = angle, speed
        points = zip(time_s[during], angle, speed, share, radius * force, strict=True)
        history.acceleration[during] = [
            acceleration(time, turned, rate, coasting.constants, gas_share, stretch.turning, push)
            for time, turned, rate, gas_share, push in points
        ]
        history.gas_share[during], history.brake_force_n[during] = final * share, force
    if reversal.stretches:
        last = reversal.stretches[-1]
        after, angle = time_s > last.end_s, float(last.state(np.array(last.end_s))[0])
        history.angle[after] = angle
        history.gas_share[after] = final * gas.share(last.jamming.rest_angle - angle)
        history.brake_force_n[after] = last.jamming.force_n(angle, 0.0)
