"""Parts that tests of the radiation share: a hard floor, a pattern by its normal velocity."""

from collections.abc import Callable, Sequence

import numpy as np

from vibroacoustics.radiation.arrays import Array, ComplexArray
from vibroacoustics.radiation.bodies import Body
from vibroacoustics.radiation.box import Box, BoxField
from vibroacoustics.radiation.exact import Mirror
from vibroacoustics.radiation.patterns import Pattern


def floor(position_z_m: float) -> Mirror:
    """Hard floor at a height."""
    return Mirror(axis=2, sign=-1, position_m=position_z_m)


def normal_velocity(name: str, velocity: Callable[[Array], Array]) -> Pattern:
    """Pattern of a normal velocity (point,) given as a function of points (point, 3)."""
    return Pattern(name, lambda at: velocity(at.position)[:, None] * at.normal)


def join(box: Box, near: BoxField, green: BoxField) -> ComplexArray:
    """The integral of `radiation.join` over a box as it is written, (frequency,)."""
    pressure: ComplexArray = (near.inner * green.outer - near.outer * green.inner) @ box.weights
    return pressure


def revolved(
    outline: Sequence[tuple[float, float]], bottom_m: float, top_m: float, sections: int = 96
) -> Body:
    """Body of revolution: its outline (radius, height) between two points on the axis, upwards."""
    turn = 2.0 * np.pi * np.arange(sections) / sections
    rings = [(r * np.cos(a), r * np.sin(a), z) for r, z in outline for a in turn]
    vertices = np.array([(0.0, 0.0, bottom_m), *rings, (0.0, 0.0, top_m)])
    this = np.arange(sections)
    other = (this + 1) % sections
    first, last = np.zeros(sections, dtype=int), np.full(sections, len(rings) + 1)
    faces = [np.stack([first, 1 + other, 1 + this], axis=1)]
    for ring in range(len(outline) - 1):
        low, high = 1 + ring * sections, 1 + (ring + 1) * sections
        faces.append(np.stack([low + this, low + other, high + this], axis=1))
        faces.append(np.stack([low + other, high + other, high + this], axis=1))
    top = 1 + (len(outline) - 1) * sections
    faces.append(np.stack([last, top + this, top + other], axis=1))
    return Body(vertices, np.concatenate(faces))
