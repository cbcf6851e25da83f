"""The shell's middle surface as a chain of straight pieces, turned about the z axis."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, Final

import numpy as np
from scipy.spatial import cKDTree

from ...base.arrays import Array, IndexArray
from ...base.errors import ParameterError
from ...machine.shell import Shell
from ...machine.shell_structure import ShellStructure

ELEMENTS_PER_WAVELENGTH: Final = 10.0
"""Elements per wavelength of bending waves. Cubic shapes err by (k h)⁴ / 1440 of a frequency,
1e-4."""
_DOME_REFINEMENT: Final = 2.0
"""Straight pieces approach a curved meridian with the square of their length only."""
_LEAST_ELEMENTS: Final = 3
"""Least number of elements of each part of the meridian."""


@dataclass(frozen=True, eq=False)
class Meridian:
    """Conical elements from the bottom's middle up the wall to the top's middle.

    Attributes
    ----------
    nodes : radius and height of the middle surface, shape (node, 2), m
    round_nodes : nodes at which the section is kept round
    """

    nodes: Array
    round_nodes: tuple[int, ...] = ()

    @property
    def elements(self) -> int:
        return int(self.nodes.shape[0]) - 1

    @cached_property
    def lengths(self) -> Array:
        """Length of each element, m."""
        return np.asarray(np.linalg.norm(np.diff(self.nodes, axis=0), axis=1))

    @cached_property
    def tangents(self) -> Array:
        """Unit vectors (radius, height) along the elements; (t_z, -t_r) points outwards."""
        return np.asarray(np.diff(self.nodes, axis=0) / self.lengths[:, None])

    @property
    def wall_radius_m(self) -> float:
        return float(self.nodes[:, 0].max())

    @property
    def wall_heights_m(self) -> tuple[float, float]:
        """Lower and upper end of the wall."""
        wall = self.nodes[self.nodes[:, 0] >= self.wall_radius_m * (1.0 - 1e-9), 1]
        return float(wall.min()), float(wall.max())

    def locate(self, points: Array) -> tuple[IndexArray, Array]:
        """Element next to each place (point, 2) near the surface, and -1 to 1 along it.

        The closer one of the two elements at the nearest node counts.
        """
        return _located(self, np.ascontiguousarray(points, dtype=np.float64).tobytes())

    def _next_to(self, points: Array) -> tuple[IndexArray, Array]:
        _, node = self._tree.query(points)
        pairs = np.stack([np.maximum(node - 1, 0), np.minimum(node, self.elements - 1)])
        ahead = points - self.nodes[pairs]
        share = np.sum(ahead * self.tangents[pairs], axis=2) / self.lengths[pairs]
        share = np.clip(share, 0.0, 1.0)
        step = (share * self.lengths[pairs])[..., None] * self.tangents[pairs]
        after = np.sum((ahead - step) ** 2, axis=2)
        nearest = (after[1] < after[0]).astype(int)
        which = np.arange(nearest.size)
        return pairs[nearest, which], 2.0 * share[nearest, which] - 1.0

    @cached_property
    def _tree(self) -> Any:
        return cKDTree(self.nodes)


@lru_cache(maxsize=4)
def _located(meridian: Meridian, points: bytes) -> tuple[IndexArray, Array]:
    """`Meridian.locate`; kept, as all modes are asked for at the same places."""
    element, along = meridian._next_to(np.frombuffer(points).reshape(-1, 2))
    element.flags.writeable = along.flags.writeable = False
    return element, along


def bending_wavelength_m(structure: ShellStructure, frequency_hz: float) -> float:
    """Wavelength of bending waves on a flat plate of the wall's thickness."""
    modulus = structure.youngs_modulus_pa / (1.0 - structure.poisson_ratio**2)
    bending = modulus * structure.thickness_m**3 / 12.0
    mass = structure.density_kg_per_m3 * structure.thickness_m
    return float(2.0 * np.pi * (bending / mass / (2.0 * np.pi * frequency_hz) ** 2) ** 0.25)


def closed_meridian(shell: Shell, structure: ShellStructure, frequency_hz: float) -> Meridian:
    """Middle surface of the closed shell about the centre of mass, meshed for a frequency.

    Half a thickness inside the outer surface; flat caps, or half-ellipsoids.

    Raises
    ------
    ParameterError
        The thickness or the span does not fit into the shell, or it is no cylinder.
    """
    half, size = structure.thickness_m / 2.0, shell.cylinder
    radius, dome = size.radius_m - half, max(size.dome_height_m - half, 0.0)
    lower, upper = half + dome, size.height_m - half - dome
    if radius < 5.0 * structure.thickness_m or upper - lower < 5.0 * structure.thickness_m:
        raise ParameterError(
            f"thickness_mm = {2e3 * half:g} mm: wall of {2e3 * radius:g} mm diameter and "
            f"{1e3 * (upper - lower):g} mm height is no thin shell; at least ten and five "
            "thicknesses are needed"
        )
    wall = np.array([lower, *_span_ends(structure, lower, upper), upper])
    step = bending_wavelength_m(structure, frequency_hz) / ELEMENTS_PER_WAVELENGTH
    heights = _divided(wall, step)
    cap = _cap(radius, dome, step / _DOME_REFINEMENT if dome else step)
    nodes = np.concatenate(
        [
            np.stack([cap[:, 0], lower - cap[:, 1]], axis=1),
            np.stack([np.full(heights.size, radius), heights], axis=1)[1:-1],
            np.stack([cap[:, 0], upper + cap[:, 1]], axis=1)[::-1],
        ]
    )
    first = cap.shape[0] - 1
    ends = tuple(first + int(np.argmin(np.abs(heights - end))) for end in wall[1:-1])
    return Meridian(nodes - [0.0, shell.centre_of_mass_height_m], ends)


def _span_ends(structure: ShellStructure, lower: float, upper: float) -> tuple[float, ...]:
    """Heights at which the wall is kept round."""
    if structure.span_m is None:
        return ()
    if not structure.span_m < upper - lower:
        raise ParameterError(
            f"span_mm = {1e3 * structure.span_m:g} mm: must be below {1e3 * (upper - lower):g} mm, "
            "the height of the wall between the caps; leave it out where only the caps hold it"
        )
    middle = (lower + upper) / 2.0
    return middle - structure.span_m / 2.0, middle + structure.span_m / 2.0


def _divided(corners: Array, step: float) -> Array:
    """Coordinates from the first to the last corner, evenly divided between corners."""
    parts = [
        np.linspace(a, b, max(_LEAST_ELEMENTS, int(np.ceil((b - a) / step))) + 1)[1:]
        for a, b in pairwise(corners.tolist())
    ]
    return np.concatenate([corners[:1], *parts])


def _cap(radius: float, dome: float, step: float) -> Array:
    """Radius and rise above the wall's end, from the middle to the edge, shape (node, 2)."""
    fine = np.linspace(0.0, np.pi / 2.0, 2001)
    outline = np.stack([radius * np.sin(fine), dome * np.cos(fine)], axis=1)
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(outline, axis=0), axis=1))])
    angle = np.interp(_divided(arc[[0, -1]], step), arc, fine)
    angle[-1] = np.pi / 2.0
    return np.stack([radius * np.sin(angle), dome * np.cos(angle)], axis=1)
