"""Green's functions in closed form. Time factor exp(+j omega t)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array, ComplexArray
from .box import Box, BoxField


@dataclass(frozen=True)
class Mirror:
    """An infinite wall across one axis; no two of a room are parallel.

    With a reflection factor below 1 the image is weaker by it, in every direction: the wall of a
    half space of heavier fluid with the same speed of sound. Walls that absorb by their local
    impedance reflect less at some angles than at others; a mirror is their mean.
    """

    axis: int
    sign: int
    """-1: the wall bounds the room below, 1: above."""
    position_m: float
    reflection: float = 1.0
    """Share of the pressure that comes back, 0 to 1."""

    @property
    def hard(self) -> bool:
        return self.reflection == 1.0

    def depth_m(self, points: Array) -> Array:
        """Distance of points (..., 3) from the wall, into the room, m."""
        return np.asarray(self.sign * (self.position_m - points[..., self.axis]))


def wavenumber(frequency_hz: Array) -> Array:
    """k = 2 pi f / c, rad/m."""
    return np.asarray(2 * np.pi * np.asarray(frequency_hz, dtype=float) / SPEED_OF_SOUND_M_PER_S)


def free_green(points: Array, source: Array, frequency_hz: Array) -> ComplexArray:
    """Free-field Green's function G = exp(-jkr)/(4 pi r), 1/m, (frequency, point).

    Points (point, 3) and source (3,) in m. Pierce, Acoustics (2019), section 4.3.
    """
    distance = np.linalg.norm(points - source, axis=-1)
    k = wavenumber(frequency_hz)[:, None]
    return np.asarray(np.exp(-1j * k * distance) / (4 * np.pi * distance))


def green(
    points: Array, source: Array, frequency_hz: Array, mirrors: Sequence[Mirror] = ()
) -> ComplexArray:
    """Green's function of a room of plane walls: the sum over the source's images, 1/m.

    Exact for hard walls at right angles to each other (Pierce, Acoustics (2019), section 5.1).
    """
    total = np.zeros((np.size(frequency_hz), points.shape[0]), dtype=complex)
    for position, strength in zip(*images(source, mirrors), strict=True):
        total += strength * free_green(points, position, frequency_hz)
    return total


def green_rows(
    points: Array, sources: Array, frequency_hz: Array, mirrors: Sequence[Mirror] = ()
) -> Iterator[ComplexArray]:
    """Green's functions of several sources (source, 3): (source, point), one frequency after the
    other.

    Equal steps of frequency turn each image's phase by equal angles: a product takes the place of
    an exponential.
    """
    distance, strength = (
        np.stack(each)
        for each in zip(
            *(_distances(points, *images(source, mirrors)) for source in sources), strict=True
        )
    )
    numbers = wavenumber(frequency_hz)
    steps = np.append(np.diff(numbers), np.nan)
    value = turn = np.zeros(0, dtype=complex)
    turned = np.nan
    for k, before, after in zip(numbers, np.append(np.nan, steps), steps, strict=False):
        if abs(before - turned) <= 1e-12 * k:
            value *= turn
        else:
            value = strength * np.exp(-1j * k * distance) / (4 * np.pi * distance)
            turn, turned = np.exp(-1j * np.nan_to_num(after) * distance), after
        yield value.sum(axis=1)


def _distances(points: Array, positions: Array, strengths: Array) -> tuple[Array, Array]:
    """Distances (image, point) of points from images, and their strengths (image, 1)."""
    distance = np.linalg.norm(points - positions[:, None], axis=-1)
    return distance, strengths[:, None]


def box_green(
    box: Box, source: Array, frequency_hz: Array, mirrors: Sequence[Mirror] = ()
) -> BoxField:
    """Green's function on both layers of a box."""
    return BoxField(
        green(box.inner, source, frequency_hz, mirrors),
        green(box.outer, source, frequency_hz, mirrors),
    )


def images(source: Array, mirrors: Sequence[Mirror]) -> tuple[Array, Array]:
    """A source (3,) and all of its images: positions (image, 3), m, and strengths (image,)."""
    positions: Array = np.asarray(source, dtype=float)[None, :]
    strengths: Array = np.ones(1)
    for mirror in mirrors:
        reflected = positions.copy()
        reflected[:, mirror.axis] = 2.0 * mirror.position_m - reflected[:, mirror.axis]
        positions = np.concatenate([positions, reflected])
        strengths = np.concatenate([strengths, mirror.reflection * strengths])
    return positions, strengths
