"""What a method of radiation is given."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..study.radiation import RadiationSettings
from .arrays import Array
from .patterns import Pattern
from .scene import Scene


@dataclass(frozen=True)
class Task:
    """Patterns of a machine in its surroundings, and the microphones that hear them."""

    scene: Scene
    patterns: Sequence[Pattern]
    positions: Mapping[str, Array]
    """Of the microphones by name, (3,), m."""
    settings: RadiationSettings
    frequency_hz: Array
    """Those of the table and, after them, those of the lines."""
    tabulated: int
    """Number of frequencies of the table."""

    @property
    def table_hz(self) -> Array:
        """Frequencies of the table."""
        return self.frequency_hz[: self.tabulated]
