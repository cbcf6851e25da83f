"""Many symmetric systems of equations side by side; natural motions of elastic systems."""

from dataclasses import dataclass
from typing import Any, Final

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, eigh

from ...base.arrays import Array, ComplexArray, IndexArray

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


AT_A_TIME: Final = 128
"""Systems: the matrices of so many of 50 unknowns nearly fit a processor's cache."""


def upper_pairs(size: int) -> tuple[IndexArray, IndexArray]:
    """Rows and columns of the packed elements of a symmetric matrix, shape (pair,) each."""
    rows, columns = np.triu_indices(size)
    return rows, columns


def solve_symmetric(real: Array, imaginary: Array, right: ComplexArray) -> None:
    """Solve L D Lᵀ x = b of many complex symmetric matrices without pivots, all in place.

    The elements of the elimination are the compliances of what is joined so far: physical ones,
    which loss keeps bounded.

    Parameters
    ----------
    real, imaginary : parts of the matrices, shape (pair, system), see `upper_pairs`; overwritten
    right : b, then x, shape (unknown, side, system)
    """
    parts = np.ascontiguousarray(right.real), np.ascontiguousarray(right.imag)
    _solve(real, imaginary, *parts)
    right.real, right.imag = parts


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _solve(
    real: Array, imaginary: Array, right_real: Array, right_imaginary: Array
) -> None:  # pragma: no cover
    """Elimination downwards, then upwards; loops over the systems are innermost."""
    size, sides, systems = right_real.shape
    ratio_real, ratio_imaginary = np.empty(systems), np.empty(systems)
    pivot_real, pivot_imaginary = np.empty((size, systems)), np.empty((size, systems))
    for j in range(size):
        first = j * size - j * (j - 1) // 2 - j  # of row j, less the column
        for s in range(systems):
            x, y = real[first + j, s], imaginary[first + j, s]
            share = 1.0 / (x * x + y * y)
            pivot_real[j, s], pivot_imaginary[j, s] = x * share, -y * share
        for i in range(j + 1, size):
            row = i * size - i * (i - 1) // 2 - i
            _scale(
                real[first + i], imaginary[first + i], pivot_real[j], pivot_imaginary[j],
                ratio_real, ratio_imaginary,
            )  # fmt: skip
            for k in range(i, size):
                _subtract(
                    real[row + k], imaginary[row + k], ratio_real, ratio_imaginary,
                    real[first + k], imaginary[first + k],
                )  # fmt: skip
            for side in range(sides):
                _subtract(
                    right_real[i, side], right_imaginary[i, side], ratio_real, ratio_imaginary,
                    right_real[j, side], right_imaginary[j, side],
                )  # fmt: skip
    for j in range(size - 1, -1, -1):
        first = j * size - j * (j - 1) // 2 - j
        for side in range(sides):
            for k in range(j + 1, size):
                _subtract(
                    right_real[j, side], right_imaginary[j, side],
                    real[first + k], imaginary[first + k],
                    right_real[k, side], right_imaginary[k, side],
                )  # fmt: skip
            _scale(
                right_real[j, side], right_imaginary[j, side], pivot_real[j], pivot_imaginary[j],
                right_real[j, side], right_imaginary[j, side],
            )  # fmt: skip


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _scale(a: Array, b: Array, c: Array, d: Array, e: Array, f: Array) -> None:  # pragma: no cover
    """e + jf = (a + jb) (c + jd)."""
    for s in range(a.size):
        x, y = a[s], b[s]
        e[s], f[s] = x * c[s] - y * d[s], x * d[s] + y * c[s]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _subtract(
    a: Array, b: Array, c: Array, d: Array, e: Array, f: Array
) -> None:  # pragma: no cover
    """a + jb -= (c + jd) (e + jf)."""
    for s in range(a.size):
        a[s] -= c[s] * e[s] - d[s] * f[s]
        b[s] -= c[s] * f[s] + d[s] * e[s]
