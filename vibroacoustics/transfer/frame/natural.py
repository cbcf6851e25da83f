"""Natural motions of elastic systems with one loss factor each, and their response to forces."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, eigh

from ...base.arrays import Array, ComplexArray

_FREE: Final = 1e-13
"""Share of the largest ω²; below it a motion strains nothing: rounding is some 1e-16."""


@dataclass(frozen=True)
class Elastic:
    """A system whose stiffness has the same loss factor everywhere.

    Attributes
    ----------
    mass, stiffness : shape (freedom, freedom)
    loss_factor_ratio : loss factor of the stiffness
    """

    mass: Array
    stiffness: Array
    loss_factor_ratio: float


@dataclass(frozen=True)
class NaturalMotions:
    """Motions that keep their shape, of unit modal mass.

    Attributes
    ----------
    squares : ω² of each with loss, shape (motion,), rad²/s²; zero of those without strain
    shapes : displacement of the degrees of freedom in each, shape (dof, motion)
    """

    squares: ComplexArray
    shapes: Array


def natural_motions(*systems: Elastic) -> NaturalMotions:
    """Eigenvectors of K x = ω² M x of systems apart, their degrees of freedom one after another."""
    squares, shapes = zip(*(_motions(system) for system in systems), strict=True)
    return NaturalMotions(np.concatenate(squares), block_diag(*shapes))


def _motions(system: Elastic) -> tuple[ComplexArray, Array]:
    values, shapes = eigh(system.stiffness, system.mass)
    values[values < _FREE * values[-1]] = 0.0
    return values * (1.0 + 1j * system.loss_factor_ratio), shapes


def answers(squares: Array | ComplexArray, omega: Array) -> ComplexArray:
    """1/(ω_n² - ω²), shape (motion, frequency); in parts, which is faster than complex division.

    Parameters
    ----------
    squares : ω_n² with loss, shape (motion,), rad²/s²
    omega : shape (frequency,), rad/s
    """
    real, loss = squares.real[:, None] - omega**2, squares.imag[:, None]
    share = 1.0 / (real**2 + loss**2)
    result = np.empty(real.shape, dtype=complex)
    np.multiply(real, share, out=result.real)
    np.multiply(-loss, share, out=result.imag)
    return result


def times(matrix: NDArray[np.floating[Any]], values: ComplexArray) -> ComplexArray:
    """A real matrix (m, n) times complex values (..., n, frequency), as one of twice as many."""
    parts = np.ascontiguousarray(values).view(np.float64)
    return np.asarray(np.matmul(matrix, parts).view(np.complex128))
