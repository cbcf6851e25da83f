"""Conical thin-shell elements: stiffness and mass per circumferential order.

Sanders (1959), NASA TR R-24: strains that vanish in every rigid motion. All displacements are
cubic along the meridian, so that bending without stretching is not locked.
"""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.polynomial import polynomial
from scipy.sparse import coo_matrix

from ...base.arrays import Array, IndexArray
from ...machine.shell_structure import ShellStructure
from .meridian import Meridian

NODE_DOFS: Final = 4
"""Radial, axial and circumferential displacement, and rotation β = -dw/ds."""
RADIAL, AXIAL, CIRCUMFERENTIAL, ROTATION = range(NODE_DOFS)
_GAUSS: Final = 6
"""Points along an element; the shapes are cubic, 1/r is smooth off the axis."""
_INNER: Final = 4
"""Further amplitudes of an element: two of u, two of v."""


Polynomials = tuple[tuple[float, ...], ...]
_LINEAR: Final[Polynomials] = ((0.5, -0.5), (0.5, 0.5))
_BUBBLES: Final[Polynomials] = ((1.0, 0.0, -1.0, 0.0), (0.0, 1.0, 0.0, -1.0))
_HERMITE: Final[Polynomials] = (
    (0.5, -0.75, 0.0, 0.25),
    (0.25, -0.25, -0.25, 0.25),
    (0.5, 0.75, 0.0, -0.25),
    (-0.25, -0.25, 0.25, 0.25),
)
"""Value and slope at -1, value and slope at 1."""


class Shapes(NamedTuple):
    """u, v, w or one of their derivatives in s per amplitude, each (point, 12)."""

    along: Array
    around: Array
    normal: Array


def freedom_count(meridian: Meridian) -> int:
    """Freedoms of all nodes and, after them, inner amplitudes of all elements."""
    return NODE_DOFS * (meridian.elements + 1) + _INNER * meridian.elements


def element_dofs(meridian: Meridian) -> IndexArray:
    """Places of each element's twelve amplitudes among all, shape (element, 12)."""
    first = np.arange(meridian.elements)[:, None]
    nodes = NODE_DOFS * first + np.arange(2 * NODE_DOFS)
    inner = NODE_DOFS * (meridian.elements + 1) + _INNER * first + np.arange(_INNER)
    return np.asarray(np.concatenate([nodes, inner], axis=1))


def shapes(
    meridian: Meridian, element: IndexArray, coordinate: Array, derivative: int = 0
) -> Shapes:
    """Displacements u along the meridian, v around and w outwards per amplitude.

    Parameters
    ----------
    meridian : nodes
    element : element of each point, shape (point,)
    coordinate : -1 to 1 along it, shape (point,)
    derivative : order of the derivative in s, 0 to 2
    """
    half = 0.5 * meridian.lengths[element]
    scale = half[:, None] ** -derivative
    linear, inner, hermite = (
        scale * _polynomials(coefficients, coordinate, derivative)
        for coefficients in (_LINEAR, _BUBBLES, _HERMITE)
    )
    hermite[:, 1::2] *= -half[:, None]  # w' = -β
    radial, axial = meridian.tangents[element].T
    along, around, normal = (np.zeros((coordinate.size, 12)) for _ in range(3))
    for end, node in enumerate((0, NODE_DOFS)):
        along[:, node + RADIAL] = linear[:, end] * radial
        along[:, node + AXIAL] = linear[:, end] * axial
        around[:, node + CIRCUMFERENTIAL] = linear[:, end]
        normal[:, node + RADIAL] = hermite[:, 2 * end] * axial
        normal[:, node + AXIAL] = -hermite[:, 2 * end] * radial
        normal[:, node + ROTATION] = hermite[:, 2 * end + 1]
    along[:, 8:10], around[:, 10:12] = inner, inner
    return Shapes(along, around, normal)


def _polynomials(coefficients: Polynomials, coordinate: Array, derivative: int) -> Array:
    """Derivatives in the element's coordinate of polynomials, shape (point, polynomial)."""
    derived = polynomial.polyder(np.transpose(coefficients), derivative)
    return np.asarray(polynomial.polyval(coordinate, derived).T)


def displacement_shapes(meridian: Meridian, element: IndexArray, coordinate: Array) -> Array:
    """Radial, axial and circumferential displacement per amplitude, shape (point, 3, 12)."""
    along, around, normal = shapes(meridian, element, coordinate)
    radial, axial = meridian.tangents[element].T[:, :, None]
    return np.stack([radial * along + axial * normal, axial * along - radial * normal, around], 1)


def strains(meridian: Meridian, element: IndexArray, coordinate: Array, order: int) -> Array:
    """Strains and changes of curvature per amplitude, shape (point, 6, 12).

    ε_s, ε_θ, γ, κ_s, κ_θ, 2 κ_sθ of Sanders (1959) on a cone, for u and w with cos nθ and v with
    sin nθ, v outright for n = 0.

    Parameters
    ----------
    meridian : nodes
    element : element of each point, shape (point,)
    coordinate : -1 to 1 along it, shape (point,), off the axis
    order : n
    """
    n = order
    (u, v, w), (du, dv, dw), (_, _, ddw) = (
        shapes(meridian, element, coordinate, derivative) for derivative in range(3)
    )
    r = _radius(meridian, element, coordinate)[:, None]
    slope, turn = meridian.tangents[element].T[:, :, None]  # dr/ds, and r over the second radius
    spin = 0.5 * (dv + (slope * v + n * u) / r)  # about the normal
    lean = (n * w + turn * v) / r  # about the meridian
    d_lean = (n * dw + turn * dv - slope * lean) / r
    return np.stack(
        [
            du,
            (n * v + slope * u + turn * w) / r,
            dv - (n * u + slope * v) / r,
            -ddw,
            (n * lean - slope * dw) / r,
            d_lean + (n * dw - slope * lean + turn * spin) / r,
        ],
        axis=1,
    )


def matrices(meridian: Meridian, structure: ShellStructure, order: int) -> tuple[Any, Any]:
    """Stiffness and mass of the free shell, sparse (freedom, freedom), N/m and kg and the like.

    Parameters
    ----------
    meridian : nodes
    structure : thickness and material
    order : circumferential order n
    """
    element, coordinate, area = _gauss_points(meridian, order)
    strain = strains(meridian, element, coordinate, order)
    shapes = displacement_shapes(meridian, element, coordinate)
    surface_mass = structure.density_kg_per_m3 * structure.thickness_m
    stiffness = np.einsum("p,pai,ab,pbj->pij", area, strain, _elasticity(structure), strain,
                          optimize=True)  # fmt: skip
    mass = surface_mass * np.einsum("p,pai,paj->pij", area, shapes, shapes, optimize=True)
    return _assembled(meridian, stiffness), _assembled(meridian, mass)


def squared_strains(meridian: Meridian, order: int, amplitudes: Array) -> Array:
    """Integrals of squared strains over the surface, shape (stretching or bending, part, motion).

    Those of the stretching are of ε_s² + ε_θ² + γ²/2 and of 2 ε_s ε_θ - γ²/2, which stiffness
    holds times Poisson's ratio; those of the bending likewise of the changes of curvature.

    Parameters
    ----------
    meridian : nodes
    order : circumferential order n
    amplitudes : amplitudes of the motions, shape (degree of freedom, motion)
    """
    element, coordinate, area = _gauss_points(meridian, order)
    of_element = amplitudes[element_dofs(meridian)][element]
    strained = np.einsum("pai,pim->apm", strains(meridian, element, coordinate, order), of_element)
    parts = []
    for along, around, shear in (strained[:3], strained[3:]):
        plain = along**2 + around**2 + 0.5 * shear**2
        coupled = 2.0 * along * around - 0.5 * shear**2
        parts.append([area @ plain, area @ coupled])
    return np.array(parts)


def _gauss_points(meridian: Meridian, order: int) -> tuple[IndexArray, Array, Array]:
    """Element, coordinate along it and weight by area of the points of integration."""
    coordinate, weight = np.tile(np.polynomial.legendre.leggauss(_GAUSS), meridian.elements)
    element = np.repeat(np.arange(meridian.elements), _GAUSS)
    around = 2.0 * np.pi if order == 0 else np.pi
    area = (
        around * weight * 0.5 * meridian.lengths[element] * _radius(meridian, element, coordinate)
    )
    return element, coordinate, area


def _radius(meridian: Meridian, element: IndexArray, coordinate: Array) -> Array:
    start, end = meridian.nodes[element, 0], meridian.nodes[element + 1, 0]
    return np.asarray(0.5 * ((1.0 - coordinate) * start + (1.0 + coordinate) * end))


def _elasticity(structure: ShellStructure) -> Array:
    """Forces and moments per unit length per strain and change of curvature, shape (6, 6)."""
    thickness, poisson = structure.thickness_m, structure.poisson_ratio
    plane: Array = np.array(
        [[1.0, poisson, 0.0], [poisson, 1.0, 0.0], [0.0, 0.0, (1.0 - poisson) / 2.0]]
    )
    stretching = structure.youngs_modulus_pa * thickness / (1.0 - poisson**2)
    return np.asarray(stretching * np.kron(np.diag([1.0, thickness**2 / 12.0]), plane))


def _assembled(meridian: Meridian, at_points: Array) -> Any:
    """Sum of the matrices (point, 12, 12) of all Gauss points, sparse."""
    by_element = at_points.reshape(meridian.elements, _GAUSS, 12, 12).sum(axis=1)
    dofs = element_dofs(meridian)
    rows, columns = (
        np.broadcast_to(part, by_element.shape) for part in (dofs[:, :, None], dofs[:, None])
    )
    indices = rows.ravel(), columns.ravel()
    return coo_matrix((by_element.ravel(), indices), (freedom_count(meridian),) * 2).tocsc()
