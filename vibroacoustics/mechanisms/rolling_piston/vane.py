"""The vane: what presses it on the roller, its slot, and its flight where the tip leaves."""

from typing import Final, NamedTuple

import numba
import numpy as np

from ...base.arrays import Array
from ...base.errors import SolverError
from .parameters import RollingPistonTables

SLIP_M_PER_S: Final = 0.02
"""Sliding speed over which friction turns its direction, as tanh of the ratio: assumed, 1 % of
the speed of a tip, so that the force is smooth."""
FLYING_TURNS: Final = 2


class Impacts(NamedTuple):
    """Landings of the vane's tip on the roller in a turn.

    Attributes
    ----------
    angle_rad : angle of the contact from the vane, shape (landing,)
    impulse_n_s : on the roller, shape (landing,)
    """

    angle_rad: Array
    impulse_n_s: Array


def pressing_force_n(machine: RollingPistonTables, compression_pa: Array, x: Array) -> Array:
    """Force of gas and spring that presses the vane inwards, without friction and inertia, N.

    The shell's pressure on the back, the mean of both chambers' on the tip: B H (p_d - (p_c +
    p_s)/2) + F_0 - k x.

    Parameters
    ----------
    machine : with gas and vane
    compression_pa : p_c, shape (samples,)
    x : extension of the vane, shape (samples,), m
    """
    gas, cylinder, vane = machine.gas, machine.cylinder, machine.vane
    area = cylinder.vane_thickness_m * cylinder.height_m
    tip = 0.5 * (compression_pa + gas.suction_pressure_pa)
    spring = vane.spring_force_n - vane.spring_stiffness_n_per_m * x
    return np.asarray(area * (gas.discharge_pressure_pa - tip) + spring)


def jump_speed_rad_per_s(machine: RollingPistonTables, pressing_n: Array, bend: Array) -> float:
    """Shaft speed above which the tip leaves the roller, at constant speed without friction.

    Where x'' > 0 the vane must follow the roller inwards: Ω² = F/(m x''), the least over the turn.

    Parameters
    ----------
    machine : with its vane
    pressing_n : F, shape (samples,)
    bend : x'', shape (samples,), m/rad²
    """
    follows = bend > 0.0
    square = pressing_n[follows] / (machine.vane.mass_kg * bend[follows])
    return float(np.sqrt(max(np.min(square), 0.0)))


def slot_reactions_n(
    machine: RollingPistonTables, x: Array, gas_n: Array, tip_n: Array
) -> tuple[Array, Array]:
    """Forces across the vane at the slot's mouth and at the vane's rear end, on the vane.

    Parameters
    ----------
    machine : with its vane
    x : extension, shape (samples,), m
    gas_n, tip_n : forces of the gas, at half the extension, and of the roller, at the tip, across
        the vane, shape (samples,)
    """
    length = machine.vane.length_m
    mouth = -(gas_n * (length - 0.5 * x) + tip_n * length) / (length - x)
    return mouth, -(gas_n + tip_n) - mouth


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _fly(
    force: Array, x: Array, velocity: Array, bend: Array, step: float, mass: float, first: int
) -> tuple[Array, Array, int]:
    """Accelerations of flight and landing, NaN in contact; impulses; flights begun and not ended.

    Each step moves the vane by Newton's law with the force at its beginning.
    """
    count = x.size
    acceleration, impulse = np.full(count, np.nan), np.zeros(count)
    flying, speed, position = 0, 0.0, 0.0
    for n in range(FLYING_TURNS * count):
        i = (first + n) % count
        after = (i + 1) % count
        if flying == 0:
            acceleration[i], impulse[i] = np.nan, 0.0
            if force[i] >= mass * bend[i]:
                continue
            flying, speed, position = 1, velocity[i], x[i]
        faster = speed + step * force[i] / mass
        reached = position + 0.5 * step * (speed + faster)
        if reached < x[after]:
            acceleration[i], impulse[i] = force[i] / mass, 0.0
            speed, position = faster, reached
            continue
        acceleration[i] = (velocity[after] - speed) / step
        impulse[i] = mass * (faster - velocity[after])
        flying = 0
    return acceleration, impulse, flying


def vane_flight(
    machine: RollingPistonTables, pressing_n: Array, extension: Array, speed_rad_per_s: float
) -> tuple[Array, Impacts]:
    """Accelerations of the vane off the roller at constant speed, and its landings.

    The tip leaves where gas and spring cannot accelerate the vane as the roller recedes. It lands
    without rebound: the landing is one sample with the whole impulse.

    Parameters
    ----------
    machine : with its vane
    pressing_n : force of gas and spring inwards, shape (samples,)
    extension : result of `vane_extension`, shape (3, samples)
    speed_rad_per_s : Ω

    Returns
    -------
    acceleration inwards, m/s², NaN in contact, shape (samples,); landings

    Raises
    ------
    SolverError
        The vane does not come back within a turn.
    """
    x, slope, bend = extension
    count, mass = x.size, machine.vane.mass_kg
    step = 2.0 * np.pi / count / speed_rad_per_s
    kinematic = bend * speed_rad_per_s**2
    first = int(np.argmax(pressing_n - mass * kinematic))
    acceleration, impulse, flying = _fly(
        pressing_n, x, slope * speed_rad_per_s, kinematic, step, mass, first
    )
    if flying or pressing_n[first] < mass * kinematic[first]:
        raise SolverError(
            f"vane at {speed_rad_per_s * 30.0 / np.pi:.4g} rpm: does not come back to the roller "
            "within a turn; raise vane.spring_force_n"
        )
    landed = np.flatnonzero(impulse)
    return acceleration, Impacts(2.0 * np.pi * landed / count, impulse[landed])
