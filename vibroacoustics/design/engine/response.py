"""Motion and sound of many designs at once, each on its mounts."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.decibel import power_of_level
from ...base.ellipse import semi_major_axis
from ...base.weighting import WEIGHTING

LOSS: Final = 1e-13
"""Difference between loss factors of mounts, of the stiffness, that is rounding."""


def a_weight(frequency_hz: Array) -> Array:
    """Factor from squares of peaks to A-weighted mean squares, shape (line,)."""
    return np.asarray(0.5 * power_of_level(WEIGHTING["A"](frequency_hz)))


def displacement(
    body: Mapping[str, ComplexArray],
    added: ComplexArray | None,
    load: ComplexArray,
    frequency_hz: Array,
) -> ComplexArray:
    """Motion of the bodies on their mounts, shape (design, line, motion), complex peak.

    (K + K'(f) - ω²M) x = F; with one loss factor for all mounts by the undamped modes,
    x = Σ φ (φᵀF) / (λ (1 + jη) - ω²) with φᵀMφ = 1 (Ewins, Modal Testing, 2000, eq. 2.41).

    Parameters
    ----------
    body : mass and stiffness, shape (design or 1, motion, motion)
    added : to the stiffness, shape (design or 1, line, motion, motion); none where it is constant
    load : shape (design or 1, line, motion)
    frequency_hz : above 0, shape (line,)
    """
    mass, stiffness = body["mass"].real, body["stiffness"]
    loss = stiffness[:, :1, :1].imag / stiffness[:, :1, :1].real
    uneven = np.abs(stiffness.imag - loss * stiffness.real).max()
    if added is None and uneven <= LOSS * np.abs(stiffness).max():
        return _by_modes(mass, stiffness.real, loss[:, 0, 0], load, frequency_hz)
    squares = (2.0 * np.pi * frequency_hz[:, None, None]) ** 2
    dynamic = stiffness[:, None] - squares * mass[:, None]
    if added is not None:
        dynamic = dynamic + added
    size = max(len(dynamic), len(load))
    shape = (size, *load.shape[1:])
    return np.asarray(np.linalg.solve(dynamic, np.broadcast_to(load, shape)[..., None])[..., 0])


def _by_modes(
    mass: Array, stiffness: Array, loss: Array, load: ComplexArray, frequency_hz: Array
) -> ComplexArray:
    squares, shapes = natural_modes(mass, stiffness)
    force = np.ascontiguousarray(np.swapaxes(load, 1, 2))  # (design, motion, line)
    along = (np.swapaxes(shapes, 1, 2) @ force.view(float)).view(complex)
    omega_squared = (2.0 * np.pi * frequency_hz) ** 2
    along /= (squares * (1.0 + 1j * loss[:, None]))[:, :, None] - omega_squared
    motion = (shapes @ along.view(float)).view(complex)
    return np.swapaxes(motion, 1, 2)


def natural_modes(mass: Array, stiffness: Array) -> tuple[Array, Array]:
    """Squared angular frequencies (design, mode), shapes (design, motion, mode) with φᵀMφ = 1.

    Parameters
    ----------
    mass, stiffness : symmetric, shape (design or 1, motion, motion)
    """
    inverse = np.linalg.inv(np.linalg.cholesky(mass))
    squares, turned = np.linalg.eigh(inverse @ stiffness @ np.swapaxes(inverse, 1, 2))
    return squares, np.swapaxes(inverse, 1, 2) @ turned


def pressure(motion: ComplexArray, per_velocity: ComplexArray, frequency_hz: Array) -> ComplexArray:
    """Pressure of the body on the feet, shape (design, line, receiver), complex peak, Pa.

    Parameters
    ----------
    motion : shape (design, line, motion), the body on the feet first
    per_velocity : shape (receiver, 6, line), Pa s/m
    frequency_hz : shape (line,)
    """
    per_motion = 2j * np.pi * frequency_hz[:, None, None] * np.moveaxis(per_velocity, -1, 0)
    by_line = np.ascontiguousarray(np.swapaxes(motion[..., :6], 0, 1))
    return np.swapaxes(by_line @ np.swapaxes(per_motion, 1, 2), 0, 1)


def size_of_vector(vector: ComplexArray) -> Array:
    """Largest size over a revolution, shape (design, ...) of (design, ..., 3), peak."""
    return semi_major_axis(vector, axis=-1)


def foot_forces(
    body: Mapping[str, ComplexArray],
    added: Mapping[str, ComplexArray],
    wrench: ComplexArray,
    frequency_hz: Array,
    line: IndexArray,
) -> ComplexArray:
    """Return complex forces into each foot at one line, shape (design, foot, 3), N peak.

    Parameters
    ----------
    body : mass, stiffness, foot
    added : arrays of the lines, `added` and `foot_added`; empty where stiffness is constant
    wrench : on the bodies, shape (design or 1, motion)
    frequency_hz : shape (line,)
    line : its number, shape (1,)
    """
    more = added["added"][:, line] if added else None
    motion = displacement(body, more, wrench[:, None], frequency_hz[line])[:, 0]
    per_motion = body["foot"] + (added["foot_added"][:, line[0]] if added else 0.0)
    return np.asarray(np.einsum("nfam,nm->nfa", *_alike(per_motion, motion)))


def _alike(*arrays: ComplexArray) -> Sequence[ComplexArray]:
    """Arrays of one number of designs, those of one design repeated."""
    count = max(map(len, arrays))
    return [np.broadcast_to(array, (count, *array.shape[1:])) for array in arrays]
