"""Integration in time that ends a step wherever a key meets or leaves a face."""

from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from .equations import (
    APPROACH,
    COORDINATES,
    FRICTION,
    KEYS,
    NORMAL,
    RATE,
    SHIFT,
    SIDE,
    Coupling,
    Drive,
    drive_at,
    key_forces,
    key_motion,
    state_rate,
)

BISECTIONS: Final = 48
"""Halvings of a step: to 4e-15 of it, its rounding."""


class Work(NamedTuple):
    """Arrays that the functions here overwrite: of keys, shape (4, 4), of states, shape (8,)."""

    keys: Array
    before: Array
    after: Array
    trial: Array
    rate: Array
    end: Array


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def copy(source: Array, target: Array) -> None:
    """Element by element, which numba compiles in a tenth of the time of a slice's assignment."""
    for n in range(source.size):
        target[n] = source[n]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def runge_kutta_step(
    time: float,
    step: float,
    start: Drive,
    end: Drive,
    state: Array,
    contacts: Array,
    c: Coupling,
    work: Work,
) -> None:
    """Classical Runge-Kutta step of fourth order, into `work.end`; contacts stay as they are.

    Parameters
    ----------
    time, step : start and length of the step, s
    start, end : at the ends of the step
    state : coordinates and their rates, shape (8,)
    contacts, c : see `key_forces`
    work : it is changed
    """
    copy(state, work.end)
    copy(state, work.trial)
    drive = start
    for stage in range(4):
        if stage == 1:
            drive = drive_at(time + 0.5 * step, c)
        elif stage == 3:
            drive = end
        weight = step / (3.0 if stage in (1, 2) else 6.0)
        state_rate(drive, work.trial, contacts, c, work.keys, work.rate)
        reach = step if stage == 2 else 0.5 * step
        for n in range(state.size):
            work.end[n] += weight * work.rate[n]
            work.trial[n] = state[n] + reach * work.rate[n]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def crossing(level: float, start: float, end: float, start_slope: float, end_slope: float) -> float:
    """Share of a step at which a displacement passes a level, on its cubic Hermite polynomial.

    Slopes are per step. 0 if it starts beyond the level, as rounding may leave it after an event.
    """
    outwards = 1.0 if end > level else -1.0
    if outwards * (start - level) >= 0.0:
        return 0.0
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        s = 0.5 * (low + high)
        value = (1.0 - s) ** 2 * ((1.0 + 2.0 * s) * start + s * start_slope)
        value += s**2 * ((3.0 - 2.0 * s) * end + (s - 1.0) * end_slope)
        if outwards * (value - level) >= 0.0:
            high = s
        else:
            low = s
    return high


@numba.njit(cache=True, nogil=True, error_model="numpy")
def first_event(
    step: float, before: Array, after: Array, contacts: Array, clearance: float
) -> tuple[int, float, float]:
    """Key that first meets or leaves a face in a step, -1 if none; share of the step; the face.

    Parameters
    ----------
    step : length of the step, s
    before, after : motion of the keys at its ends, shape (4, 4)
    contacts : before the step, shape (2, 4)
    clearance : m
    """
    first_key, earliest, face = -1, 2.0, 0.0
    for key in range(KEYS):
        side = contacts[SIDE, key]
        towards = side if side != 0.0 else np.sign(after[SHIFT, key])
        touches = towards * after[SHIFT, key] > clearance
        if touches == (side != 0.0):
            continue
        share = crossing(
            clearance,
            towards * before[SHIFT, key],
            towards * after[SHIFT, key],
            towards * before[RATE, key] * step,
            towards * after[RATE, key] * step,
        )
        if share < earliest:
            first_key, earliest, face = key, share, towards
    return first_key, earliest, face


@numba.njit(cache=True, nogil=True, error_model="numpy")
def advance(
    time: float,
    duration: float,
    state: Array,
    contacts: Array,
    c: Coupling,
    impact_speed: Array,
    work: Work,
) -> None:
    """Carry state and contacts over one step, in parts where a contact begins or ends.

    Parameters
    ----------
    time : of the step's start from crank angle zero, s
    duration : of the step, s
    state, contacts : see `key_forces`; they are changed
    c : constants
    impact_speed : shape (4,), m/s; set to the speed of approach of keys that meet a face
    work : it is changed
    """
    done, last = 0.0, drive_at(time + duration, c)
    while done < duration:
        step = duration - done
        start = drive_at(time + done, c)
        end = last if done == 0.0 else drive_at(time + done + step, c)
        key_motion(start, state, c, work.before)
        runge_kutta_step(time + done, step, start, end, state, contacts, c, work)
        key_motion(last, work.end, c, work.after)
        key, share, face = first_event(step, work.before, work.after, contacts, c.clearance)
        if key >= 0:
            step *= share
            end = drive_at(time + done + step, c)
            runge_kutta_step(time + done, step, start, end, state, contacts, c, work)
            key_motion(end, work.end, c, work.after)
            if contacts[SIDE, key] == 0.0:
                impact_speed[key] = face * work.after[RATE, key]
                contacts[APPROACH, key] = max(impact_speed[key], c.least_approach)
            contacts[SIDE, key] = face - contacts[SIDE, key]
        copy(work.end, state)
        done += step


@numba.njit(cache=True, nogil=True, error_model="numpy")
def integrate(
    state: Array,
    contacts: Array,
    first: int,
    samples: int,
    sample_interval: float,
    steps: int,
    c: Coupling,
) -> tuple[Array, Array, Array, Array]:
    """Motion and key forces at equal intervals.

    Parameters
    ----------
    state, contacts : see `key_forces`, at the start; they are changed to those at the end
    first : intervals from crank angle zero to the start
    samples : number of intervals
    sample_interval : s
    steps : steps in each interval
    c : constants

    Returns
    -------
    motion, normal, friction, impact_speed : at the end of each interval, shapes (samples, 8) and
        three times (samples, 4); impact speeds are of the interval, 0 where no key met a face
    """
    motion = np.empty((samples, 2 * COORDINATES))
    normal, friction = np.empty((samples, KEYS)), np.empty((samples, KEYS))
    impact_speed = np.zeros((samples, KEYS))
    keys, spare = np.empty((3, 4, KEYS)), np.empty((3, 2 * COORDINATES))
    work = Work(keys[0], keys[1], keys[2], spare[0], spare[1], spare[2])
    step = sample_interval / steps
    for sample in range(samples):
        for part in range(steps):
            time = ((first + sample) * steps + part) * step
            advance(time, step, state, contacts, c, impact_speed[sample], work)
        end = drive_at((first + sample + 1) * sample_interval, c)
        key_forces(end, state, contacts, c, work.keys)
        copy(state, motion[sample])
        copy(work.keys[NORMAL], normal[sample])
        copy(work.keys[FRICTION], friction[sample])
    return motion, normal, friction, impact_speed
