"""Size of the echo that walls beyond the machine side's grid send back to the body.

The machine side scatters the echo of near walls exactly and neglects what the body scatters of
the others' echo. Monopoles inside the body estimate it: they are fitted to the surface's velocity
with the near walls' images, then to the velocity that the images in the other walls bring there.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.linalg import qr, solve_triangular

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from ..base.vocabulary import RIGID_BODY_DOFS
from .arrays import Array, ComplexArray
from .bodies import Body, block
from .exact import Mirror, images, wavenumber
from .patterns import Pattern, rigid_body
from .scene import Scene
from .surface_points import surface_in_parts

SAFETY: Final = 1.8
"""Stated error over the estimated echo."""
_FEWEST_POINTS: Final = 300
_MOST_POINTS: Final = 900
_POINTS_PER_WAVE: Final = 3.0
_POINTS_PER_MONOPOLE: Final = 3.0
_DEPTH: Final = 1.2
"""Depth of the monopoles over the body's volume per surface: 0.4 of the radius of a sphere."""
_ON_WALL_M: Final = 1e-5
_TINY: Final = float(np.finfo(float).tiny)


def neglected_echo(
    scene: Scene, patterns: Sequence[Pattern], frequency_hz: Array, points: Array
) -> Array:
    """Estimate the neglected echo at points, over the largest pressure at any of them.

    For a cabinet it is that of a block of its size, the largest of the three translations.

    Parameters
    ----------
    scene : body, walls and surroundings
    patterns : surface velocities of the machine
    frequency_hz : shape (frequency,)
    points : microphones, shape (point, 3), m

    Returns
    -------
    share, shape (point, pattern, frequency); 0 where every wall is near
    """
    if len(scene.near_walls) == len(scene.walls):
        return np.zeros((points.shape[0], len(patterns), frequency_hz.size))
    if not scene.panels:
        return _shares(scene, scene.machine, patterns, frequency_hz, points)
    translations = [rigid_body(dof) for dof in RIGID_BODY_DOFS[:3]]
    outline = block(*scene.body.bounds())
    shares = _shares(scene, outline, translations, frequency_hz, points)
    return np.repeat(shares.max(axis=1, keepdims=True), len(patterns), axis=1)


def _shares(
    scene: Scene, body: Body, patterns: Sequence[Pattern], frequency_hz: Array, points: Array
) -> Array:
    """See `neglected_echo`; above the frequency of three points a wave, the share there."""
    area = float(np.linalg.norm(body.area_vectors(), axis=1).sum())
    shortest = SPEED_OF_SOUND_M_PER_S / (_POINTS_PER_WAVE * frequency_hz.max())
    spacing = np.clip(shortest, np.sqrt(area / _MOST_POINTS), np.sqrt(area / _FEWEST_POINTS))
    surface = _patches(scene, body, patterns, spacing)
    coarse = _patches(scene, body, (), spacing * np.sqrt(_POINTS_PER_MONOPOLE))
    volume = float(np.einsum("fi,fi->", body.triangles[:, 0], body.area_vectors()) / 3.0)
    monopoles = coarse.position - _DEPTH * volume / area * coarse.normal
    others = [wall for wall in scene.walls if wall not in scene.near_walls]
    near = _Slopes(surface, monopoles, (*scene.near_walls, *others), len(scene.near_walls))
    highest = SPEED_OF_SOUND_M_PER_S / (_POINTS_PER_WAVE * spacing)
    resolved = np.minimum(frequency_hz, highest)
    shares = np.zeros((points.shape[0], len(patterns), frequency_hz.size))
    greens = scene.green_rows(monopoles, points, resolved)
    for number, (k, green) in enumerate(zip(wavenumber(resolved), greens, strict=True)):
        radiated, scattered = near.strengths(k)
        largest = np.abs(green @ radiated).max(axis=0)
        shares[:, :, number] = np.abs(green @ scattered) / np.maximum(largest, _TINY)
    return shares


@dataclass(frozen=True)
class _Patches:
    """Pieces of a surface of about the same size."""

    position: Array
    """(patch, 3), m."""
    normal: Array
    """Unit normals out of the body, (patch, 3)."""
    area: Array
    """(patch,), m²."""
    velocity: Array
    """Mean normal velocity of each pattern, (patch, pattern), m/s."""


def _patches(scene: Scene, body: Body, patterns: Sequence[Pattern], spacing_m: float) -> _Patches:
    """Pieces of the surface in cubes of a spacing, apart where they face other ways.

    Those that stand on a wall move nothing.
    """
    lower, upper = body.bounds()
    planes = [
        np.arange(low, high + 2.0 * spacing_m, spacing_m)
        for low, high in zip(lower, upper, strict=True)
    ]
    keys, rows = [], []
    for points in surface_in_parts(body, (planes[0], planes[1], planes[2])):
        off_walls = [wall.depth_m(points.position) > _ON_WALL_M for wall in scene.walls]
        part = points.where([points.area > 0.0, *off_walls])
        velocity = [
            np.einsum("pi,pi->p", pattern.velocity(part), part.normal) for pattern in patterns
        ]
        cube = np.floor((part.position - lower) / spacing_m)
        keys.append(np.hstack([cube, np.rint(part.normal)]).astype(np.intp))
        values = np.column_stack([np.ones_like(part.area), part.position, part.normal, *velocity])
        rows.append(part.area[:, None] * values)
    _, which = np.unique(np.concatenate(keys), axis=0, return_inverse=True)
    sums = np.zeros((which.max() + 1, 7 + len(patterns)))
    np.add.at(sums, which.ravel(), np.concatenate(rows))
    area, means = sums[:, 0], sums[:, 1:] / sums[:, :1]
    normal = means[:, 3:6] / np.linalg.norm(means[:, 3:6], axis=1, keepdims=True)
    return _Patches(means[:, :3], normal, area, means[:, 6:])


class _Slopes:
    """Normal velocity that monopoles and their images bring to a surface."""

    def __init__(
        self, surface: _Patches, monopoles: Array, walls: Sequence[Mirror], near: int
    ) -> None:
        """Walls begin with the `near` ones, and so do the images."""
        placed = [images(monopole, walls) for monopole in monopoles]
        position = np.stack([image[0] for image in placed], axis=1)
        self._strength = placed[0][1][:, None, None]
        offset = surface.position[:, None] - position[:, None]
        self._distance = np.linalg.norm(offset, axis=-1)
        self._cosine = np.einsum("ipmx,px->ipm", offset, surface.normal) / self._distance
        self._near = 2**near
        self._weight = np.sqrt(surface.area)[:, None]
        self._velocity = self._weight * surface.velocity

    def strengths(self, k: float) -> tuple[ComplexArray, ComplexArray]:
        """Volume velocities that radiate, and those that scatter the echo, (monopole, pattern).

        Parameters
        ----------
        k : wavenumber, rad/m
        """
        phase = (1.0 + 1j * k * self._distance) * np.exp(-1j * k * self._distance)
        slopes = self._strength * self._cosine * phase / (4.0 * np.pi * self._distance**2)
        slopes *= self._weight
        near, far = slopes[: self._near].sum(axis=0), slopes[self._near :].sum(axis=0)
        basis, triangle = qr(near, mode="economic")
        radiated = solve_triangular(triangle, basis.conj().T @ self._velocity)
        scattered = solve_triangular(triangle, basis.conj().T @ (-far @ radiated))
        return radiated, scattered
