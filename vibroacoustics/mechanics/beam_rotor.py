"""Finite-element rotor of Nelson & McVaugh (1976): beams with rotary inertia, rigid discs.

Each node has x, y, θx, θy; M q̈ + Ω G q̇ + K q = f. Slopes are dx/dz = θy and dy/dz = -θx.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError

NODE_DOFS: Final = 4
_SAME_NODE_M: Final = 1e-9
"""Distance below which positions are those of one node."""
X_PLANE: Final = np.eye(8)[[0, 3, 4, 7]]
"""x1, dx1/dz, x2, dx2/dz from the element's eight displacements."""
Y_PLANE: Final = np.array([[1.0], [-1.0], [1.0], [-1.0]]) * np.eye(8)[[1, 2, 5, 6]]


@dataclass(frozen=True)
class Section:
    """Round section of a shaft: diameter in m, Young's modulus in Pa, density in kg/m³."""

    diameter_m: float
    youngs_modulus_pa: float
    density_kg_per_m3: float

    @property
    def area_m2(self) -> float:
        return 0.25 * np.pi * self.diameter_m**2

    @property
    def second_moment_m4(self) -> float:
        """Second moment of area about a diameter."""
        return np.pi * self.diameter_m**4 / 64.0


@dataclass(frozen=True)
class RotorMatrices:
    """Mass, gyroscopic matrix per rad/s of spin and stiffness, all of shape (dof, dof)."""

    mass: Array
    gyroscopic: Array
    stiffness: Array


def translation_matrix(length_m: float) -> Array:
    """∫ N Nᵀ dz of cubic Hermite shapes (Nelson & McVaugh, [M_T] per unit mass per length)."""
    le = length_m
    return (
        np.array(
            [
                [156.0, 22.0 * le, 54.0, -13.0 * le],
                [22.0 * le, 4.0 * le**2, 13.0 * le, -3.0 * le**2],
                [54.0, 13.0 * le, 156.0, -22.0 * le],
                [-13.0 * le, -3.0 * le**2, -22.0 * le, 4.0 * le**2],
            ]
        )
        * le
        / 420.0
    )


def rotation_matrix(length_m: float) -> Array:
    """∫ N' N'ᵀ dz (Nelson & McVaugh, [M_R] per unit of second moment times density)."""
    le = length_m
    return np.array(
        [
            [36.0, 3.0 * le, -36.0, 3.0 * le],
            [3.0 * le, 4.0 * le**2, -3.0 * le, -(le**2)],
            [-36.0, -3.0 * le, 36.0, -3.0 * le],
            [3.0 * le, -(le**2), -3.0 * le, 4.0 * le**2],
        ]
    ) / (30.0 * le)


def bending_matrix(length_m: float) -> Array:
    """∫ N'' N''ᵀ dz (Nelson & McVaugh, [K_B] per unit of bending stiffness)."""
    le = length_m
    return (
        np.array(
            [
                [12.0, 6.0 * le, -12.0, 6.0 * le],
                [6.0 * le, 4.0 * le**2, -6.0 * le, 2.0 * le**2],
                [-12.0, -6.0 * le, 12.0, -6.0 * le],
                [6.0 * le, 2.0 * le**2, -6.0 * le, 4.0 * le**2],
            ]
        )
        / le**3
    )


def beam_element(section: Section, length_m: float) -> RotorMatrices:
    """Matrices of one element, both planes (Nelson & McVaugh 1976, eq. 23 and appendix)."""
    density, moment = section.density_kg_per_m3, section.second_moment_m4
    element = inertia_element(density * section.area_m2, density * moment, length_m)
    bending = section.youngs_modulus_pa * moment * bending_matrix(length_m)
    return replace(element, stiffness=_both_planes(bending))


def inertia_element(
    mass_kg_per_m: float, rotary_inertia_kg_m: float, length_m: float
) -> RotorMatrices:
    """Matrices of an element without stiffness, both planes.

    Parameters
    ----------
    mass_kg_per_m : mass per length
    rotary_inertia_kg_m : moment of inertia about a diameter per length; about the axis twice that
    length_m : length of the element
    """
    rotary = rotary_inertia_kg_m * rotation_matrix(length_m)
    half = X_PLANE.T @ (2.0 * rotary) @ Y_PLANE
    mass = _both_planes(mass_kg_per_m * translation_matrix(length_m) + rotary)
    return RotorMatrices(mass, half - half.T, np.zeros_like(mass))


def _both_planes(plane: Array) -> Array:
    return np.asarray(X_PLANE.T @ plane @ X_PLANE + Y_PLANE.T @ plane @ Y_PLANE)


def assemble(section: Section, node_positions_m: Array) -> RotorMatrices:
    """A uniform shaft with elements between the nodes.

    Parameters
    ----------
    section : the shaft's section
    node_positions_m : along the shaft, ascending, shape (nodes,)

    Raises
    ------
    ParameterError
        An element has no length.
    """
    lengths = np.diff(node_positions_m)
    if lengths.size == 0 or np.min(lengths) <= 0.0:
        raise ParameterError(f"node_positions_m = {node_positions_m}: must ascend")
    size = NODE_DOFS * (lengths.size + 1)
    total = RotorMatrices(*(np.zeros((size, size)) for _ in range(3)))
    for first, length in enumerate(lengths):
        _add(total, first, beam_element(section, float(length)))
    return total


def with_ring(
    rotor: RotorMatrices, node_positions_m: Array, ends_m: tuple[float, float],
    mass_kg: float, diameters_m: tuple[float, float],
) -> RotorMatrices:  # fmt: skip
    """The rotor with a thick ring that follows the shaft without stiffening it.

    Parameters
    ----------
    rotor : between the nodes
    node_positions_m : along the shaft, both ends of the ring among them, shape (nodes,)
    ends_m : lower and upper end of the ring
    mass_kg : mass of the ring
    diameters_m : inner and outer diameter
    """
    total = RotorMatrices(rotor.mass.copy(), rotor.gyroscopic.copy(), rotor.stiffness.copy())
    mass_kg_per_m = mass_kg / (ends_m[1] - ends_m[0])
    rotary = mass_kg_per_m * (diameters_m[0] ** 2 + diameters_m[1] ** 2) / 16.0
    first, last = np.searchsorted(node_positions_m, np.array(ends_m) - _SAME_NODE_M)
    for element in range(int(first), int(last)):
        length = float(node_positions_m[element + 1] - node_positions_m[element])
        _add(total, element, inertia_element(mass_kg_per_m, rotary, length))
    return total


def _add(total: RotorMatrices, first: int, element: RotorMatrices) -> None:
    """Add the matrices of the element after a node, in place."""
    rows = slice(NODE_DOFS * first, NODE_DOFS * (first + 2))
    total.mass[rows, rows] += element.mass
    total.gyroscopic[rows, rows] += element.gyroscopic
    total.stiffness[rows, rows] += element.stiffness


def with_disc(
    rotor: RotorMatrices, node: int, mass_kg: float, transverse_kg_m2: float, axial_kg_m2: float
) -> RotorMatrices:
    """The rotor with a rigid disc at a node (Nelson & McVaugh 1976, eq. 10)."""
    mass, gyroscopic = rotor.mass.copy(), rotor.gyroscopic.copy()
    dofs = NODE_DOFS * node + np.arange(NODE_DOFS)
    mass[dofs, dofs] += [mass_kg, mass_kg, transverse_kg_m2, transverse_kg_m2]
    gyroscopic[dofs[2], dofs[3]] += axial_kg_m2
    gyroscopic[dofs[3], dofs[2]] -= axial_kg_m2
    return RotorMatrices(mass, gyroscopic, rotor.stiffness)


def whirl_frequencies_hz(rotor: RotorMatrices, spin_rad_per_s: float) -> Array:
    """Whirl frequencies of an undamped spinning rotor, ascending, backward and forward.

    M is positive definite and K must be too: the state matrix is similar to a Hermitian one.
    """
    lower = np.linalg.cholesky(rotor.mass)
    inverse = np.linalg.inv(lower)
    stiffness = inverse @ rotor.stiffness @ inverse.T
    gyroscopic = spin_rad_per_s * inverse @ rotor.gyroscopic @ inverse.T
    root = np.linalg.cholesky(stiffness)
    zero = np.zeros_like(root)
    skew = np.block([[zero, root.T], [-root, -gyroscopic]])  # states Lᵀq and q̇
    frequencies = np.linalg.eigvalsh(1j * skew)
    return np.asarray(frequencies[frequencies > 0.0] / (2.0 * np.pi))
