"""Spin of the roller on its eccentric under oil films and the friction of the vane's tip."""

from typing import Final

import numba
import numpy as np

from ...base.arrays import Array
from ...base.errors import SolverError
from .parameters import RollingPistonTables
from .vane import SLIP_M_PER_S

PERIODIC: Final = 1e-13
"""Change of the spin in a turn, over the shaft's speed."""
SHOTS: Final = 50
STEP_ITERATIONS: Final = 60


def eccentric_drag_n_m_s(machine: RollingPistonTables) -> float:
    """Torque per relative speed of the film on the eccentric, 2π η H R³/δ (Petroff).

    Parameters
    ----------
    machine : with cylinder, roller and oil
    """
    inner = machine.roller.inner_radius_m
    viscosity, height = machine.rotary_shaft.oil_viscosity_pa_s, machine.cylinder.height_m
    return float(2.0 * np.pi * viscosity * height * inner**3 / machine.roller.film_gap_m)


def face_drag_n_m_s(machine: RollingPistonTables) -> float:
    """Torque per speed of the films on both faces of the roller, π η (R_r⁴ - R⁴)/δ.

    Parameters
    ----------
    machine : with cylinder, roller and oil
    """
    outer, inner = machine.cylinder.roller_radius_m, machine.roller.inner_radius_m
    viscosity = machine.rotary_shaft.oil_viscosity_pa_s
    return float(np.pi * viscosity * (outer**4 - inner**4) / machine.roller.face_gap_m)


def journal_drag_n_m_s(machine: RollingPistonTables) -> float:
    """Torque per speed of the films in both bearings, 2π η L R³/c (Petroff).

    Parameters
    ----------
    machine : with shaft and oil
    """
    shaft = machine.rotary_shaft
    length = shaft.main_length_m + shaft.sub_length_m
    film = shaft.oil_viscosity_pa_s / shaft.clearance_m
    return float(2.0 * np.pi * film * length * shaft.journal_radius_m**3)


def roller_inertia_kg_m2(machine: RollingPistonTables) -> float:
    """Moment of inertia of the roller about its axis, m (R_r² + R²)/2.

    Parameters
    ----------
    machine : with cylinder and roller
    """
    outer, inner = machine.cylinder.roller_radius_m, machine.roller.inner_radius_m
    return 0.5 * machine.roller.mass_kg * (outer**2 + inner**2)


def roller_spin(
    machine: RollingPistonTables,
    speed_rad_per_s: Array,
    axial_n: Array,
    incline: tuple[Array, Array],
    slide_m_per_s: Array,
) -> tuple[Array, Array]:
    """Periodic spin of the roller and its acceleration over uniform angles of the contact.

    I ω_r' = c_e (ω - ω_r) - c_f ω_r - R_r μ N tanh(u/u_0), with the normal force N of the tip and
    the sliding speed u = e ω cos θ/cos α + R_r ω_r there.

    Parameters
    ----------
    machine : with vane, roller and oil
    speed_rad_per_s : ω of the shaft, shape (samples,)
    axial_n : force along the vane that the tip hands on, shape (samples,)
    incline : sine and cosine of the normal's angle α to the vane, shape (samples,) each
    slide_m_per_s : e ω cos θ/cos α, shape (samples,)

    Returns
    -------
    spin, acceleration : shape (samples,), rad/s and rad/s²

    Raises
    ------
    SolverError
        No periodic spin is reached.
    """
    constants = (
        roller_inertia_kg_m2(machine),
        eccentric_drag_n_m_s(machine),
        face_drag_n_m_s(machine),
        machine.cylinder.roller_radius_m,
        machine.vane.tip_friction_ratio,
    )
    mean = float(np.mean(speed_rad_per_s))
    histories = (speed_rad_per_s, axial_n, *incline, slide_m_per_s, constants)
    before, start = 0.0, 0.1 * mean
    short = _turn(before, *histories)[2] - before
    for _ in range(SHOTS):
        spin, torque, end = _turn(start, *histories)
        missing = end - start
        if abs(missing) <= PERIODIC * mean:
            return spin, torque / constants[0]
        slope = (missing - short) / (start - before)
        before, short = start, missing
        start -= missing / slope
    raise SolverError(f"roller at {mean * 30.0 / np.pi:.4g} rpm: no periodic spin")


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _torque(
    w: float, speed: float, axial: float, sine: float, cosine: float, slide: float,
    constants: tuple[float, float, float, float, float],
) -> float:  # fmt: skip
    _, eccentric, face, radius, friction = constants
    share = friction * np.tanh((slide + radius * w) / SLIP_M_PER_S)
    normal = axial / (cosine + share * sine)
    return float(eccentric * (speed - w) - face * w - radius * share * normal)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _turn(
    start: float, speed: Array, axial: Array, sine: Array, cosine: Array, slide: Array,
    constants: tuple[float, float, float, float, float],
) -> tuple[Array, Array, float]:  # fmt: skip
    """Spin and torque over a turn by the trapezoidal rule, and the spin at its end."""
    count, w = speed.size, start
    spin, torque = np.empty(count), np.empty(count)
    pace = np.pi / count / constants[0]
    now = _torque(w, speed[0], axial[0], sine[0], cosine[0], slide[0], constants)
    for i in range(count):
        spin[i], torque[i] = w, now
        j = (i + 1) % count
        fixed = w + pace * now / speed[i]
        guess = fixed + pace * now / speed[i]
        for _ in range(STEP_ITERATIONS):
            then = _torque(guess, speed[j], axial[j], sine[j], cosine[j], slide[j], constants)
            new = fixed + pace * then / speed[j]
            small = abs(new - guess) <= 1e-15 * speed[j]
            guess = new
            if small:
                break
        else:
            return spin, torque, np.nan
        w = guess
        now = _torque(w, speed[j], axial[j], sine[j], cosine[j], slide[j], constants)
    return spin, torque, w
