"""Equations of motion of ring and scroll between the faces of the slots.

Coordinates are small: u of the ring from the scroll's centre along x, y of the ring, turns ψ of
ring and φ of scroll. Keys 0 and 1 are at y = ±R in the scroll's slots, whose faces push along x;
keys 2 and 3 at x = ±R in the housing's slots, whose faces push along y.
"""

from collections.abc import Callable
from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array

KEYS: Final = 4
COORDINATES: Final = 4
ALL_SLIDES: Final = 22.0
"""Argument beyond which a hyperbolic tangent rounds to one."""
SIDE, APPROACH = 0, 1
"""Rows of a contacts array, shape (2, 4): face that each key touches, -1, 1 or 0 for none; speed
at which the contact began, m/s."""
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
    stiffness: float
    hysteresis: float
    least_approach: float
    film: float
    friction: float
    sticking_speed: float
    moment: Array
    ring_force: Array


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def spline_value(spline: Array, angle: float) -> float:
    """Value of a periodic cubic spline of equal pieces over one turn."""
    pieces = spline.shape[1]
    turn = angle / (2.0 * np.pi)
    position = (turn - np.floor(turn)) * pieces
    piece = min(int(position), pieces - 1)
    step = (position - piece) * (2.0 * np.pi / pieces)
    value = spline[0, piece]
    for power in range(1, 4):
        value = value * step + spline[power, piece]
    return float(value)


class Drive(NamedTuple):
    """What the shaft's angle sets: its sine and cosine, force on the ring, moment on the scroll."""

    sine: float
    cosine: float
    ring_force: float
    moment: float


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def drive_at(time: float, c: Coupling) -> Drive:
    """At a time from crank angle zero, s; the same for all motions at this time."""
    angle = c.angular_speed * time
    force, moment = spline_value(c.ring_force, angle), spline_value(c.moment, angle)
    return Drive(np.sin(angle), np.cos(angle), force, moment)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def key_motion(drive: Drive, state: Array, c: Coupling, keys: Array) -> None:
    """Displacement and velocity of each key across its slot, into rows of `keys`.

    The lever arm of the scroll's slots is counted from the scroll's centre, which orbits.
    """
    sway = c.stroke * drive.sine
    sway_rate = c.angular_speed * c.stroke * drive.cosine
    for key in range(2):
        arm = c.radius if key == 0 else -c.radius
        lever = arm - sway
        keys[SHIFT, key] = state[0] - arm * state[2] + lever * state[3]
        keys[RATE, key] = state[4] - arm * state[6] + lever * state[7] - sway_rate * state[3]
        keys[SHIFT, 2 + key] = state[1] + arm * state[2]
        keys[RATE, 2 + key] = state[5] + arm * state[6]


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def sliding(ratio: float) -> float:
    """Hyperbolic tangent; keys mostly slide so fast that it is one."""
    if abs(ratio) > ALL_SLIDES:
        return 1.0 if ratio > 0.0 else -1.0
    return float(np.tanh(ratio))


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def key_forces(drive: Drive, state: Array, contacts: Array, c: Coupling, keys: Array) -> None:
    """Motion of the ring's keys and forces on them, into all rows of `keys`.

    Parameters
    ----------
    drive : of the time
    state : coordinates and their rates, shape (8,)
    contacts : shape (2, 4)
    c : constants
    keys : shape (4, 4); it is changed
    """
    key_motion(drive, state, c, keys)
    orbital = c.angular_speed * c.stroke
    along_scroll = state[5] - orbital * drive.cosine
    along_housing = state[4] - orbital * drive.sine
    friction_scroll = -c.friction * sliding(along_scroll / c.sticking_speed)
    friction_housing = -c.friction * sliding(along_housing / c.sticking_speed)
    for key in range(KEYS):
        side, rate = contacts[SIDE, key], keys[RATE, key]
        push = 0.0
        if side != 0.0:
            depth = side * keys[SHIFT, key] - c.clearance
            closing_ratio = side * rate / contacts[APPROACH, key]
            push = contact_force(depth, closing_ratio, c.stiffness, c.hysteresis)
        # A key always approaches one of the two faces, so that their films damp both ways.
        keys[NORMAL, key] = -side * push - c.film * rate
        keys[FRICTION, key] = push * (friction_scroll if key < 2 else friction_housing)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def state_rate(
    drive: Drive, state: Array, contacts: Array, c: Coupling, keys: Array, result: Array
) -> None:
    """Newton's and Euler's laws for ring and scroll, into `result`; arguments of `key_forces`."""
    key_forces(drive, state, contacts, c, keys)
    normal, friction = keys[NORMAL], keys[FRICTION]
    along_x = normal[0] + normal[1] + friction[2] + friction[3] + drive.ring_force
    along_y = normal[2] + normal[3] + friction[0] + friction[1]
    on_ring = c.radius * (normal[1] - normal[0] + normal[2] - normal[3])
    sway = c.stroke * drive.sine
    on_scroll = (c.radius - sway) * normal[0] - (c.radius + sway) * normal[1]
    for coordinate in range(COORDINATES):
        result[coordinate] = state[COORDINATES + coordinate]
    # The scroll's centre, from which u counts, accelerates by -ω² r cos θ.
    result[4] = along_x / c.mass + c.angular_speed**2 * c.stroke * drive.cosine
    result[5] = along_y / c.mass
    result[6] = on_ring / c.ring_inertia
    result[7] = (drive.moment + on_scroll) / c.scroll_inertia


def lankarani_nikravesh(restitution: float) -> float:
    """β = 3/4 (1 - e²) (Lankarani & Nikravesh 1990, J. Mech. Des. 112:369); for e near 1."""
    return 0.75 * (1.0 - restitution**2)


def flores(restitution: float) -> float:
    """β = 8 (1 - e)/(5 e) (Flores et al. 2011, Multibody Syst. Dyn. 25:357); for all e."""
    return 1.6 * (1.0 - restitution) / restitution


CONTACT_LAWS: Final[dict[str, Callable[[float], float]]] = {
    "lankarani-nikravesh": lankarani_nikravesh,
    "flores": flores,
}


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def contact_force(depth: float, closing_ratio: float, stiffness: float, hysteresis: float) -> float:
    """Push of a face, N; never a pull.

    Parameters
    ----------
    depth : δ, m
    closing_ratio : δ̇/δ̇₋
    stiffness : K, N/m^1.5
    hysteresis : β
    """
    push = 1.0 + hysteresis * closing_ratio
    if depth <= 0.0 or push <= 0.0:
        return 0.0
    return float(stiffness * depth * np.sqrt(depth) * push)
