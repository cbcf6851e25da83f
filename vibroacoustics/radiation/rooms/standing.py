"""Position of a machine in a room: the box around it, and its body among the room's blocks."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ...base.errors import ParameterError
from ...base.revolution import Profile
from ...machine.shell import Shell
from ..arrays import Array
from .cutting import cut
from .room import Block, Room

_MARGIN_M: Final = 0.1
"""Margin from the body to the box around it where nothing is in the way, else half the gap."""
LEAST_GAP_M: Final = 0.03
"""Distance between the body and objects beside it."""
_SAME_LEVEL_M: Final = 1e-6
_SIDES: Final = ((0, 0), (0, 1), (1, 0), (1, 1), (2, 1))
"""Axis and end of the box's sides but the lowest."""


@dataclass(frozen=True)
class Standing:
    """A machine in its room, in the room's coordinates."""

    room: Room
    """Room with the machine's body as a block, if it fits."""
    foot_m: Array
    """Foot of the machine's axis, (3,)."""
    lower: Array
    """Corner of the box around the machine, (3,)."""
    upper: Array
    clearance_m: float
    """Distance from the body to the nearest side of the box."""
    body_in_room: str
    """Words for the body among the room's blocks."""


def standing(
    shell: Shell, profile: Profile, room: Room, foot_m: Array, spacing_m: float
) -> Standing:
    """The machine with its foot at a point of the floor or on a block."""
    foot_m = np.asarray(foot_m, dtype=float)
    radius_m, height_m = profile.radius_m, profile.top_z_m - shell.floor_z_m
    lower = foot_m - np.array([radius_m, radius_m, 0.0])
    upper = foot_m + np.array([radius_m, radius_m, height_m])
    gaps = _gaps(room, lower, upper)
    margins = {side: min(_MARGIN_M, gap / 2.0) for side, gap in gaps.items()}
    for (axis, end), margin in margins.items():
        (upper if end else lower)[axis] += margin if end else -margin
    side_m = float(np.sqrt(profile.volume_m3 / profile.height_m))
    half = np.array([side_m / 2.0, side_m / 2.0, 0.0])
    block = Block("body of the machine", _point(foot_m - half), _point(foot_m + half, height_m))
    with_body, of_body = _with_body(room, block, spacing_m)
    return Standing(with_body, foot_m, lower, upper, min(margins.values()), of_body)


def check_listeners(standing: Standing, listeners: Mapping[str, Array]) -> None:
    """Refuse listeners in the box around the machine."""
    for name, position in listeners.items():
        if np.all((position > standing.lower) & (position < standing.upper)):
            raise ParameterError(
                f"room.listeners.{name}: stands within {1e3 * standing.clearance_m:.0f} mm of the "
                f"machine, in the box where its sound is handed to the room"
            )


def _point(point: Array, more_z_m: float = 0.0) -> tuple[float, float, float]:
    return float(point[0]), float(point[1]), float(point[2]) + more_z_m


def _with_body(room: Room, block: Block, spacing_m: float) -> tuple[Room, str]:
    """The room with the body's block, or without it where the air beside it is too thin."""
    with_body = replace(room, blocks=(*room.blocks, block))
    size = np.subtract(block.upper, block.lower)
    try:
        cut(with_body, spacing_m)
    except ParameterError:
        return room, "left out: the air beside it is too thin to be computed"
    x, y, z = (1e3 * float(edge) for edge in size)
    return with_body, f"hard cuboid of its volume and height, {x:.0f} x {y:.0f} x {z:.0f} mm"


def _gaps(room: Room, lower: Array, upper: Array) -> dict[tuple[int, int], float]:
    """Air between the body's bounds and what stands in the way, by axis and end; not downwards.

    On a block the box must not reach beyond its top.
    """
    limits = [np.zeros(3), np.array(room.size_m)]
    for block in _beside(room, lower, upper):
        axis, end = _between(block, lower, upper)
        edge = block.lower[axis] if end else block.upper[axis]
        limits[end][axis] = (min if end else max)(limits[end][axis], edge)
    below = _support(room, lower, upper)
    if below is not None:
        limits[0][:2] = np.maximum(limits[0][:2], below.lower[:2])
        limits[1][:2] = np.minimum(limits[1][:2], below.upper[:2])
    gaps = {}
    for axis, end in _SIDES:
        gap = float(limits[1][axis] - upper[axis] if end else lower[axis] - limits[0][axis])
        if gap < LEAST_GAP_M - 1e-9:
            raise ParameterError(
                f"room.foot_mm: leaves {1e3 * gap:.4g} mm between the machine and what bounds it "
                f"towards {'-+'[end]}{'xyz'[axis]}; needed at least {1e3 * LEAST_GAP_M:g} mm"
            )
        gaps[axis, end] = gap
    return gaps


def _support(room: Room, lower: Array, upper: Array) -> Block | None:
    """The block whose top the machine stands on; None for the room's floor."""
    middle, foot_z_m = (lower + upper) / 2.0, float(lower[2])
    if abs(foot_z_m) <= _SAME_LEVEL_M:
        return None
    for block in room.blocks:
        under = np.all((middle[:2] > block.lower[:2]) & (middle[:2] < block.upper[:2]))
        if under and abs(block.upper[2] - foot_z_m) <= _SAME_LEVEL_M:
            return block
    raise ParameterError(
        f"room.foot_mm: its foot is at a height of {1e3 * foot_z_m:.4g} mm: must be on the floor, "
        f"0 mm, or on the top of a block below it"
    )


def _beside(room: Room, lower: Array, upper: Array) -> Iterator[Block]:
    """Blocks that reach above the foot and may be in the way of the box."""
    margin = 2.0 * _MARGIN_M
    low, high = lower - [margin, margin, -_SAME_LEVEL_M], upper + margin
    for block in room.blocks:
        if np.all((high > block.lower) & (low < block.upper)):
            yield block


def _between(block: Block, lower: Array, upper: Array) -> tuple[int, int]:
    """Axis and end of the body where a block leaves the widest gap."""
    away = {
        (axis, end): float(
            block.lower[axis] - upper[axis] if end else lower[axis] - block.upper[axis]
        )
        for axis, end in _SIDES
    }
    side = max(away, key=lambda name: away[name])
    if away[side] < 0.0:
        raise ParameterError(f"room.foot_mm: meets room.furniture.{block.name}")
    return side
