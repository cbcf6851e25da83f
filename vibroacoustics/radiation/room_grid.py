"""The k-Wave grid around one microphone, its mirror images and the box."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array
from .band_limited import STENCIL_NODES
from .box import Box
from .exact import Mirror, images

COURANT_NUMBER: Final = 0.6
"""Time steps do not limit accuracy here: in a uniform medium k-Wave's scheme is exact for any step.

Measured: 0.3, 0.5 and 0.7 give the same Green's function within 3e-4 of its largest value.
"""
PML_NODES: Final = 26
"""Nodes of the absorbing layers: with 20, their echo at 25 Hz changes a rocking body's level by 0.1
dB."""
PML_ALPHA: Final = 2.0
_SOURCE_MARGIN_NODES: Final = 3
"""Nodes between a source and the absorbing layer; the box has half an interpolation stencil."""

Node = tuple[int, int, int]


@dataclass(frozen=True)
class RoomGrid:
    """k-Wave grid with the microphone, and all images of it, on nodes."""

    spacing_m: Array
    """(3,), one for each axis."""
    origin: Array
    """First node, m."""
    shape: Node
    source_nodes: tuple[Node, ...]
    """Microphone and images; those that coincide, as on a wall, count once."""
    source_strengths: Array
    """(source,), the reflection factors of the way; 2 on a hard wall."""
    block: tuple[slice, slice, slice]
    """Nodes around the box that are recorded."""

    @property
    def time_step_s(self) -> float:
        """Time step for the finest axis."""
        return COURANT_NUMBER * float(self.spacing_m.min()) / SPEED_OF_SOUND_M_PER_S

    @property
    def block_shape(self) -> Node:
        """Numbers of recorded nodes."""
        first, second, third = (part.stop - part.start for part in self.block)
        return first, second, third

    @property
    def block_origin(self) -> Array:
        """First recorded node, m."""
        start = np.array([part.start for part in self.block])
        return np.asarray(self.origin + self.spacing_m * start)

    @property
    def sources(self) -> Array:
        """Positions of the microphone and its images, m, (source, 3)."""
        return np.asarray(self.origin + self.spacing_m * np.array(self.source_nodes))


def room_grid(
    microphone: Array, box: Box, largest_spacing_m: float, mirrors: Sequence[Mirror] = ()
) -> RoomGrid:
    """Smallest grid that holds microphone, images, box, margins and absorbing layers."""
    spacing = _spacing(microphone, largest_spacing_m, mirrors)
    positions, strengths = images(microphone, mirrors)
    positions = positions[strengths != 0]
    strengths = strengths[strengths != 0]
    box_lower, box_upper = box.outer.min(axis=0), box.outer.max(axis=0)
    stencil, margin = STENCIL_NODES // 2 * spacing, _SOURCE_MARGIN_NODES * spacing
    lower = np.minimum(box_lower - stencil, positions.min(axis=0) - margin)
    upper = np.maximum(box_upper + stencil, positions.max(axis=0) + margin)
    # Nodes are counted from the microphone.
    first = np.floor((lower - microphone) / spacing + 1e-9).astype(int) - PML_NODES
    last = np.ceil((upper - microphone) / spacing - 1e-9).astype(int) + PML_NODES
    shape = [next_fast_length(int(count)) for count in last - first + 1]
    origin = microphone + spacing * first
    nodes, sums = _merged(np.rint((positions - origin) / spacing).astype(int), strengths)
    return RoomGrid(
        spacing_m=spacing,
        origin=origin,
        shape=(shape[0], shape[1], shape[2]),
        source_nodes=nodes,
        source_strengths=sums,
        block=_block(box_lower, box_upper, origin, spacing),
    )


def next_fast_length(length: int) -> int:
    """Smallest 2^a 3^b 5^c that is not below a length."""
    candidate = length
    while True:
        quotient = candidate
        for prime in (2, 3, 5):
            while quotient % prime == 0:
                quotient //= prime
        if quotient == 1:
            return candidate
        candidate += 1


def _spacing(microphone: Array, largest_spacing_m: float, mirrors: Sequence[Mirror]) -> Array:
    """Spacing of each axis, (3,), the largest that puts wall and image on nodes.

    The microphone's distance from the wall is a whole number of spacings. The discrete equations
    are then symmetric about the wall.
    """
    spacing = np.full(3, largest_spacing_m)
    for mirror in mirrors:
        distance = abs(float(mirror.depth_m(microphone)))
        intervals = int(np.ceil(distance / largest_spacing_m - 1e-9))
        if intervals:
            spacing[mirror.axis] = distance / intervals
    return spacing


def _merged(nodes: Array, strengths: Array) -> tuple[tuple[Node, ...], Array]:
    """Each node once, in the order of memory (which k-Wave expects), with its strengths' sum."""
    distinct, index = np.unique(nodes, axis=0, return_inverse=True)
    sums = np.zeros(len(distinct))
    np.add.at(sums, index.ravel(), strengths)
    return tuple((int(x), int(y), int(z)) for x, y, z in distinct), sums


def _block(lower: Array, upper: Array, origin: Array, spacing: Array) -> tuple[slice, slice, slice]:
    start = np.floor((lower - origin) / spacing).astype(int) - (STENCIL_NODES // 2 - 1)
    stop = np.floor((upper - origin) / spacing).astype(int) + STENCIL_NODES // 2 + 1
    first, second, third = (slice(int(a), int(b)) for a, b in zip(start, stop, strict=True))
    return first, second, third
