"""Natural motions of a system with loss, and its answer to forces at any frequency."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from ...base.arrays import Array, ComplexArray


@dataclass(frozen=True)
class NaturalMotions:
    """Motions that keep their shape, all but the free ones.

    Attributes
    ----------
    squares : ω² of each with loss, shape (motion,), rad²/s²
    shapes : displacement of the freedoms in each, shape (freedom, motion)
    drives : of each motion per force on the freedoms, shape (motion, freedom)
    """

    squares: ComplexArray
    shapes: ComplexArray
    drives: ComplexArray

    def per_drive(self, frequency_hz: Array) -> ComplexArray:
        """Amplitude of each motion per its drive, (motion, frequency); none at frequency zero."""
        moves = frequency_hz > 0.0
        omega = 2.0 * np.pi * np.where(moves, frequency_hz, 1.0)
        return np.asarray(moves / (self.squares[:, None] - omega**2))


def natural_motions(mass: Array, stiffness: ComplexArray, free: Array) -> NaturalMotions:
    """Eigenvectors of K x = ω² M x, K complex symmetric: structural loss is exact.

    Forces are freed of what moves the free motions, which are exact eigenvectors and would
    otherwise be subject to rounding at low frequency.

    Parameters
    ----------
    mass : M, positive definite, shape (freedom, freedom)
    stiffness : K, shape (freedom, freedom)
    free : motions without strain, shape (freedom, motion)
    """
    root = np.linalg.cholesky(mass)
    unit = np.eye(len(mass))
    back = solve_triangular(root, unit, lower=True)  # of forces to coordinates of unit mass
    squares, vectors = np.linalg.eig(back @ stiffness @ back.T)
    at_rest, _ = np.linalg.qr(root.T @ free)
    drives = np.linalg.solve(vectors, (unit - at_rest @ at_rest.T) @ back)
    return NaturalMotions(squares, back.T @ vectors, drives)
