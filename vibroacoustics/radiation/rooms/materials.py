"""What covers a wall: absorption by octave, and the library of published values."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from ...base.errors import ParameterError

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
