"""Integration in time: leapfrog for ring and scroll, implicit for the deflection of each face."""

from typing import Final

import numba
import numpy as np

from ...base.arrays import Array
from .contact import Face, dry_force, film_mobility, series_force
from .equations import (
    COORDINATES,
    FRICTION,
    KEYS,
    NORMAL,
    RATE,
    SHIFT,
    Coupling,
    Drive,
    accelerations,
    drive_at,
    key_motion,
    slide_directions,
)

IMPLICIT: Final = 1.0 - np.sqrt(0.5)
"""γ of the two-stage SDIRK method of second order that damps all stiff parts (Alexander 1977, SIAM
J. Numer. Anal. 14, 1006)."""
CLOSE: Final = 1e-4
"""Last change of a deflection, of itself; the error of Newton's method is its square."""
MOST_ITERATIONS: Final = 60
EVALUATIONS: Final = 2
"""Evaluations of the forces in a step: with the acceleration of the step before, with their own."""
POSITION, SPEED, ACCELERATION = 0, 1, 2
"""Rows of a motion, shape (3, 4): coordinates, their rates half a step later, accelerations."""


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def copy(source: Array, target: Array) -> None:
    """Element by element, which numba compiles in a tenth of the time of a slice's assignment."""
    for n in range(source.size):
        target[n] = source[n]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def deflected(
    target: float, guess: float, gap: float, speed: float, step: float, face: Face
) -> float:
    """Deflection d that solves d + step F(d)/c = target, m, by Newton's method in a bracket.

    Parameters
    ----------
    target : deflection without film force, m
    guess : first try, m
    gap, speed : gap of the undeformed faces and their speed of approach, m and m/s
    step : step of the implicit stage, s
    face : constants
    """
    low, high = max(-gap, 0.0), min(target, face.layer - gap)
    if high <= low:
        return low
    d = guess if low < guess < high else 0.5 * (low + high)
    for _ in range(MOST_ITERATIONS):
        excess, slope = d - target, 1.0
        push = dry_force(d, speed, face.stiffness, face.damping)
        if push > 0.0:
            root = np.sqrt(d)
            damping = face.damping * np.sqrt(root)
            mobility, by_thickness = film_mobility(gap + d, face)
            stiffness = 1.5 * face.stiffness * root + 0.25 * damping * speed / d
            series = 1.0 + damping * mobility
            rate = push * mobility / series
            excess += step * rate
            slope += (
                step
                * (
                    (stiffness - rate * 0.25 * damping / d) * mobility
                    + push * by_thickness / series
                )
                / series
            )
        if excess > 0.0:
            high = d
        else:
            low = d
        new = d - excess / slope
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - d) <= CLOSE * new:
            return new
        d = new
    return d


@numba.njit(cache=True, nogil=True, error_model="numpy")
def next_deflection(d: float, before: float, after: float, step: float, face: Face) -> float:
    """Deflection of a face after a step, m: d' = V - F/c; a face at rest waits for an approach.

    Parameters
    ----------
    d : before the step, m
    before, after : gap of the undeformed faces at its ends, m; it changes evenly
    step : s
    face : constants
    """
    speed = (before - after) / step
    if d == 0.0 and (speed <= 0.0 or after >= face.layer):
        return 0.0
    part = IMPLICIT * step
    middle = deflected(d + part * speed, d, before + IMPLICIT * (after - before), speed, part, face)
    explicit = d + (1.0 / IMPLICIT - 1.0) * (middle - d)
    guess = d + (middle - d) / IMPLICIT
    return deflected(explicit + part * speed, guess, after, speed, part, face)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def deflect(shifts: Array, deflections: Array, impacts: Array, step: float, c: Coupling) -> None:
    """Carry the deflections of all faces over a step and mark keys that meet a face.

    Parameters
    ----------
    shifts : shifts of the keys before the step and after it, shape (2, 4), m
    deflections : deflections of the two faces of each key, shape (2, 4), m; they are changed
    impacts : shape (4,); set to 1 where a key passes the position of an undeformed face
    step : s
    c : constants
    """
    for key in range(KEYS):
        for face in range(2):
            side = 1.0 - 2.0 * face
            last, gap = c.clearance - side * shifts[0, key], c.clearance - side * shifts[1, key]
            deflections[face, key] = next_deflection(
                deflections[face, key], last, gap, step, c.face
            )
            if gap < 0.0 <= last:
                impacts[key] = 1.0


@numba.njit(cache=True, nogil=True, error_model="numpy")
def key_forces(drive: Drive, rate: Array, deflections: Array, c: Coupling, keys: Array) -> None:
    """Forces on the ring's keys, across and along the slots, into rows of `keys`.

    Parameters
    ----------
    drive : drive at the time
    rate : rates of the coordinates, shape (4,)
    deflections : deflections of the two faces of each key, shape (2, 4), m
    c : constants
    keys : with the motion of the keys, shape (4, 4); it is changed
    """
    friction_scroll, friction_housing = slide_directions(drive, rate, c)
    for key in range(KEYS):
        net, total = 0.0, 0.0
        for face in range(2):
            side = 1.0 - 2.0 * face
            gap, speed = c.clearance - side * keys[SHIFT, key], side * keys[RATE, key]
            push = series_force(deflections[face, key], gap, speed, c.face)
            net, total = net - side * push, total + push
        keys[NORMAL, key] = net
        keys[FRICTION, key] = total * (friction_scroll if key < 2 else friction_housing)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def integrate(
    motion: Array,
    deflections: Array,
    first: int,
    samples: int,
    sample_interval: float,
    steps: int,
    c: Coupling,
) -> tuple[Array, Array, Array]:
    """Key forces at equal intervals.

    Parameters
    ----------
    motion : at the start, see `POSITION`, shape (3, 4); it is changed to that at the end
    deflections : deflections of the two faces of each key, shape (2, 4), m; they are changed
    first : intervals from crank angle zero to the start
    samples : number of intervals
    sample_interval : s
    steps : steps in each interval
    c : constants

    Returns
    -------
    normal, friction, impacts : at the end of each interval, shapes (samples, 4); impacts are 1
        where in the interval a key passed the position of an undeformed face, otherwise 0
    """
    normal, friction = np.empty((samples, KEYS)), np.empty((samples, KEYS))
    impacts = np.zeros((samples, KEYS))
    keys, shifts, middle = np.empty((4, KEYS)), np.empty((2, KEYS)), np.empty(COORDINATES)
    step = sample_interval / steps
    drive = drive_at(first * sample_interval, c)
    key_motion(drive, motion[POSITION], motion[SPEED], c, keys)
    for sample in range(samples):
        for part in range(steps):
            copy(keys[SHIFT], shifts[0])
            drive = drive_at(((first + sample) * steps + part + 1) * step, c)
            for n in range(COORDINATES):
                motion[POSITION, n] += step * motion[SPEED, n]
            for again in range(EVALUATIONS):
                for n in range(COORDINATES):
                    middle[n] = motion[SPEED, n] + 0.5 * step * motion[ACCELERATION, n]
                key_motion(drive, motion[POSITION], middle, c, keys)
                if again == 0:
                    copy(keys[SHIFT], shifts[1])
                    deflect(shifts, deflections, impacts[sample], step, c)
                key_forces(drive, middle, deflections, c, keys)
                accelerations(drive, keys, c, motion[ACCELERATION])
            for n in range(COORDINATES):
                motion[SPEED, n] += step * motion[ACCELERATION, n]
        copy(keys[NORMAL], normal[sample])
        copy(keys[FRICTION], friction[sample])
    return normal, friction, impacts
