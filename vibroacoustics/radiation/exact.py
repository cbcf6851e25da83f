"""Green's functions in closed form. Time factor exp(+j omega t)."""

from collections.abc import Iterator, Sequence

import numpy as np

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array, ComplexArray
from .box import Box, BoxField
from .mirrors import Mirror, images


def wavenumber(frequency_hz: Array) -> Array:
    """k = 2 pi f / c, rad/m."""
    number: Array = 2 * np.pi * np.asarray(frequency_hz, dtype=float) / SPEED_OF_SOUND_M_PER_S
    return number


def free_green(points: Array, source: Array, frequency_hz: Array) -> ComplexArray:
    """Free-field Green's function G = exp(-jkr)/(4 pi r), 1/m, (frequency, point).

    Points (point, 3) and source (3,) in m. Pierce, Acoustics (2019), section 4.3.
    """
    distance = np.linalg.norm(points - source, axis=-1)
    k = wavenumber(frequency_hz)[:, None]
    value: ComplexArray = np.exp(-1j * k * distance) / (4 * np.pi * distance)
    return value


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
    """The same of several sources (source, 3): (source, point), one frequency after the other.

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
