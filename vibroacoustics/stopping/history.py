"""Motion of the shaft at uniform times, from steady running to rest."""

from typing import Final, NamedTuple

import numba
import numpy as np

from ..base.arrays import Array
from .equation import Coasting, Constants, acceleration
from .reversal import Reversal

ANGLE_STEP: Final = 2.0 * np.pi / 2048
"""Longest step at the first speed, rad: errors of some 1e-11 of the way."""
CORRECTIONS: Final = 3
"""Newton's corrections of the time of rest; each squares its error."""
ANGLE, SPEED, ACCELERATION = 0, 1, 2
"""Rows of a motion."""


@numba.njit(cache=True, nogil=True, error_model="numpy")
def advanced(
    time: float, angle: float, speed: float, step: float, constants: Constants
) -> tuple[float, float]:
    """Angle and speed after a step, by the Runge-Kutta method of fourth order.

    Parameters
    ----------
    time, angle, speed : before the step
    step : s, backwards where negative
    constants : constants of the equation
    """
    half = 0.5 * step
    first = acceleration(time, angle, speed, constants)
    speed_2 = speed + half * first
    second = acceleration(time + half, angle + half * speed, speed_2, constants)
    speed_3 = speed + half * second
    third = acceleration(time + half, angle + half * speed_2, speed_3, constants)
    speed_4 = speed + step * third
    fourth = acceleration(time + step, angle + step * speed_3, speed_4, constants)
    angle += step / 6.0 * (speed + 2.0 * (speed_2 + speed_3) + speed_4)
    return angle, speed + step / 6.0 * (first + 2.0 * (second + third) + fourth)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def coast(
    speed: float, interval: float, motion: Array, constants: Constants
) -> tuple[int, float, float]:
    """Motion of the shaft from switch-off to rest.

    Parameters
    ----------
    speed : at switch-off, rad/s
    interval : between samples, s
    motion : shape (3, samples), see `ANGLE`; the samples before rest are written to it
    constants : constants of the equation

    Returns
    -------
    number of samples before rest, time and angle of rest; time nan where all samples are before it
    """
    steps = int(np.ceil(speed * interval / ANGLE_STEP))
    step, angle = interval / steps, 0.0
    for sample in range(motion.shape[1]):
        for part in range(steps):
            time = (sample * steps + part) * step
            if part == 0:
                motion[ANGLE, sample] = angle
                motion[SPEED, sample] = speed
                motion[ACCELERATION, sample] = acceleration(time, angle, speed, constants)
            angle, speed = advanced(time, angle, speed, step, constants)
            if speed <= 0.0:
                time += step
                for _ in range(CORRECTIONS):
                    further = -speed / acceleration(time, angle, speed, constants)
                    angle, speed = advanced(time, angle, speed, further, constants)
                    time += further
                return sample + 1, time, angle
    return motion.shape[1], np.nan, angle


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
