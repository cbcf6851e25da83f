"""Sound pressure per force as it was measured, with the motion of a machine on its mounts."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..mechanics.ports import HOUSING
from .machine import MachineOnMounts

PressurePerVelocity = Callable[[Array], ComplexArray]
"""Function of frequencies in Hz, shape (frequency,), to shape (receiver, motion, frequency), Pa
s/m."""


@runtime_checkable
class OfReceivers(Protocol):
    """Pressure per velocity that is computed for some receivers alone."""

    def to(self, rows: Sequence[int]) -> PressurePerVelocity:
        """Return the pressure at these receivers."""


@dataclass(frozen=True)
class ForceSound:
    """Measured pressure of forces on the machine, or of forces of its feet on the floor.

    Called as pressure per velocity of the body on the feet, it is that of the nominal machine;
    of another machine it is `of`, so that the pressure of a force stays the measured one.

    Attributes
    ----------
    body : the nominal machine
    frequency_hz : rising, shape (frequency,)
    per_wrench : pressure per force and moment on the machine about its centre of mass, shape
        (receiver, 6, frequency); none where feet were measured
    per_foot : pressure per force of each foot on the floor, shape
        (receiver, foot, axis, frequency); none where the machine was
    """

    body: MachineOnMounts
    frequency_hz: Array
    per_wrench: ComplexArray | None
    per_foot: ComplexArray | None

    def __call__(self, frequency_hz: Array) -> ComplexArray:
        """Return `of` the nominal machine."""
        return self.of(self.body)(frequency_hz)

    def of(self, body: MachineOnMounts) -> PressurePerVelocity:
        """Pressure per velocity of a body, of frequencies, shape (receiver, 6, frequency).

        A V⁻¹, with V the velocities and A the pressures of unit loads on the body on the feet: A is
        what was measured, or what was measured per foot force times the foot forces of these loads.
        At frequency zero there is no sound.
        """

        def per_velocity(frequency_hz: Array) -> ComplexArray:
            moves = frequency_hz > 0.0
            frequency = np.where(moves, frequency_hz, 1.0)
            loads = np.broadcast_to(np.eye(6, dtype=complex)[:, None], (6, frequency.size, 6))
            response = body.response(loads, frequency, HOUSING)
            velocity = np.moveaxis(response.velocity, 0, -1)  # (frequency, dof, load)
            if self.per_wrench is not None:
                made = self._at(self.per_wrench, frequency)
            else:
                assert self.per_foot is not None  # noqa: S101 - one of both is given
                per_foot = self._at(self.per_foot, frequency)
                made = np.einsum("rnaf,lfna->rlf", per_foot, response.foot_force)
            solved = np.moveaxis(made, -1, 0) @ np.linalg.inv(velocity)
            return np.asarray(np.moveaxis(solved, 0, -1) * moves)

        return per_velocity

    def to(self, rows: Sequence[int] | slice) -> "ForceSound":
        """Return the sound at some of the receivers alone."""
        chosen = rows if isinstance(rows, slice) else list(rows)
        return replace(
            self,
            per_wrench=None if self.per_wrench is None else self.per_wrench[chosen],
            per_foot=None if self.per_foot is None else self.per_foot[chosen],
        )

    def _at(self, values: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Values at some frequencies, on straight lines between those that were measured."""
        flat = values.reshape(-1, values.shape[-1])
        interpolated = [np.interp(frequency_hz, self.frequency_hz, row) for row in flat]
        return np.array(interpolated).reshape(*values.shape[:-1], frequency_hz.size)


def of_body(rigid: PressurePerVelocity, body: MachineOnMounts) -> PressurePerVelocity:
    """Pressure per velocity of a body's rigid motions; the same for all unless measured."""
    return rigid.of(body) if isinstance(rigid, ForceSound) else rigid
