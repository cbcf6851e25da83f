"""Equation of motion of a shaft that coasts, with its parts and the gas."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.interpolate import CubicSpline

from ..base.arrays import Array
from ..machine.stopping import Stopping
from ..mechanics.moving_parts import MovingPart
from .paths import inertia_over_angle
from .shift import Shift, brake_shift

ANGLES: Final = 512
"""Samples a revolution of the reduced inertia."""


@dataclass(frozen=True)
class Coasting:
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
    ) -> "Coasting":
        """With the reduced inertia of the parts over a revolution."""
        angle = 2.0 * np.pi * np.arange(ANGLES) / ANGLES
        fixed = inertia_over_angle([part for part in parts if part.source not in shifted], angle)
        moved = inertia_over_angle([part for part in parts if part.source in shifted], angle)
        curves = fixed + stopping.shaft_inertia_kg_m2, moved, gas_torque_n_m
        return cls(stopping, *(_periodic(curve) for curve in curves))

    def shift(self, time: Array) -> Shift:
        """Of the set against the crank pin."""
        return brake_shift(time, self.stopping.shift_rad, self.stopping.shift_duration_s)

    def acceleration(
        self,
        time: Array,
        angle: Array,
        speed: Array | float,
        share: Array | float = 1.0,
        turning: Array | float = 1.0,
        push: Array | float = 0.0,
    ) -> Array:
        """θ̈ of the shaft.

        Parameters
        ----------
        time, angle, speed : of the shaft
        share : of the gas's torque that is left
        turning : sense in which friction is overcome; 0 leaves it out
        push : torque forwards, N m
        """
        stopping, shift = self.stopping, self.shift(time)
        ahead = angle + shift.angle
        moved = self.shifted_inertia(ahead)
        gas = stopping.gas_share_ratio * share * self.gas_torque(ahead)
        torque = gas + stopping.friction_torque_n_m * turning
        torque = torque + stopping.viscous_torque_n_m_s * speed + moved * shift.acceleration
        torque = torque + 0.5 * self.fixed_inertia(angle, 1) * speed**2
        torque = torque + 0.5 * self.shifted_inertia(ahead, 1) * (speed + shift.rate) ** 2
        return np.asarray((push - torque) / (self.fixed_inertia(angle) + moved))

    def slopes(self, time: float, state: Array) -> tuple[float, float]:
        """Of angle and speed while the shaft runs down."""
        angle, speed = state
        return speed, float(self.acceleration(np.asarray(time), angle, speed))


def _periodic(values: Array) -> CubicSpline:
    angle = np.linspace(0.0, 2.0 * np.pi, values.size + 1)
    return CubicSpline(angle, np.append(values, values[0]), bc_type="periodic")
