"""Integration of the run-down in time from sample to sample, to rest."""

from typing import Final

import numba
import numpy as np

from ..base.arrays import Array
from .equation import Constants, acceleration

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
