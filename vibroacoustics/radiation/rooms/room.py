"""A room: a box of air with blocks left out of it, and what covers its walls."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

from ...base.errors import ParameterError
from ...study.room import RoomSide
from ..arrays import Array

SIDES: Final[dict[RoomSide, tuple[int, int]]] = {
    "-x": (0, 0),
    "+x": (0, 1),
    "-y": (1, 0),
    "+y": (1, 1),
    "floor": (2, 0),
    "ceiling": (2, 1),
}
"""Axis of each side, and 0 for its lower or 1 for its upper end."""
Point = tuple[float, float, float]
OCTAVES_HZ: Final = (63.0, 125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0)
WAVE_OCTAVES: Final = 5
"""Octaves from the lowest on whose absorption waves see."""
MOST_ABSORPTION: Final = 0.95
"""Random incidence on a locally reacting wall takes no more: 0.951 at an impedance of 1.57 ρc."""


@dataclass(frozen=True)
class Material:
    """Random-incidence absorption of a wall, by octave from 63 Hz to 4 kHz."""

    name: str
    absorption: tuple[float, ...]
    source: str = ""

    def __post_init__(self) -> None:
        if len(self.absorption) != len(OCTAVES_HZ):
            raise ParameterError(
                f"materials.{self.name}.absorption: has {len(self.absorption)} values, needed one "
                f"for each octave from 63 Hz to 4 kHz ({len(OCTAVES_HZ)})"
            )
        for octave, value in zip(OCTAVES_HZ, self.absorption, strict=True):
            if not 0.0 <= value <= 1.0:
                raise ParameterError(
                    f"materials.{self.name}.absorption = {value:g} at {octave:g} Hz: must be 0 to 1"
                )

    @property
    def hard(self) -> bool:
        """Whether it absorbs nothing that waves see."""
        return not any(self.absorption[:WAVE_OCTAVES])

    @property
    def clipped_octaves_hz(self) -> tuple[float, ...]:
        """Octaves where more is asked for than a locally reacting wall can take."""
        return tuple(
            octave
            for octave, value in zip(OCTAVES_HZ, self.absorption, strict=True)
            if value > MOST_ABSORPTION
        )


HARD: Final = Material("hard", (0.0,) * len(OCTAVES_HZ))


@dataclass(frozen=True)
class Block:
    """A solid cuboid in the room: furniture, a pillar, the body of the machine."""

    name: str
    lower: Point
    upper: Point
    material: Material = HARD


@dataclass(frozen=True)
class Patch:
    """A rectangle of another material on a side: a window, a door, an opening."""

    name: str
    side: RoomSide
    lower: tuple[float, float]
    """Corner along the two other axes, in their order, m."""
    upper: tuple[float, float]
    material: Material


@dataclass(frozen=True)
class Room:
    """A room from the origin to `size_m`, x and y level, z up. Sides without material are hard."""

    size_m: Point
    walls: Mapping[RoomSide, Material] = field(default_factory=dict)
    blocks: tuple[Block, ...] = ()
    patches: tuple[Patch, ...] = ()

    def __post_init__(self) -> None:
        if not all(0.0 < size < np.inf for size in self.size_m):
            raise ParameterError(f"room.size_m = {list(self.size_m)}: must be lengths above 0 m")
        for block in self.blocks:
            _check(f"room.furniture.{block.name}", block.lower, block.upper, self.size_m)
        for patch in self.patches:
            axis, _ = SIDES[patch.side]
            across = [size for other, size in enumerate(self.size_m) if other != axis]
            _check(f"room.patches.{patch.name}", patch.lower, patch.upper, across)

    def material(self, axis: int, end: int, point: Array) -> Material | None:
        """Material at a point on the side of an air box whose air ends there; None in the air.

        `point` (3,) lies on the side; what is asked for stands just behind it.
        """
        behind = np.array(point, dtype=float)
        behind[axis] += 1e-6 if end else -1e-6
        for block in reversed(self.blocks):
            if np.all((behind > block.lower) & (behind < block.upper)):
                return block.material
        if 0.0 < behind[axis] < self.size_m[axis]:
            return None
        side = next(name for name, where in SIDES.items() if where == (axis, end))
        across = np.delete(behind, axis)
        for patch in reversed(self.patches):
            if patch.side == side and np.all((across > patch.lower) & (across < patch.upper)):
                return patch.material
        return self.walls.get(side, HARD)


def _check(
    name: str,
    lower: tuple[float, ...],
    upper: tuple[float, ...],
    size: tuple[float, ...] | list[float],
) -> None:
    for low, high, most in zip(lower, upper, size, strict=True):
        if not -1e-9 <= low < high <= most + 1e-9:
            raise ParameterError(
                f"{name}: from {low:g} to {high:g} m: "
                f"must rise and lie in the room, 0 to {most:g} m"
            )


def material(name: str, table: Mapping[str, Any]) -> Material:
    """A material from its table: `absorption_ratio` by octave from 125 Hz to 4 kHz, and `source`.

    Published tables begin at 125 Hz: the octave of 63 Hz takes the same value (assumed).
    """
    values = table.get("absorption_ratio")
    if not isinstance(values, list) or len(values) != len(OCTAVES_HZ) - 1:
        raise ParameterError(
            f"{name}.absorption_ratio: must be six numbers, "
            f"one for each octave from 125 Hz to 4 kHz"
        )
    return Material(name, (float(values[0]), *map(float, values)), str(table.get("source", "")))


def read_library(path: str | Path) -> dict[str, Material]:
    """Materials of a TOML file, a table each."""
    import tomllib

    tables = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    return {name: material(name, table) for name, table in tables.items()}
