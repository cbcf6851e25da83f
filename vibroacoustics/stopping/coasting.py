"""Motion of the shaft from switch-off to rest, with the force and moment on the housing."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from ..base.arrays import Array
from ..base.errors import ParameterError, SolverError
from ..machine.stopping import Stopping
from ..mechanics.moving_parts import MovingPart
from .paths import inertia_over_angle, wrench_along
from .shift import Shift, brake_shift

RELATIVE_TOLERANCE: Final = 1e-10
LONGEST_S: Final = 60.0
"""A compressor that coasts longer has the wrong drag."""
ANGLES: Final = 512
"""Samples a revolution of the reduced inertia."""


class Peaks(NamedTuple):
    """Largest resultants over time."""

    force_n: float
    tilting_moment_n_m: float
    """About a horizontal axis."""
    roll_moment_n_m: float
    """About z."""


def peaks(force_n: Array, moment_n_m: Array) -> Peaks:
    """Peaks of a force and a moment of shape (3, times)."""
    return Peaks(
        float(np.max(np.linalg.norm(force_n, axis=0))),
        float(np.max(np.linalg.norm(moment_n_m[:2], axis=0))),
        float(np.max(np.abs(moment_n_m[2]))),
    )


@dataclass(frozen=True)
class RunDown:
    """From steady running over switch-off at time zero to rest; T uniform times.

    Attributes
    ----------
    time_s, crank_angle_rad, speed_rad_per_s, acceleration_rad_per_s2 : of the shaft, shape (T,)
    shift : of the set against it, shape (T,) each
    sources : who makes force and moment
    force_n, moment_n_m : on the housing, shape (sources, 3, T)
    stop_time_s : when the shaft comes to rest, after the last sample
    """

    time_s: Array
    crank_angle_rad: Array
    speed_rad_per_s: Array
    acceleration_rad_per_s2: Array
    shift: Shift
    sources: tuple[str, ...]
    force_n: Array
    moment_n_m: Array
    stop_time_s: float

    @property
    def peaks(self) -> Peaks:
        """Peaks of the sums over all sources."""
        return peaks(self.force_n.sum(axis=0), self.moment_n_m.sum(axis=0))


def run_down(
    stopping: Stopping,
    parts: Sequence[MovingPart],
    shifted: Collection[str],
    gas_torque_n_m: Array,
    speed_rad_per_s: float,
    sample_rate_hz: float,
    steady_revolutions: int,
) -> RunDown:
    """Run-down after switch-off: the motor's torque is gone, gas and friction slow the shaft.

    Lagrange's equation, the set at φ = θ + δ(t): Σ [I φ̈ + ½ (dI/dφ) φ̇²] = -T_gas(φ) - T_f - c θ̇.
    Left out: the motor's torque while its field dies out, the pressures' change meanwhile, and what
    follows the stop.

    Parameters
    ----------
    stopping : inertia, drag, shift
    parts : moving parts of the machine and its balancer, uniformly sampled over a revolution
    shifted : sources of the set that turns against the others; the Oldham ring goes with its scroll
    gas_torque_n_m : against the rotation at steady running, shape (samples,), from crank angle zero
    speed_rad_per_s : before switch-off
    sample_rate_hz : of the result
    steady_revolutions : before switch-off, at constant speed

    Raises
    ------
    ParameterError
        A source is unknown, the speed is not above zero, or nothing slows the shaft.
    SolverError
        The integration fails.
    """
    _check(parts, shifted, speed_rad_per_s)
    coasting = _Coasting.of(stopping, parts, shifted, gas_torque_n_m)
    solution = solve_ivp(
        coasting.slopes,
        (0.0, LONGEST_S),
        (0.0, speed_rad_per_s),
        method="DOP853",
        rtol=RELATIVE_TOLERANCE,
        atol=RELATIVE_TOLERANCE,
        events=_at_rest,
        dense_output=True,
    )
    if not solution.success:
        raise SolverError(f"run-down: {solution.message}")
    if not solution.t_events[0].size:
        raise ParameterError(
            f"friction_torque_n_m = {stopping.friction_torque_n_m:g} N m: does not stop the shaft "
            f"within {LONGEST_S:g} s"
        )
    stop = float(solution.t_events[0][0])
    first = -int(steady_revolutions * 2.0 * np.pi / speed_rad_per_s * sample_rate_hz)
    time = np.arange(first, np.ceil(stop * sample_rate_hz)) / sample_rate_hz
    coasts = np.maximum(time, 0.0)
    angle, speed = solution.sol(coasts)
    angle += speed_rad_per_s * np.minimum(time, 0.0)
    acceleration = np.where(time < 0.0, 0.0, coasting.acceleration(coasts, angle, speed))
    shift = coasting.shift(coasts)
    unshifted = angle, speed, acceleration
    ahead = angle + shift.angle, speed + shift.rate, acceleration + shift.acceleration
    wrenches = [
        wrench_along(part, *(ahead if part.source in shifted else unshifted)) for part in parts
    ]
    spin = np.zeros((2, 3, time.size))  # of the rotor: no force, a moment about z
    spin[1, 2] = -stopping.shaft_inertia_kg_m2 * acceleration
    force, moment = np.stack([*wrenches, spin], axis=1)
    sources = (*(part.source for part in parts), "rotor")
    return RunDown(time, *unshifted, shift, sources, force, moment, stop)


def _check(parts: Sequence[MovingPart], shifted: Collection[str], speed: float) -> None:
    unknown = sorted(set(shifted) - {part.source for part in parts})
    if unknown:
        raise ParameterError(f"shifted = {', '.join(unknown)}: no such moving part")
    if not 0.0 < speed < np.inf:
        raise ParameterError(f"speed = {speed * 30.0 / np.pi:.4g} rpm: must be positive and finite")


def _at_rest(_: float, state: Array) -> float:
    return float(state[1])


_at_rest.terminal = True  # type: ignore[attr-defined]


@dataclass(frozen=True)
class _Coasting:
    """Equation of motion of the shaft with its parts."""

    stopping: Stopping
    fixed_inertia: CubicSpline
    shifted_inertia: CubicSpline
    gas_torque: CubicSpline

    @classmethod
    def of(
        cls,
        stopping: Stopping,
        parts: Sequence[MovingPart],
        shifted: Collection[str],
        gas_torque_n_m: Array,
    ) -> "_Coasting":
        angle = 2.0 * np.pi * np.arange(ANGLES) / ANGLES
        fixed = inertia_over_angle([part for part in parts if part.source not in shifted], angle)
        moved = inertia_over_angle([part for part in parts if part.source in shifted], angle)
        curves = fixed + stopping.shaft_inertia_kg_m2, moved, gas_torque_n_m
        return cls(stopping, *(_periodic(curve) for curve in curves))

    def shift(self, time: Array) -> Shift:
        return brake_shift(time, self.stopping.shift_rad, self.stopping.shift_duration_s)

    def acceleration(self, time: Array, angle: Array, speed: Array) -> Array:
        """θ̈ of the shaft."""
        stopping, shift = self.stopping, self.shift(time)
        ahead = angle + shift.angle
        moved = self.shifted_inertia(ahead)
        torque = stopping.gas_share_ratio * self.gas_torque(ahead) + stopping.friction_torque_n_m
        torque = torque + stopping.viscous_torque_n_m_s * speed + moved * shift.acceleration
        torque = torque + 0.5 * self.fixed_inertia(angle, 1) * speed**2
        torque = torque + 0.5 * self.shifted_inertia(ahead, 1) * (speed + shift.rate) ** 2
        return np.asarray(-torque / (self.fixed_inertia(angle) + moved))

    def slopes(self, time: float, state: Array) -> tuple[float, float]:
        angle, speed = state
        return speed, float(self.acceleration(np.asarray(time), angle, speed))


def _periodic(values: Array) -> CubicSpline:
    angle = np.linspace(0.0, 2.0 * np.pi, values.size + 1)
    return CubicSpline(angle, np.append(values, values[0]), bc_type="periodic")
