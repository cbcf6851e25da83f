"""The exact Green's function of an empty room with six locally reacting walls."""

import numpy as np

from vibroacoustics.base.constants import SPEED_OF_SOUND_M_PER_S


def _transverse(length, k, below, above, points, modes):
    """Wavenumbers squared and normalised products of modes between Robin ends, at points.

    Legendre polynomials on (0, L): (K + jk(Y0 + YL)) v = kappa² M v, complex symmetric, so that
    modes are orthogonal without conjugation. Returns kappa² (mode,) and values (mode, point).
    """
    from scipy.linalg import eig

    n = np.arange(modes)
    norm = np.sqrt((2 * n + 1) / length)
    upper = n[None, :] - n[:, None]
    # integral of P_m' P_n' over (-1, 1): l(l+1) for the lower degree l of the same parity
    lower = np.minimum.outer(n, n)
    stiffness = np.where(upper % 2 == 0, lower * (lower + 1.0), 0.0) * 2.0 / length
    stiffness = stiffness * np.outer(norm, norm)
    at_zero, at_end = norm * (-1.0) ** n, norm
    matrix = stiffness + 1j * k * (
        below * np.outer(at_zero, at_zero) + above * np.outer(at_end, at_end)
    )
    squared, vectors = eig(matrix)
    vectors = vectors / np.sqrt((vectors**2).sum(axis=0))
    basis = np.polynomial.legendre.legvander(2.0 * np.asarray(points) / length - 1.0, modes - 1)
    values = (basis * norm) @ vectors
    keep = np.argsort(squared.real)[: int(0.6 * modes)]
    return squared[keep], values.T[keep]


def _between(length, k, gamma, below, above, source, points):
    """Green's function along one axis of d²/dx² - gamma² with Robin ends, (..., point).

    dg/dx = jk Y0 g at 0 and -jk YL g at L; gamma (...) with a positive real part.
    """
    g = gamma[..., None]
    r0, r1 = (
        (g - 1j * k * below) / (g + 1j * k * below),
        (g - 1j * k * above) / (g + 1j * k * above),
    )
    low, high = np.minimum(source, points), np.maximum(source, points)
    left = 1.0 + r0 * np.exp(-2.0 * g * low)
    right = 1.0 + r1 * np.exp(-2.0 * g * (length - high))
    return (
        np.exp(-g * (high - low)) * left * right
        / (2.0 * g * (1.0 - r0 * r1 * np.exp(-2.0 * g * length)))
    )  # fmt: skip


def exact_green(size, admittance, source, points, frequency_hz, modes=60, along=0):
    """G (frequency, point), 1/m.

    `admittance` gives rho c u/p of the six sides (frequency, 6): -x, +x, -y, +y, floor, ceiling.
    Along `along` the solution is in closed form, across it a sum of modes.
    """
    axes = [along, *(axis for axis in range(3) if axis != along)]
    source, points = np.asarray(source), np.atleast_2d(points)
    result = np.empty((len(frequency_hz), len(points)), dtype=complex)
    for row, frequency in enumerate(frequency_hz):
        k = 2.0 * np.pi * frequency / SPEED_OF_SOUND_M_PER_S
        across = []
        for axis in axes[1:]:
            at = np.append(points[:, axis], source[axis])
            ends = admittance[row, 2 * axis : 2 * axis + 2]
            squared, values = _transverse(size[axis], k, *ends, at, modes)
            across.append((squared, values[:, :-1] * values[:, -1:]))
        (ky2, y), (kz2, z) = across
        gamma = np.sqrt(ky2[:, None] + kz2[None, :] - k**2 + 0j)
        ends = admittance[row, 2 * along : 2 * along + 2]
        x = _between(size[along], k, gamma, *ends, source[along], points[:, along])
        result[row] = np.einsum("mp,np,mnp->p", y, z, x)
    return result
