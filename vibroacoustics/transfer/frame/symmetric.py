"""Many symmetric systems of equations side by side."""

from typing import Final

import numba
import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray

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
