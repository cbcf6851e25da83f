"""Forces from the responses that they make, by an inverse with or without truncation."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError

ROUNDING: Final = 1e-12
"""Singular values below this part of the largest are nothing but rounding."""


def inverted_forces(
    response: ComplexArray, compliance: ComplexArray, truncation: float = 0.0
) -> ComplexArray:
    """Forces that make responses best, f = Y⁺ u, for a source where it stands.

    With Y of the assembly, responses while it runs and forces at the interface these are the
    blocked forces of the source (ISO 20270:2019; Moorhouse, Elliott and Evans, Journal of Sound
    and Vibration 325 (2009) 849, equation 9): independent of what it is mounted on.

    Parameters
    ----------
    response : u, shape (frequency, response)
    compliance : Y, responses per unit force, shape (frequency, response, force)
    truncation : singular values of Y below this share of the largest of their frequency go

    Returns
    -------
    f, shape (frequency, force); the smallest ones where several make the same responses

    Raises
    ------
    ParameterError
        The shapes do not fit each other.

    Examples
    --------
    Two responses to one force of 3 N.

    >>> y = np.array([[[2.0], [1.0 + 1.0j]]])
    >>> va.inverted_forces(3.0 * y[:, :, 0], y).round(6)
    array([[3.+0.j]])
    """
    if compliance.ndim != 3 or compliance.shape[:2] != response.shape:
        raise ParameterError(
            f"compliance: shape {compliance.shape}: must be (frequency, response, force) of a "
            f"response of shape {response.shape}"
        )
    (inverse,) = truncated_inverses(compliance, [truncation])
    return np.asarray((inverse @ response[..., None])[..., 0])


def truncated_inverses(matrix: ComplexArray, truncations: Sequence[float]) -> ComplexArray:
    """Pseudo-inverses of matrices, shape (truncation, frequency, column, row).

    Parameters
    ----------
    matrix : shape (frequency, row, column)
    truncations : shares of the largest singular value below which others are omitted
    """
    left_vectors, sizes, right = np.linalg.svd(matrix, full_matrices=False)
    inverses = []
    for truncation in truncations:
        kept = sizes > max(truncation, ROUNDING) * sizes[..., :1]
        inverse = np.where(kept, 1.0 / np.where(kept, sizes, 1.0), 0.0)
        inverses.append((right.conj().swapaxes(-1, -2) * inverse[:, None]) @ _adjoint(left_vectors))
    return np.array(inverses)


def condition_number(matrix: ComplexArray) -> Array:
    """Largest over smallest singular value, shape (frequency,).

    Parameters
    ----------
    matrix : shape (frequency, row, column)
    """
    sizes = np.linalg.svd(matrix, compute_uv=False)
    return np.asarray(sizes[:, 0] / np.maximum(sizes[:, -1], ROUNDING * sizes[:, 0]))


def left_out_responses(
    response: ComplexArray, compliance: ComplexArray, truncations: Sequence[float]
) -> ComplexArray:
    """Each response as the forces from all others make it, (truncation, frequency, response).

    Cross validation: Thite and Thompson, Journal of Sound and Vibration 264 (2003) 433,
    section 2.

    Parameters
    ----------
    response, compliance : see `inverted_forces`; more responses than forces
    truncations : to try
    """
    count = response.shape[1]
    made = np.empty((len(truncations), *response.shape), dtype=complex)
    for omitted in range(count):
        others = [row for row in range(count) if row != omitted]
        inverses = truncated_inverses(compliance[:, others], truncations)
        forces = inverses @ response[:, others, None]
        made[:, :, omitted] = (compliance[:, omitted, None] @ forces)[..., 0, 0]
    return made


def rigid_wrench(position_m: Array, direction: Array) -> Array:
    """Force and moment about the origin per unit force at each point, shape (6, point).

    Parameters
    ----------
    position_m : position of the points from the centre of mass, shape (point, 3)
    direction : unit vectors, shape (point, 3)
    """
    return np.asarray(np.concatenate([direction, np.cross(position_m, direction)], axis=1).T)


def rigid_forces(wrench: Array) -> Array:
    """Sets of forces that move a rigid body, orthonormal, shape (point, set).

    Any other set of forces at its points has no force and moment, and moves it not at all.

    Parameters
    ----------
    wrench : per unit force at each point, shape (6, point)
    """
    left_vectors, sizes, _ = np.linalg.svd(wrench.T, full_matrices=False)
    return np.asarray(left_vectors[:, sizes > 1e-9 * sizes[0]])


def _adjoint(matrix: ComplexArray) -> ComplexArray:
    return np.asarray(matrix.conj().swapaxes(-1, -2))
