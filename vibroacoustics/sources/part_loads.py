"""Loads of the sources of a scroll on the parts in its shell, over crank angle."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.frame import FIXED_SCROLL, ORBITING_SCROLL, STATOR
from ..mechanics.ports import WRENCH, Port
from .induction_motor.torque_lines import TorqueLine
from .oldham_keys.rattle import KeyForces
from .scroll_gas.cycle import ScrollGasCycle

KEY_FORCES: Final = 5
"""Resultants of `key_resultants`."""


def gas_loads(
    cycle: ScrollGasCycle, height_m: float = 0.0, flanks_close: bool = False
) -> dict[Port, Array]:
    """Gas forces on the two scrolls: a pair along one line, and the torque that the keys pass on.

    The pin takes the orbiting scroll's share of F_t at the orbit radius; what is left turns the
    orbiting scroll about its own axis with F_t r/2. All moments are about the shaft's axis, at the
    centre of mass; together they are F_t r, to which the rotor answers.

    Parameters
    ----------
    cycle : over uniform crank angles
    height_m : mid-height of the wraps
    flanks_close : whether the flanks' contact takes the radial force, as with a drive bushing

    Returns
    -------
    by part, shape (component, samples), N and N m
    """
    (fx, fy, fz), (x, y) = cycle.on_fixed_scroll_n, cycle.line_of_action_m
    if flanks_close:
        across = np.stack([-np.sin(cycle.crank_angle), np.cos(cycle.crank_angle)])
        fx, fy = cycle.tangential_force_n * across
    about_x, about_y = y * fz - height_m * fy, height_m * fx - x * fz
    on_fixed = np.stack([fx, fy, fz, about_x, about_y, x * fy - y * fx])
    on_orbiting = np.stack([*-on_fixed[:5], cycle.self_rotation_moment_n_m])
    return {FIXED_SCROLL: on_fixed, ORBITING_SCROLL: on_orbiting}


def key_resultants(forces: KeyForces, radius_m: float, stroke_m: float) -> Array:
    """Resultants of the keys, shape (KEY_FORCES, samples), N and N m.

    Along x and y on the part with the standing slots and the moment about the shaft's axis, then
    along x and y on the orbiting scroll; what the latter turn is the shaft, see `key_torque_n_m`.
    The standing slots are loaded where the keys are, which move with the ring by r cos θ.

    Parameters
    ----------
    forces : in all four slots
    radius_m : radius of the keys
    stroke_m : r, of the ring
    """
    standing, scroll = forces.on_housing_slots_n, forces.on_scroll_slots_n
    turn = radius_m * (standing[0, 1] - standing[1, 1])
    turn += stroke_m * np.cos(forces.crank_angle) * standing[:, 1].sum(axis=0)
    return np.concatenate([standing.sum(axis=0), turn[None], scroll.sum(axis=0)])


def key_parts(standing: Port, orbiting: Port, height_m: float) -> dict[Port, Array]:
    """Load on the parts per unit of each of `key_resultants`, shape (component, force).

    Parameters
    ----------
    standing : part with the slots that stand
    orbiting : part that the other two keys load
    height_m : height of the ring
    """
    loads: dict[Port, Array] = {
        part: np.zeros((len(WRENCH), KEY_FORCES)) for part in (standing, orbiting)
    }
    for part, first in ((standing, 0), (orbiting, 3)):
        loads[part][0, first] = loads[part][1, first + 1] = 1.0
        loads[part][4, first], loads[part][3, first + 1] = height_m, -height_m
    loads[standing][5, 2] = 1.0
    return loads


def key_torque_n_m(forces: KeyForces, stroke_m: float) -> Array:
    """Torque that the shaft needs against the keys, shape (samples,), N m.

    The scroll hands the keys' forces on to the crank pin, at r from the shaft's axis: the ring's
    inertia to and fro at twice the speed, and the friction of all keys.

    Parameters
    ----------
    forces : in all four slots
    stroke_m : r, the orbit radius
    """
    along_x, along_y = forces.on_scroll_slots_n.sum(axis=0)
    angle = forces.crank_angle
    return np.asarray(stroke_m * (along_x * np.sin(angle) - along_y * np.cos(angle)))


def motor_loads(
    mechanism: Port, roll_moment_n_m: ComplexArray, torque_n_m: ComplexArray
) -> dict[Port, ComplexArray]:
    """Loads of a motor's torque: roll moment on the machine, the torque's reaction on the stator.

    Parameters
    ----------
    mechanism : the body with the motor
    roll_moment_n_m : on it, complex peaks, shape (line,)
    torque_n_m : torque on the rotor, complex peaks, shape (line,)

    Returns
    -------
    by port, shape (component, line), N m
    """
    return {mechanism: about_z(roll_moment_n_m), STATOR: about_z(-torque_n_m)}


def motor_lines(mechanism: Port, lines: Sequence[TorqueLine]) -> dict[Port, ComplexArray]:
    """Loads of lines of a motor's torque, as `motor_loads`."""
    roll = np.array([line.roll_moment_n_m for line in lines], dtype=complex)
    torque = np.array([line.motor_torque_n_m for line in lines], dtype=complex)
    return motor_loads(mechanism, roll, torque)


def about_z(moment: ComplexArray) -> ComplexArray:
    """Wrenches (6, line) that are moments about z alone, N m.

    Parameters
    ----------
    moment : complex peaks, shape (line,), N m
    """
    still = np.zeros_like(moment)
    return np.stack([still, still, still, still, still, moment])
