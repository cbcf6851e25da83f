"""Equations of motion of ring and scroll between the faces of the slots.

Coordinates are small: u of the ring from the scroll's centre along x, y of the ring, turns ψ of
ring and φ of scroll. Keys 0 and 1 are at y = ±R in the scroll's slots, whose faces push along x;
keys 2 and 3 at x = ±R in the housing's slots, whose faces push along y.
"""

from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...base.periodic_spline import spline_value
from .contact import Face

KEYS: Final = 4
COORDINATES: Final = 4
ALL_SLIDES: Final = 22.0
"""Argument beyond which a hyperbolic tangent rounds to one."""
SHIFT, RATE, NORMAL, FRICTION = 0, 1, 2, 3
"""Rows of a keys array, shape (4, 4): displacement of each key across its slot, m, and its
velocity, m/s; force on the key across and along its slot, N."""


class Coupling(NamedTuple):
    """Constants of the equations in SI units; numba takes named tuples, not dataclasses.

    `moment` and `ring_force` are periodic cubic splines over crank angle, shape (4, pieces).
    """

    angular_speed: float
    stroke: float
    mass: float
    ring_inertia: float
    scroll_inertia: float
    radius: float
    clearance: float
    face: Face
    friction: float
    sticking_speed: float
    moment: Array
    ring_force: Array


class Drive(NamedTuple):
    """Values that the shaft's angle sets: sine and cosine, force on the ring, moment on the
    scroll."""

    sine: float
    cosine: float
    ring_force: float
    moment: float


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def drive_at(time: float, c: Coupling) -> Drive:
    """Return the drive at a time from crank angle zero, s; equal for all motions at this time."""
    angle = c.angular_speed * time
    force, moment = spline_value(c.ring_force, angle), spline_value(c.moment, angle)
    return Drive(np.sin(angle), np.cos(angle), force, moment)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def key_motion(drive: Drive, position: Array, rate: Array, c: Coupling, keys: Array) -> None:
    """Displacement and velocity of each key across its slot, into rows of `keys`.

    The lever arm of the scroll's slots is counted from the scroll's centre, which orbits.

    Parameters
    ----------
    drive : drive at the time
    position, rate : coordinates and their rates, shape (4,)
    c : constants
    keys : shape (4, 4); it is changed
    """
    sway = c.stroke * drive.sine
    sway_rate = c.angular_speed * c.stroke * drive.cosine
    for key in range(2):
        arm = c.radius if key == 0 else -c.radius
        lever = arm - sway
        keys[SHIFT, key] = position[0] - arm * position[2] + lever * position[3]
        keys[RATE, key] = rate[0] - arm * rate[2] + lever * rate[3] - sway_rate * position[3]
        keys[SHIFT, 2 + key] = position[1] + arm * position[2]
        keys[RATE, 2 + key] = rate[1] + arm * rate[2]


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def sliding(ratio: float) -> float:
    """Hyperbolic tangent; keys mostly slide so fast that it is one."""
    if abs(ratio) > ALL_SLIDES:
        return 1.0 if ratio > 0.0 else -1.0
    return float(np.tanh(ratio))


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def slide_directions(drive: Drive, rate: Array, c: Coupling) -> tuple[float, float]:
    """Friction over force of contact, of the scroll's keys along y and the housing's along x."""
    orbital = c.angular_speed * c.stroke
    along_scroll = rate[1] - orbital * drive.cosine
    along_housing = rate[0] - orbital * drive.sine
    return (
        -c.friction * sliding(along_scroll / c.sticking_speed),
        -c.friction * sliding(along_housing / c.sticking_speed),
    )


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def accelerations(drive: Drive, keys: Array, c: Coupling, result: Array) -> None:
    """Newton's and Euler's laws for ring and scroll, into `result`.

    Parameters
    ----------
    drive : drive at the time
    keys : with the forces, shape (4, 4)
    c : constants
    result : shape (4,); it is changed
    """
    normal, friction = keys[NORMAL], keys[FRICTION]
    along_x = normal[0] + normal[1] + friction[2] + friction[3] + drive.ring_force
    along_y = normal[2] + normal[3] + friction[0] + friction[1]
    on_ring = c.radius * (normal[1] - normal[0] + normal[2] - normal[3])
    sway = c.stroke * drive.sine
    on_scroll = (c.radius - sway) * normal[0] - (c.radius + sway) * normal[1]
    # The scroll's centre, from which u counts, accelerates by -ω² r cos θ.
    result[0] = along_x / c.mass + c.angular_speed**2 * c.stroke * drive.cosine
    result[1] = along_y / c.mass
    result[2] = on_ring / c.ring_inertia
    result[3] = (drive.moment + on_scroll) / c.scroll_inertia
