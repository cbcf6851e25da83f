"""Natural motions of a system with loss, and what modes answer to forces at any frequency."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from ...base.arrays import Array, ComplexArray

_FREE: Final = 1e-13
"""Of the largest ω²; below it a motion strains nothing: rounding is some 1e-16."""


@dataclass(frozen=True)
class NaturalMotions:
    """Motions that keep their shape.

    Attributes
    ----------
    squares : ω² of each with loss, shape (motion,), rad²/s²; zero of those without strain
    shapes : displacement of the freedoms in each, shape (freedom, motion)
    drives : of each motion per force on the freedoms, shape (motion, freedom)
    """

    squares: ComplexArray
    shapes: ComplexArray
    drives: ComplexArray


def natural_motions(mass: Array, stiffness: ComplexArray) -> NaturalMotions:
    """Eigenvectors of K x = ω² M x, K complex symmetric: structural loss is exact.

    Motions without strain are split off first, so that rounding does not hold them.

    Parameters
    ----------
    mass : M, positive definite, shape (freedom, freedom)
    stiffness : K, shape (freedom, freedom)
    """
    back = solve_triangular(np.linalg.cholesky(mass), np.eye(len(mass)), lower=True)
    of_unit_mass = back @ stiffness @ back.T
    strain, axes = np.linalg.eigh(of_unit_mass.real)
    still = strain < _FREE * strain[-1]
    squares, vectors = np.linalg.eig(axes[:, ~still].T @ of_unit_mass @ axes[:, ~still])
    free, held = axes[:, still].T @ back, axes[:, ~still].T @ back
    shapes = np.concatenate([free.T, held.T @ vectors], axis=1)
    drives = np.concatenate([free, np.linalg.solve(vectors, held)])
    return NaturalMotions(np.concatenate([np.zeros(len(free)), squares]), shapes, drives)


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
