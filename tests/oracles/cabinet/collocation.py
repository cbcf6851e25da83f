"""Boundary elements by collocation: constant pressure and velocity on flat quadrilaterals.

Time factor exp(+j omega t), lengths in m. Hard floor z = 0 and plane of symmetry y = 0 are images.

    p(x)/2 = sum over elements of [p dG/dn - G dp/dn],  G = exp(-jkR)/(4 pi R),  n into the air
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from scipy import linalg

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
Layers = tuple[Any, Any]
"""Integrals of G and of its normal slope over the elements, (point, element)."""

SPEED_OF_SOUND_M_PER_S: Final = 343.0
AIR_DENSITY_KG_PER_M3: Final = 1.2
IMAGES: Final = [np.array([1.0, y, z]) for y in (1.0, -1.0) for z in (1.0, -1.0)]
ROWS: Final = 48
"""Points at a time: what they need stays in the cache."""


@dataclass(frozen=True)
class Mesh:
    """Flat quadrilaterals on the half y > 0, corners anticlockwise seen from the air."""

    corners: Array
    """(element, 4, 3)."""
    moving: npt.NDArray[np.bool_]
    """Those of the machine."""

    @cached_property
    def normal(self) -> Array:
        """Into the air, (element, 3)."""
        first, second, third, fourth = self.corners.swapaxes(0, 1)
        across = np.cross(third - first, fourth - second)
        normal: Array = across / np.linalg.norm(across, axis=1, keepdims=True)
        return normal

    @cached_property
    def gauss(self) -> tuple[Array, Array]:
        """Two by two points (element, 4, 3), and the areas that they stand for (element, 4)."""
        node = 1.0 / np.sqrt(3.0)
        points, areas = [], []
        for u, v in ((-node, -node), (node, -node), (node, node), (-node, node)):
            low_u, high_u, low_v, high_v = (1 - u) / 2, (1 + u) / 2, (1 - v) / 2, (1 + v) / 2
            shape = [low_u * low_v, high_u * low_v, high_u * high_v, low_u * high_v]
            along = np.array([-low_v, low_v, high_v, -high_v]) / 2
            across = np.array([-low_u, -high_u, high_u, low_u]) / 2
            sides = [np.einsum("c,eci->ei", slope, self.corners) for slope in (along, across)]
            points.append(np.einsum("c,eci->ei", np.array(shape), self.corners))
            areas.append(np.einsum("ei,ei->e", np.cross(*sides), self.normal))
        return np.stack(points, axis=1), np.stack(areas, axis=1)

    def mean(self, values: Any) -> Any:
        """Over each element, of values at its Gauss points (element, 4, ...)."""
        areas = self.gauss[1]
        return np.einsum("eq,eq...->e...", areas / areas.sum(axis=1, keepdims=True), values)


def static(at: Array, mesh: Mesh) -> Layers:
    """Exact integrals for k = 0.

    Wilton et al., IEEE Trans. Antennas Propag. 32 (1984) 276; solid angle of two triangles by van
    Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
    """
    offset = [mesh.corners[:, corner] - at[:, None] for corner in range(4)]
    length = [np.linalg.norm(corner, axis=2) for corner in offset]
    single = np.zeros(length[0].shape)
    for first, second in ((0, 1), (1, 2), (2, 3), (3, 0)):
        edge = mesh.corners[:, second] - mesh.corners[:, first]
        size = np.linalg.norm(edge, axis=1)
        outward = np.cross(edge, mesh.normal) / np.maximum(size, 1e-12)[:, None]
        away = np.einsum("pei,ei->pe", offset[first], outward)
        both = length[first] + length[second]
        single += away * np.log((both + size) / np.maximum(both - size, 1e-15))
    angle = np.zeros(single.shape)
    for second, third in ((1, 2), (2, 3)):
        a, b, c = offset[0], offset[second], offset[third]
        la, lb, lc = length[0], length[second], length[third]
        triple = np.einsum("pei,pei->pe", a, np.cross(b, c))
        ab, bc, ca = (np.einsum("pei,pei->pe", *pair) for pair in ((a, b), (b, c), (c, a)))
        angle += 2.0 * np.arctan2(triple, la * lb * lc + ab * lc + bc * la + ca * lb)
    above = np.einsum("pei,ei->pe", offset[0], mesh.normal)
    angle[np.abs(above) < 1e-9] = 0.0  # in the element's own plane it fills no angle
    return (single - angle * above) / (4 * np.pi), -angle / (4 * np.pi)


def waves(at: Array, mesh: Mesh, k: float) -> Layers:
    """What exp(-jkR) adds to `static`: smooth, by Gauss points."""
    single, double = (np.zeros((len(at), len(mesh.normal)), dtype=complex) for _ in range(2))
    points, areas = mesh.gauss
    for point, area in zip(points.swapaxes(0, 1), areas.T / (4 * np.pi), strict=True):
        dx, dy, dz = (point[:, axis] - at[:, None, axis] for axis in range(3))
        away = dx * mesh.normal[:, 0] + dy * mesh.normal[:, 1] + dz * mesh.normal[:, 2]
        inverse = 1.0 / np.sqrt(dx * dx + dy * dy + dz * dz)
        half = (0.5 * k) / inverse
        sine, cosine = np.sin(half), np.cos(half)
        squared, product = 2.0 * sine * sine, 2.0 * sine * cosine  # 1 - cos kR, sin kR
        share, slope = area * inverse, area * away * inverse * inverse
        single.real -= share * squared
        single.imag -= share * product
        double.real += slope * (squared * inverse - k * product)
        double.imag += slope * (product * inverse - k * (1.0 - squared))
    return single, double


class Operators:
    """Layers of the elements and their images at points; the static part is computed once."""

    def __init__(self, points: Array, mesh: Mesh) -> None:
        self._blocks = [points[first : first + ROWS] for first in range(0, len(points), ROWS)]
        self.static = self._gather(lambda at: static(at, mesh))
        self._mesh = mesh

    def at(self, k: float) -> Layers:
        """For a wavenumber, 1/m."""
        single, double = self._gather(lambda at: waves(at, self._mesh, k))
        return self.static[0] + single, self.static[1] + double

    def _gather(self, layers: Callable[[Array], Layers]) -> Layers:
        """Sums over the images: the distance to an image is that of the mirrored point."""
        blocks = []
        for block in self._blocks:
            parts = [layers(block * image) for image in IMAGES]
            blocks.append([sum(part) for part in zip(*parts, strict=True)])
        single, double = (np.concatenate(part) for part in zip(*blocks, strict=True))
        return single, double


class Radiation:
    """Pressures at points of the air from the velocities of the elements.

    At points inside the solids the field must vanish (Schenck, J. Acoust. Soc. Am. 44 (1968) 41);
    all equations are solved by least squares.
    """

    def __init__(self, mesh: Mesh, inside: Array, air: Array) -> None:
        self._wall = Operators(np.concatenate([mesh.mean(mesh.gauss[0]), inside]), mesh)
        self._air = Operators(air, mesh)

    def pressures(self, velocity: ComplexArray, frequency_hz: float) -> ComplexArray:
        """Of normal velocities (element, pattern), m/s; Pa, (point, pattern)."""
        omega = 2 * np.pi * frequency_hz
        source = 1j * omega * AIR_DENSITY_KG_PER_M3 * velocity
        single, double = self._wall.at(omega / SPEED_OF_SOUND_M_PER_S)
        matrix = np.eye(*double.shape) / 2 - double
        right = (single @ source).conj().T
        turned, triangle = linalg.qr_multiply(matrix, right, mode="right", overwrite_a=True)
        pressure = linalg.solve_triangular(triangle, turned.conj().T)
        single, double = self._air.at(omega / SPEED_OF_SOUND_M_PER_S)
        result: ComplexArray = double @ pressure + single @ source
        return result
