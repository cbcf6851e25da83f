"""Motion of the shaft from switch-off to rest, with the force and moment on the housing."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..machine.stopping import CheckValve, Stopping, TurningBack
from ..mechanics.moving_parts import MovingPart
from .equation import Coasting, Shift, wrench_along
from .history import TimeHistory, coast, history_of
from .reversal import Reversal, TrappedGas, turn_back

LONGEST_S: Final = 60.0
"""A compressor that coasts longer has the wrong drag."""
VALVE: Final = "check_valve"


class Peaks(NamedTuple):
    """Largest resultants over time."""

    force_n: float
    tilting_moment_n_m: float
    """Moment about a horizontal axis."""
    roll_moment_n_m: float
    """Moment about z."""


def peaks(force_n: Array, moment_n_m: Array) -> Peaks:
    """Peaks of a force and a moment of shape (3, times)."""
    return Peaks(
        float(np.max(np.linalg.norm(force_n, axis=0))),
        float(np.max(np.linalg.norm(moment_n_m[:2], axis=0))),
        float(np.max(np.abs(moment_n_m[2]))),
    )


class AfterStop(NamedTuple):
    """Events that may follow the first rest."""

    table: TurningBack
    gas: TrappedGas
    valve: CheckValve | None


@dataclass(frozen=True)
class RunDown:
    """Run-down from steady running over switch-off at time zero to rest; T uniform times.

    Attributes
    ----------
    time_s, crank_angle_rad, speed_rad_per_s, acceleration_rad_per_s2 : time and motion of the
        shaft, shape (T,)
    shift : shift of the set against it, shape (T,) each
    sources : who makes force and moment
    force_n, moment_n_m : on the housing, shape (sources, 3, T)
    stop_time_s : when the shaft comes to rest, after the last sample
    gas_share : share of the gas's forces of steady running, shape (T,)
    brake_force_n : around the shaft between brake and wall, shape (T,)
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
    gas_share: Array
    brake_force_n: Array

    @property
    def peaks(self) -> Peaks:
        """Peaks of the sums over all sources."""
        return peaks(self.force_n.sum(axis=0), self.moment_n_m.sum(axis=0))

    @property
    def turned_back_rad(self) -> float:
        """Angle between the farthest and the last."""
        return float(self.crank_angle_rad.max() - self.crank_angle_rad[-1])


def run_down(
    stopping: Stopping,
    parts: Sequence[MovingPart],
    shifted: Collection[str],
    gas_torque_n_m: Array,
    speed_rad_per_s: float,
    sample_rate_hz: float,
    steady_revolutions: int,
    after: AfterStop | None = None,
) -> RunDown:
    """Run-down after switch-off: the motor's torque is gone, gas and friction slow the shaft.

    Lagrange's equation, the set at φ = θ + δ(t): Σ [I φ̈ + ½ (dI/dφ) φ̇²] = -T_gas(φ) - T_f - c θ̇.
    Left out: the motor's torque while its field dies out, and the pressures' change until the shaft
    stands.

    Parameters
    ----------
    stopping : inertia, drag, shift
    parts : moving parts of the machine and its balancer, uniformly sampled over a revolution
    shifted : sources of the set that turns against the others; the Oldham ring goes with its scroll
    gas_torque_n_m : against the rotation at steady running, shape (samples,), from crank angle zero
    speed_rad_per_s : before switch-off
    sample_rate_hz : sample rate of the result
    steady_revolutions : before switch-off, at constant speed
    after : stretch after the first rest; none for a stop that ends there
    """
    _check(parts, shifted, speed_rad_per_s)
    coasting = Coasting.of(stopping, parts, shifted, gas_torque_n_m)
    motion, rest_s, rest_angle = _coast(coasting, speed_rad_per_s, sample_rate_hz)
    reversal = None
    if after is not None:
        reversal = turn_back(coasting, after.table, after.gas, rest_s, rest_angle)
    first = -int(steady_revolutions * 2.0 * np.pi / speed_rad_per_s * sample_rate_hz)
    end = _end_s(rest_s, reversal, after)
    time = np.arange(first, np.ceil(end * sample_rate_hz)) / sample_rate_hz
    history = history_of(coasting, motion, reversal, time, rest_angle, speed_rad_per_s)
    shift = coasting.shift(np.maximum(time, 0.0))
    unshifted = history.angle, history.speed, history.acceleration
    ahead = tuple(angle + turned for angle, turned in zip(unshifted, shift, strict=True))
    wrenches = [
        (part.source, wrench_along(part, *(ahead if part.source in shifted else unshifted)))
        for part in parts
    ]
    wrenches += _further(stopping, history, after and after.valve, time - rest_s)
    force, moment = np.stack([np.stack(wrench) for _, wrench in wrenches], axis=1)
    sources = tuple(source for source, _ in wrenches)
    return RunDown(
        time, *unshifted, shift, sources, force, moment, end, history.gas_share,
        history.brake_force_n,
    )  # fmt: skip


def _further(
    stopping: Stopping, history: TimeHistory, valve: CheckValve | None, since_rest_s: Array
) -> list[tuple[str, tuple[Array, Array]]]:
    """Wrenches: of the rotor a moment about z, of the valve a force along z."""
    still: Array = np.zeros((3, since_rest_s.size))
    spin = still.copy()
    spin[2] = -stopping.shaft_inertia_kg_m2 * history.acceleration
    further = [("rotor", (still, spin))]
    if valve is not None:
        force = still.copy()
        force[2] = closing_force_n(valve, since_rest_s)
        further.append((VALVE, (force, still)))
    return further


def _end_s(rest_s: float, reversal: Reversal | None, after: AfterStop | None) -> float:
    """Time at which shaft and valve stand."""
    ends = [rest_s]
    if reversal is not None and reversal.end_s is not None:
        ends.append(reversal.end_s)
    if after is not None and after.valve is not None:
        ends.append(rest_s + closing_time_s(after.valve))
    return max(ends)


def _coast(
    coasting: Coasting, speed_rad_per_s: float, rate_hz: float
) -> tuple[Array, float, float]:
    """Angle, speed and acceleration from switch-off to the first rest, its time and angle."""
    motion = np.empty((3, int(LONGEST_S * rate_hz)))
    samples, rest_s, angle = coast(speed_rad_per_s, 1.0 / rate_hz, motion, coasting.constants)
    if np.isnan(rest_s):
        friction = coasting.stopping.friction_torque_n_m
        raise ParameterError(
            f"friction_torque_n_m = {friction:g} N m: does not stop the shaft within "
            f"{LONGEST_S:g} s"
        )
    return motion[:, :samples], rest_s, angle


def _check(parts: Sequence[MovingPart], shifted: Collection[str], speed: float) -> None:
    unknown = sorted(set(shifted) - {part.source for part in parts})
    if unknown:
        raise ParameterError(f"shifted = {', '.join(unknown)}: no such moving part")
    if not 0.0 < speed < np.inf:
        raise ParameterError(f"speed = {speed * 30.0 / np.pi:.4g} rpm: must be positive and finite")


def flight_s(valve: CheckValve) -> float:
    """Return the flight time from rest over the lift, √(2 m s/F)."""
    return float(np.sqrt(2.0 * valve.mass_kg * valve.lift_m / valve.closing_force_n))


def impact_s(valve: CheckValve) -> float:
    """Half a period on the seat, π √(m/k)."""
    return float(np.pi * np.sqrt(valve.mass_kg / valve.seat_stiffness_n_per_m))


def closing_time_s(valve: CheckValve) -> float:
    """Flight and impact."""
    return flight_s(valve) + impact_s(valve)


def closing_force_n(valve: CheckValve, time_s: Array) -> Array:
    """Force along z on the valve's support, by its change of momentum, shape of the times.

    The disc flies down: its reaction F pushes up; on the seat it stays, with the half sine of the
    impulse √(2 F s m). Both cancel over time.

    Parameters
    ----------
    valve : disc
    time_s : time from where it starts, uniform, shape (times,); an impact shorter than a step keeps
        its impulse
    """
    flight, length = flight_s(valve), impact_s(valve)
    step = float(time_s[1] - time_s[0])
    edges = np.append(time_s - 0.5 * step, time_s[-1] + 0.5 * step)
    flown = valve.closing_force_n * np.clip(edges, 0.0, flight)
    struck = np.clip((edges - flight) / length, 0.0, 1.0)
    impulse = valve.closing_force_n * flight
    momentum = flown - impulse * 0.5 * (1.0 - np.cos(np.pi * struck))
    return np.asarray(np.diff(momentum) / step)
