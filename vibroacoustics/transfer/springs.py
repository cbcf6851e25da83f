"""Displacement of a suspended block relative to the shell at its springs."""

from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.suspension import Suspension
from .feet import corners

STEPS: Final = 360
"""Instants of a revolution."""


def spring_displacement(
    suspension: Suspension, shell: ComplexArray, block: ComplexArray, frequency_hz: Array
) -> Array:
    """Return the largest displacement of the four springs over a revolution, shape (speed,), m.

    Parameters
    ----------
    suspension : of the block
    shell, block : velocity of the centre of mass, complex peaks from order 0, shape (speed, order,
        6), m/s and rad/s
    frequency_hz : of the orders, shape (speed, order)
    """
    low = suspension.springs_height_m
    motion = [
        _at_springs(velocity, suspension.springs.pitch_m, height, frequency_hz)
        for velocity, height in ((block, low), (shell, low + suspension.height_m))
    ]
    order = np.arange(1, shell.shape[1])
    turn = np.exp(2j * np.pi * np.arange(STEPS)[:, None] * order / STEPS)
    over_time = np.einsum("to,sofa->stfa", turn, motion[0] - motion[1]).real
    return np.asarray(np.linalg.norm(over_time, axis=-1).max(axis=(1, 2)))


def _at_springs(
    velocity: ComplexArray, pitch_m: float, height_m: float, frequency_hz: Array
) -> ComplexArray:
    """Displacement of a body at the springs, shape (speed, order from 1, spring, axis), m."""
    motion = velocity[:, 1:] / (2j * np.pi * frequency_hz[:, 1:, None])
    turned = np.cross(motion[..., None, 3:], corners(pitch_m, height_m))
    return np.asarray(motion[..., None, :3] + turned)
