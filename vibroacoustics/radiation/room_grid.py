"""The k-Wave grid around one microphone and the box."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..constants import SPEED_OF_SOUND_M_PER_S
from .arrays import Array
from .band_limited import STENCIL_NODES
from .box import Box

COURANT_NUMBER: Final = 0.6
"""Time steps do not limit accuracy here: in a uniform medium k-Wave's scheme is exact for any step.

Measured: 0.3, 0.5 and 0.7 give the same Green's function within 3e-4 of its largest value.
"""
PML_NODES: Final = 20
PML_ALPHA: Final = 2.0
_SOURCE_MARGIN_NODES: Final = 3
"""Nodes between a source and the absorbing layer; the box has half an interpolation stencil."""


@dataclass(frozen=True)
class RoomGrid:
    """Cubic k-Wave grid with the microphone, and the image of it, on nodes."""

    spacing_m: float
    origin: Array
    """First node, m."""
    shape: tuple[int, int, int]
    source_nodes: tuple[tuple[int, int, int], ...]
    """Microphone and, above a floor, its mirror image; once, if it lies on the floor."""
    source_strength: float
    """2 for a microphone on the floor, where source and image coincide; else 1."""
    block: tuple[slice, slice, slice]
    """Nodes around the box that are recorded."""

    @property
    def time_step_s(self) -> float:
        return COURANT_NUMBER * self.spacing_m / SPEED_OF_SOUND_M_PER_S

    @property
    def block_origin(self) -> Array:
        start = np.array([part.start for part in self.block])
        first: Array = self.origin + self.spacing_m * start
        return first


def room_grid(
    microphone: Array,
    box: Box,
    largest_spacing_m: float,
    floor_z_m: float | None,
) -> RoomGrid:
    """Smallest grid that holds microphone, image, box, margins and absorbing layers.

    Above a floor the spacing shrinks until the microphone's height is a whole number of spacings;
    then floor, microphone and image all lie on node planes.
    """
    height = 0.0 if floor_z_m is None else float(microphone[2]) - floor_z_m
    intervals = int(np.ceil(height / largest_spacing_m - 1e-9))
    spacing = height / intervals if intervals else largest_spacing_m
    sources = [microphone]
    if intervals:
        sources.append(microphone - np.array([0.0, 0.0, 2.0 * height]))
    box_lower, box_upper = box.outer.min(axis=0), box.outer.max(axis=0)
    stencil, margin = STENCIL_NODES // 2 * spacing, _SOURCE_MARGIN_NODES * spacing
    lower = np.minimum(box_lower - stencil, np.min(sources, axis=0) - margin)
    upper = np.maximum(box_upper + stencil, np.max(sources, axis=0) + margin)
    # Nodes are counted from the microphone.
    first = np.floor((lower - microphone) / spacing + 1e-9).astype(int) - PML_NODES
    last = np.ceil((upper - microphone) / spacing - 1e-9).astype(int) + PML_NODES
    shape = [next_fast_length(int(count)) for count in last - first + 1]
    origin = microphone + spacing * first
    return RoomGrid(
        spacing_m=spacing,
        origin=origin,
        shape=(shape[0], shape[1], shape[2]),
        source_nodes=tuple(_node(source, origin, spacing) for source in sources),
        source_strength=2.0 if floor_z_m is not None and not intervals else 1.0,
        block=_block(box_lower, box_upper, origin, spacing),
    )


def next_fast_length(length: int) -> int:
    """Smallest 2^a 3^b 5^c that is not below a length."""
    candidate = length
    while True:
        rest = candidate
        for prime in (2, 3, 5):
            while rest % prime == 0:
                rest //= prime
        if rest == 1:
            return candidate
        candidate += 1


def _node(point: Array, origin: Array, spacing: float) -> tuple[int, int, int]:
    first, second, third = np.rint((point - origin) / spacing).astype(int)
    return int(first), int(second), int(third)


def _block(lower: Array, upper: Array, origin: Array, spacing: float) -> tuple[slice, slice, slice]:
    start = np.floor((lower - origin) / spacing).astype(int) - (STENCIL_NODES // 2 - 1)
    stop = np.floor((upper - origin) / spacing).astype(int) + STENCIL_NODES // 2 + 1
    first, second, third = (slice(int(a), int(b)) for a, b in zip(start, stop, strict=True))
    return first, second, third
