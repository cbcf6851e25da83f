"""Exact natural frequencies of a circular cylindrical shell between shear diaphragms.

Leissa, Vibration of Shells, NASA SP-288 (1973), section 2.3.
"""

import numpy as np

from vibroacoustics.base.arrays import Array
from vibroacoustics.machine.shell_structure import ShellStructure


def fluegge_matrix(
    circumferential_order: int, axial_wave_number: float, thickness_ratio: float, poisson: float
) -> Array:
    """Stiffness of Flügge's shell theory for u, v, w, dimensionless, shape (3, 3).

    Leissa (1973), section 2.1: the operator of Donnell and Mushtari plus k times Flügge's, for
    u = A cos λs cos nθ, v = B sin λs sin nθ, w = C sin λs cos nθ with s in radii. The eigenvalues
    are Ω² = ρ (1 - ν²) R² ω² / E.

    Parameters
    ----------
    circumferential_order : n
    axial_wave_number : λ = m π R / L
    thickness_ratio : k = h² / (12 R²)
    poisson : ν
    """
    n, wave, k = circumferential_order, axial_wave_number, thickness_ratio
    change = np.array(
        [
            [(1 - poisson) / 2 * n**2, 0.0, (1 - poisson) / 2 * wave * n**2 - wave**3],
            [0.0, 1.5 * (1 - poisson) * wave**2, (3 - poisson) / 2 * wave**2 * n],
            [0.0, 0.0, 1.0 - 2.0 * n**2],
        ]
    )
    upper = np.triu(change, 1)
    return np.asarray(donnell_matrix(n, wave, k, poisson) + k * (change + upper.T))


def donnell_matrix(
    circumferential_order: int, axial_wave_number: float, thickness_ratio: float, poisson: float
) -> Array:
    """As `fluegge_matrix`, of Donnell's and Mushtari's theory, Leissa (1973), section 2.1.

    It leaves out what bends a nearly straight wall: frequencies of low n come out too high.

    Parameters
    ----------
    circumferential_order : n
    axial_wave_number : λ = m π R / L
    thickness_ratio : k = h² / (12 R²)
    poisson : ν
    """
    n, wave = circumferential_order, axial_wave_number
    shear = (1 - poisson) / 2
    across = -(1 + poisson) / 2 * wave * n
    return np.array(
        [
            [wave**2 + shear * n**2, across, -poisson * wave],
            [across, shear * wave**2 + n**2, n],
            [-poisson * wave, n, 1.0 + thickness_ratio * (wave**2 + n**2) ** 2],
        ]
    )


def diaphragm_frequencies_hz(
    structure: ShellStructure,
    radius_m: float,
    span_m: float,
    circumferential_order: int,
    axial_half_waves: int,
) -> Array:
    """Natural frequencies by Flügge's theory, shape (3,): the roots of its cubic in ω².

    For n > 0 the first is the bending mode of the wall, the others stretch it along and around.

    Parameters
    ----------
    structure : thickness and material
    radius_m : of the middle surface
    span_m : distance of the shear diaphragms, which hold w and v and leave u free
    circumferential_order : n
    axial_half_waves : m, at least 1
    """
    wave = axial_half_waves * np.pi * radius_m / span_m
    thickness_ratio = structure.thickness_m**2 / (12.0 * radius_m**2)
    matrix = fluegge_matrix(circumferential_order, wave, thickness_ratio, structure.poisson_ratio)
    return _frequencies_hz(matrix, structure, radius_m)


def donnell_frequencies_hz(
    structure: ShellStructure,
    radius_m: float,
    span_m: float,
    circumferential_order: int,
    axial_half_waves: int,
) -> Array:
    """As `diaphragm_frequencies_hz`, by the theory of Donnell and Mushtari."""
    wave = axial_half_waves * np.pi * radius_m / span_m
    thickness_ratio = structure.thickness_m**2 / (12.0 * radius_m**2)
    matrix = donnell_matrix(circumferential_order, wave, thickness_ratio, structure.poisson_ratio)
    return _frequencies_hz(matrix, structure, radius_m)


def _frequencies_hz(matrix: Array, structure: ShellStructure, radius_m: float) -> Array:
    modulus = structure.youngs_modulus_pa / (1.0 - structure.poisson_ratio**2)
    speed = np.sqrt(modulus / structure.density_kg_per_m3)
    return np.asarray(np.sqrt(np.linalg.eigvalsh(matrix)) * speed / (2.0 * np.pi * radius_m))
