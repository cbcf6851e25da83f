"""Observers of a machine: microphones, feet, motions, points of its wall."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..mechanics.ports import HOUSING
from .force_sound import OfReceivers, PressurePerVelocity
from .machine import MachineOnMounts


@dataclass(frozen=True, eq=False)
class Observers:
    """Observed quantities per velocity: pressure, foot force, velocity.

    Attributes
    ----------
    rigid : per velocity of the six rigid motions of the body on the feet, at frequencies in Hz,
        shape (observer, 6, frequency)
    modes : per velocity of the modes of its shell, (observer, mode, frequency); None where loads
        in the shell are not observed
    """

    rigid: PressurePerVelocity
    modes: PressurePerVelocity | None = None

    def of_modes(self, frequency_hz: Array) -> ComplexArray:
        """Evaluate `modes`, which must be there."""
        if self.modes is None:
            raise ValueError("loads in the shell are not observed")
        return self.modes(frequency_hz)

    def to(self, rows: Sequence[int]) -> "Observers":
        """Select some of the observers, the dimension kept."""
        return Observers(
            _rows(self.rigid, rows), None if self.modes is None else _rows(self.modes, rows)
        )


def feet(body: MachineOnMounts) -> Observers:
    """Observe the force of each foot on the floor along x, y, z, (foot times axis), N.

    The feet observe the bodies on mounts and springs alone; no steady force.
    """

    def per_velocity(frequency_hz: Array) -> ComplexArray:
        moves = frequency_hz > 0.0
        frequency = np.where(moves, frequency_hz, 1.0)
        motion = np.zeros((6, frequency.size, len(body.isolation.bodies), 6), dtype=complex)
        motion[:, :, body.row(HOUSING)] = np.eye(6)[:, None]
        force = body.isolation.bushing_force(motion, frequency)[..., : len(body.stand.names), :3]
        force = force * (moves / (2j * np.pi * frequency))[:, None, None]
        return np.asarray(np.moveaxis(force.reshape(6, frequency.size, -1), -1, 0))

    return Observers(per_velocity)


def motions(modes: int) -> Observers:
    """Observe the velocities of the shell's modes and then of its six rigid motions."""
    each = np.eye(modes + 6, dtype=complex)
    return constant(each[:, modes:], each[:, :modes])


def constant(rigid: Array | ComplexArray, modes: Array | ComplexArray) -> Observers:
    """Observe velocities by factors that are the same at all frequencies.

    Parameters
    ----------
    rigid, modes : shapes (observer, 6) and (observer, mode)
    """

    def at_all(factors: Array | ComplexArray) -> PressurePerVelocity:
        return lambda frequency_hz: np.repeat(
            factors[:, :, None].astype(complex), frequency_hz.size, axis=2
        )

    return Observers(at_all(rigid), at_all(modes))


def _rows(per_velocity: PressurePerVelocity, rows: Sequence[int]) -> PressurePerVelocity:
    if isinstance(per_velocity, OfReceivers):
        return per_velocity.to(rows)
    return lambda frequency_hz: per_velocity(frequency_hz)[list(rows)]
