"""Responses after a change of mounts, from measurements alone: no model of source or structure."""

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import SolverError


def changed_response(
    response: ComplexArray,
    transfer: ComplexArray,
    compliance: ComplexArray,
    elongation: ComplexArray,
    stiffness_change: ComplexArray,
    truncation: float = 0.0,
) -> ComplexArray:
    """Operating responses anywhere once the stiffness of some elements has changed.

    p' = p - H Bᵀ (I + dZ B Y Bᵀ)⁻¹ dZ B u: the change acts as the forces -Bᵀ dZ e' on the machine
    as it was measured, e' = (I + B Y Bᵀ dZ)⁻¹ B u the elongation once it is there; exact for
    linear structures and a source whose forces do not change. It is the dynamic modification of
    de Klerk, Rixen and Voormeeren, AIAA Journal 46 (2008) 1169, section III, in which one unknown
    per element is solved for, so that an element whose stiffness stays is no singularity.

    Parameters
    ----------
    response : p, before the change, shape (frequency, receiver)
    transfer : H Bᵀ, response per pair of forces along each element, shape
        (frequency, receiver, element)
    compliance : B Y Bᵀ, elongation per pair of forces, m/N, shape (frequency, element, element)
    elongation : B u, before the change, shape (frequency, element)
    stiffness_change : dZ, dynamic stiffness, N/m, shape (frequency, element, element)
    truncation : singular values of I + dZ B Y Bᵀ below this share of the largest are omitted

    Returns
    -------
    p', shape (frequency, receiver)

    Raises
    ------
    SolverError
        The changed structure resonates without damping at a frequency.

    Examples
    --------
    A spring is halved, of which a mass of 1 kg hangs: F / k is doubled far below resonance.

    >>> k, omega = 4.0e4, 2.0
    >>> y = np.full((1, 1, 1), 1.0 / (k - omega**2) + 0j)
    >>> change = np.full((1, 1, 1), -k / 2.0 + 0j)
    >>> after = va.changed_response(y[0], y, y, y[0], change)
    >>> round(abs(after / y[0]).item(), 3)
    2.0
    """
    matrix = np.eye(elongation.shape[-1]) + stiffness_change @ compliance
    force = (stiffness_change @ elongation[..., None])[..., 0]
    solved = _solve(matrix, force, truncation)
    return np.asarray(response - (transfer @ solved[..., None])[..., 0])


def _solve(matrix: ComplexArray, right: ComplexArray, truncation: float) -> ComplexArray:
    """Solution of each system, of its larger singular values alone where some are omitted."""
    if truncation == 0.0:
        try:
            return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
        except np.linalg.LinAlgError:
            raise SolverError("the changed structure resonates without damping") from None
    left_vectors, sizes, rows = np.linalg.svd(matrix)
    kept = sizes > truncation * sizes[..., :1]
    inverse = np.where(kept, 1.0 / np.where(kept, sizes, 1.0), 0.0)
    parts = inverse * (left_vectors.conj().swapaxes(-1, -2) @ right[..., None])[..., 0]
    return np.asarray((rows.conj().swapaxes(-1, -2) @ parts[..., None])[..., 0])


def mount_stiffness(
    frequency_hz: Array, stiffness_n_per_m: Array | float, loss_factor: Array | float
) -> ComplexArray:
    """Dynamic stiffness of a massless mount, k (1 + jη), N/m, shape (frequency,).

    Parameters
    ----------
    frequency_hz : shape (frequency,)
    stiffness_n_per_m, loss_factor : stiffness and loss factor, one number or shape (frequency,)
    """
    return np.asarray(
        np.broadcast_to(stiffness_n_per_m * (1.0 + 1j * loss_factor), frequency_hz.shape)
    )


def mass_stiffness(frequency_hz: Array, mass_kg: float) -> ComplexArray:
    """Dynamic stiffness of a free mass, -ω² m, N/m, shape (frequency,)."""
    return np.asarray(-((2.0 * np.pi * frequency_hz) ** 2) * mass_kg + 0j)


def absorber_stiffness(
    frequency_hz: Array, mass_kg: float, stiffness_n_per_m: float, loss_factor: float
) -> ComplexArray:
    """Dynamic stiffness at the foot of a mass on a spring, N/m, shape (frequency,).

    -ω² m k / (k - ω² m), k = k₀ (1 + jη): Den Hartog, Mechanical Vibrations, section 3.2.

    Parameters
    ----------
    frequency_hz : shape (frequency,)
    mass_kg : mass of the absorber
    stiffness_n_per_m, loss_factor : stiffness and loss factor of its spring, loss above zero where
        it is excited in tune
    """
    inertia = mass_stiffness(frequency_hz, mass_kg)
    spring = stiffness_n_per_m * (1.0 + 1j * loss_factor)
    return np.asarray(spring * inertia / (spring + inertia))
