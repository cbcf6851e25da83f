"""Single and double layer of a meridian's elements at any points, by Fourier orders.

Far from an element its nodes are a quadrature rule. Near it, finer rules carry the element's
polynomials: nodes crowd at the point, where it lies on the element, and s = s0 + d sinh(u) takes
the place of the local coordinate where it lies a distance d beside it.
"""

from functools import cache
from typing import Any, Final, NamedTuple

import numba
import numpy as np
from numpy.polynomial import legendre

from ..arrays import Array, ComplexArray
from .mesh import NODES, Mesh
from .ring import DIGITS, ring, rules

_NEAR: Final = 1.3
"""A point this many lengths of an element off its middle sees its nodes alone."""
_ON_POINTS: Final = 12
"""Points on each side of a point of the element."""
_BESIDE_POINTS: Final = 20
_CROWDING: Final = 4
"""Power by which nodes crowd at a point of the element."""
_ON: Final = 1e-9
"""A point closer than this many lengths lies on the element."""


class _Element(NamedTuple):
    """Rules along an element and its polynomials."""

    on_local: Array
    on_weights: Array
    beside_local: Array
    beside_weights: Array
    lagrange: Array
    """Powers of the local coordinate in each node's polynomial, (node, power)."""


@cache
def _element() -> _Element:
    local, _ = legendre.leggauss(NODES)
    lagrange = np.linalg.inv(np.vander(local, increasing=True)).T
    on, beside = (legendre.leggauss(number) for number in (_ON_POINTS, _BESIDE_POINTS))
    share = (1.0 + on[0]) / 2.0
    return _Element(
        share**_CROWDING,
        _CROWDING * share ** (_CROWDING - 1) * on[1] / 2.0,
        *beside,
        np.ascontiguousarray(lagrange),
    )


def layers(
    mesh: Mesh, points: Array, wavenumber: float, orders: int, floor_z_m: float | None = None
) -> tuple[ComplexArray, ComplexArray]:
    """Integrals of G and of its normal derivative over each node's polynomial.

    Points (point, 2) are radius and height, m; on a floor G holds the image. Results
    (order, point, node), m and 1, for a velocity or pressure cos(n t) seen at t = 0.
    """
    shape = (orders, len(points), len(mesh.points))
    single, double = np.zeros(shape, dtype=complex), np.zeros(shape, dtype=complex)
    sources = np.concatenate([mesh.points, mesh.normals], axis=1)
    sides = [points]
    if floor_z_m is not None:
        sides.append(np.stack([points[:, 0], 2.0 * floor_z_m - points[:, 1]], axis=1))
    elements = (mesh.weights, mesh.lengths, mesh.coefficients)
    quadrature = (wavenumber, DIGITS, rules(orders), _element())
    for side in sides:
        field_points = np.ascontiguousarray(side, dtype=float)
        _fill(field_points, sources, elements, quadrature, single, double)
    return single, double


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _fill(
    points: Any, sources: Any, elements: Any, quadrature: Any, single: Any, double: Any
) -> None:  # pragma: no cover
    """Add the layers of one side of the floor."""
    (weights, lengths, coefficients), (k, digits, rules, element) = elements, quadrature
    nodes = element.lagrange.shape[0]
    field = np.empty((4, single.shape[0]))
    near = np.empty((nodes, 4, single.shape[0]))
    for row in range(points.shape[0]):
        radius, height = points[row]
        for number in range(lengths.size):
            begin = number * nodes
            middle = coefficients[number, :, 0]
            away = np.hypot(middle[0] - radius, middle[1] - height)
            if away < _NEAR * lengths[number]:
                curve, length = coefficients[number], lengths[number]
                _near((radius, height), curve, length, quadrature, field, near)
                for node in range(nodes):
                    _put(near[node], 1.0, row, begin + node, single, double)
                continue
            for node in range(begin, begin + nodes):
                ring(radius, height, sources[node], k, digits, rules, field)
                _put(field, weights[node], row, node, single, double)


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _put(
    field: Any, weight: float, row: int, column: int, single: Any, double: Any
) -> None:  # pragma: no cover
    for order in range(single.shape[0]):
        single[order, row, column] += weight * complex(field[0, order], field[1, order])
        double[order, row, column] += weight * complex(field[2, order], field[3, order])


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _near(
    point: Any, curve: Any, length: float, quadrature: Any, field: Any, near: Any
) -> None:  # pragma: no cover
    """Layers of one element at a point next to it, (node, real and imaginary of each, order)."""
    near[:] = 0.0
    element = quadrature[3]
    closest, distance = _closest(point[0], point[1], curve)
    if distance < _ON * length:
        for side in (-1.0, 1.0):
            reach = 1.0 - side * closest
            for q in range(element.on_local.size):
                local = closest + side * reach * element.on_local[q]
                weight = reach * element.on_weights[q]
                _add(point, curve, local, weight, quadrature, field, near)
        return
    scale = 2.0 * distance / length
    low, high = np.arcsinh((-1.0 - closest) / scale), np.arcsinh((1.0 - closest) / scale)
    for q in range(element.beside_local.size):
        stretched = 0.5 * (low + high) + 0.5 * (high - low) * element.beside_local[q]
        local = closest + scale * np.sinh(stretched)
        weight = 0.5 * (high - low) * scale * np.cosh(stretched) * element.beside_weights[q]
        _add(point, curve, local, weight, quadrature, field, near)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _add(
    point: Any, curve: Any, local: float, weight: float, quadrature: Any, field: Any, near: Any
) -> None:  # pragma: no cover
    """Add one point of a rule along an element."""
    k, digits, rules, element = quadrature
    r, z, dr, dz = _on_curve(curve, local)
    speed = np.hypot(dr, dz)
    ring(point[0], point[1], (r, z, dz / speed, -dr / speed), k, digits, rules, field)
    for node in range(near.shape[0]):
        share = 0.0
        for power in range(near.shape[0] - 1, -1, -1):
            share = share * local + element.lagrange[node, power]
        share *= weight * speed
        for part in range(4):
            for order in range(field.shape[1]):
                near[node, part, order] += share * field[part, order]


@numba.njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _on_curve(curve: Any, local: float) -> Any:  # pragma: no cover
    """Radius, height and their slopes at a local coordinate."""
    r = z = dr = dz = 0.0
    for power in range(curve.shape[1] - 1, -1, -1):
        dr, dz = dr * local + r, dz * local + z
        r, z = r * local + curve[0, power], z * local + curve[1, power]
    return r, z, dr, dz


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _closest(radius: float, height: float, curve: Any) -> Any:  # pragma: no cover
    """Local coordinate of the element's point closest to a point, and its distance, m."""
    best, least = 0.0, np.inf
    for step in range(9):
        local = -1.0 + step / 4.0
        r, z, _, _ = _on_curve(curve, local)
        squared = (r - radius) ** 2 + (z - height) ** 2
        if squared < least:
            best, least = local, squared
    for _ in range(6):
        r, z, dr, dz = _on_curve(curve, best)
        step = ((radius - r) * dr + (height - z) * dz) / (dr * dr + dz * dz)
        best = min(max(best + step, -1.0), 1.0)
    r, z, _, _ = _on_curve(curve, best)
    return best, np.hypot(r - radius, z - height)
