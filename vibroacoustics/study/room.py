"""A room with walls, furniture and listeners into which the machine is put; absorbing covers."""

import tomllib
from functools import cache
from importlib import resources
from math import hypot
from pathlib import Path
from typing import Annotated, Any, Final, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from ..base.parameters import Contradictions, Parameters
from ..machine.shell import Shell

OCTAVES_HZ: Final = (125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0)
Ratio = Annotated[float, Field(ge=0.0, le=1.0)]


class Covering(Parameters):
    """Random-incidence absorption at the octaves from 125 Hz to 4 kHz."""

    absorption_ratio: tuple[Ratio, Ratio, Ratio, Ratio, Ratio, Ratio]
    name: str = ""
    """Name in the library."""
    source: str = ""


@cache
def library() -> dict[str, Covering]:
    """Materials that the package comes with, by name."""
    package = resources.files(__package__.partition(".")[0])
    packed = package / "shipped"
    folder = packed if packed.is_dir() else Path(str(package)).parent
    text = (folder / "data" / "rooms" / "materials.toml").read_text(encoding="utf-8")
    return {
        name: Covering(
            name=name, absorption_ratio=tuple(table["absorption_ratio"]), source=table["source"]
        )
        for name, table in tomllib.loads(text).items()
    }


def _by_name(value: Any) -> Any:
    """A covering for a name of the library; anything else as it is."""
    if isinstance(value, dict) and isinstance(ratios := value.get("absorption_ratio"), list):
        return {**value, "absorption_ratio": tuple(ratios)}  # strict beyond this function
    if not isinstance(value, str):
        return value
    if value not in library():
        raise ValueError(
            f"{value} is no material of the library; allowed {', '.join(library())}, "
            "or a table with absorption_ratio"
        )
    return library()[value]


_SCHEMA: Final = {
    "anyOf": [
        {"type": "string", "description": "Name in data/rooms/materials.toml"},
        {
            "type": "object",
            "description": "Random-incidence absorption at the octaves from 125 Hz to 4 kHz",
            "properties": {
                "absorption_ratio": {
                    "type": "array",
                    "items": {"type": "number", "minimum": 0.0, "maximum": 1.0},
                    "minItems": 6,
                    "maxItems": 6,
                },
                "source": {"type": "string"},
            },
        },
    ]
}
Material = Annotated[Covering, BeforeValidator(_by_name), WithJsonSchema(_SCHEMA)]
"""Material: in files a name of the library, or a table of absorption by octave."""


RoomSide = Literal["-x", "+x", "-y", "+y", "floor", "ceiling"]
AXIS_OF: Final[dict[RoomSide, int]] = {
    "-x": 0, "+x": 0, "-y": 1, "+y": 1, "floor": 2, "ceiling": 2,
}  # fmt: skip
"""Axis across each side."""
SHORTEST_M: Final = 0.5
LONGEST_M: Final = 30.0
_ON_WALL_M: Final = 1e-9
LARGEST_M3: Final = 500.0
"""Beyond, waves to some hundred hertz take hours."""
Length = Annotated[float, Field(ge=SHORTEST_M, le=LONGEST_M)]
Coordinate = Annotated[float, Field(ge=0.0, le=LONGEST_M)]


class Furniture(Parameters):
    """A solid cuboid in a room, which holds no air."""

    lower_m: tuple[Coordinate, Coordinate, Coordinate]
    """Its corner nearest to the room's origin: x, y, z."""
    upper_m: tuple[Coordinate, Coordinate, Coordinate]
    material: Material

    def holds(self, x_m: float, y_m: float, z_m: float) -> bool:
        """Whether a point lies inside."""
        point = (x_m, y_m, z_m)
        return all(
            low < coordinate < high
            for low, coordinate, high in zip(self.lower_m, point, self.upper_m, strict=True)
        )


class RoomPatch(Parameters):
    """A rectangle of another material on a side of the room: a window, a door, an opening."""

    side: RoomSide
    lower_m: tuple[Coordinate, Coordinate]
    """Its corner nearest to the origin, along the two other axes in their order."""
    upper_m: tuple[Coordinate, Coordinate]
    material: Material


class Listener(Parameters):
    """Someone's ears in the room, from its corner and its floor."""

    x_m: Coordinate
    y_m: Coordinate
    height_m: Coordinate


class RoomLimits(Parameters):
    """A-weighted levels that listeners accept, of all that the machine makes."""

    day_dba: float | None = Field(default=None, ge=0.0, le=120.0)
    night_dba: float | None = Field(default=None, ge=0.0, le=120.0)

    @property
    def levels(self) -> dict[str, float]:
        """Those that are given, by time of day."""
        limits = {"day": self.day_dba, "night": self.night_dba}
        return {time: level for time, level in limits.items() if level is not None}


class StudyRoom(Parameters):
    """A room from its origin in a lower corner, x and y level, z up; hard where nothing covers it.

    The machine stands with its axis at a place of it.
    """

    size_m: tuple[Length, Length, Length]
    foot_m: tuple[Coordinate, Coordinate]
    """Foot of the shell's axis: x and y."""
    standing_height_m: float = Field(default=0.0, ge=0.0, le=LONGEST_M)
    """Top of what the machine stands on, above the floor."""
    maximum_frequency_hz: float = Field(default=1000.0, ge=250.0, le=1000.0)
    """Frequency up to which waves are computed; above, the diffuse field."""
    walls: dict[RoomSide, Material] = Field(default_factory=dict)
    furniture: dict[str, Furniture] = Field(default_factory=dict)
    patches: dict[str, RoomPatch] = Field(default_factory=dict)
    listeners: dict[str, Listener] = Field(min_length=1)
    limits: RoomLimits = RoomLimits()

    def contradictions(self) -> Contradictions:
        volume = self.size_m[0] * self.size_m[1] * self.size_m[2]
        if volume > LARGEST_M3:
            yield (
                f"size_mm = {_millimetres(self.size_m)}: a volume of {volume:.4g} m³; "
                f"allowed to {LARGEST_M3:g} m³"
            )
        for name, block in self.furniture.items():
            _check_rises(f"furniture.{name}", block.lower_m, block.upper_m, self.size_m)
        for name, patch in self.patches.items():
            across = _without(self.size_m, AXIS_OF[patch.side])
            _check_rises(f"patches.{name}", patch.lower_m, patch.upper_m, across)
        self._check_listeners()
        self._check_stands()

    def _check_listeners(self) -> None:
        for name, listener in self.listeners.items():
            point = (listener.x_m, listener.y_m, listener.height_m)
            if not all(
                0.0 < coordinate < size for coordinate, size in zip(point, self.size_m, strict=True)
            ):
                raise ValueError(
                    f"listeners.{name}: at {_millimetres(point)} mm: must lie in the room, "
                    f"0 to {_millimetres(self.size_m)} mm"
                )
            for block_name, block in self.furniture.items():
                if block.holds(*point):
                    raise ValueError(
                        f"listeners.{name}: at {_millimetres(point)} mm: lies in "
                        f"furniture.{block_name}"
                    )

    def _check_stands(self) -> None:
        """The machine needs something to stand on."""
        x, y = self.foot_m
        tops = {
            round(block.upper_m[2], 6)
            for block in self.furniture.values()
            if block.lower_m[0] <= x <= block.upper_m[0]
            and block.lower_m[1] <= y <= block.upper_m[1]
        }
        if round(self.standing_height_m, 6) not in {0.0, *tops}:
            allowed = ", ".join(f"{1e3 * top:g}" for top in sorted({0.0, *tops}))
            raise ValueError(
                f"standing_height_mm = {1e3 * self.standing_height_m:g} mm: neither the floor nor "
                f"the top of furniture at foot_mm; allowed {allowed} mm"
            )

    def check_holds(self, shell: Shell) -> None:
        """Refuse a machine that stands in a wall or in furniture, or a listener in the machine.

        Raises
        ------
        ValueError
            With what is in the way.
        """
        x, y = self.foot_m
        bottom = self.standing_height_m + shell.floor_clearance_m
        outside = shell.profile
        radius = outside.radius_m
        lower = (x - radius, y - radius, bottom)
        upper = (x + radius, y + radius, bottom + outside.height_m)
        for axis, word in enumerate("xyz"):
            if lower[axis] < 0.0 or upper[axis] > self.size_m[axis]:
                raise ValueError(
                    f"foot_mm = {_millimetres(self.foot_m)}: the shell reaches from "
                    f"{1e3 * lower[axis]:.4g} to {1e3 * upper[axis]:.4g} mm along {word}; the room "
                    f"from 0 to {1e3 * self.size_m[axis]:g} mm"
                )
        for name, block in self.furniture.items():
            if _overlaps(block, x, y, lower, upper, radius):
                raise ValueError(
                    f"foot_mm = {_millimetres(self.foot_m)}: the shell stands in furniture.{name}"
                )
        for name, listener in self.listeners.items():
            height = listener.height_m - self.standing_height_m
            if shell.distance_m(listener.x_m - x, listener.y_m - y, height) < _ON_WALL_M:
                raise ValueError(f"listeners.{name}: lies in the machine")


def _overlaps(
    block: Furniture,
    x: float,
    y: float,
    lower: tuple[float, float, float],
    upper: tuple[float, float, float],
    radius: float,
) -> bool:
    """Whether an upright cylinder and a cuboid share air."""
    if not block.lower_m[2] < upper[2] or not lower[2] < block.upper_m[2]:
        return False
    beside = [
        max(low - coordinate, coordinate - high, 0.0)
        for coordinate, low, high in zip((x, y), block.lower_m, block.upper_m, strict=False)
    ]
    return hypot(*beside) < radius


def _check_rises(
    name: str, lower: tuple[float, ...], upper: tuple[float, ...], size: tuple[float, ...]
) -> None:
    for low, high, most in zip(lower, upper, size, strict=True):
        if not low < high <= most * (1.0 + 1e-9):
            raise ValueError(
                f"{name}: from {1e3 * low:g} to {1e3 * high:g} mm: must rise and lie in the room, "
                f"0 to {1e3 * most:g} mm"
            )


def _without(values: tuple[float, ...], axis: int) -> tuple[float, ...]:
    return tuple(value for number, value in enumerate(values) if number != axis)


def _millimetres(values: tuple[float, ...]) -> list[float]:
    return [float(f"{1e3 * value:.6g}") for value in values]
