"""Task of a method of radiation: its inputs and its microphones."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from ..study.radiation import KWAVE_LIMIT_HZ, RadiationSettings
from .arrays import Array
from .patterns import Pattern
from .scene import Scene

_NODES_PER_WAVE: Final = 4.0
"""Nodes per wave of an automatic k-Wave grid at its highest frequency; a study may take 3.5."""
_LARGEST_SPACING_M: Final = 0.06
"""Spacing of an automatic grid: a coarser one saves little, as most of its nodes are absorbing
layers."""


@dataclass(frozen=True)
class Microphones:
    """Points where some of the patterns are asked for, at some of the frequencies."""

    points: Array
    """(point, 3), m."""
    frequencies: slice = field(default_factory=lambda: slice(None))
    patterns: int | None = None
    """Number of them, from the first on; None: all."""


@dataclass(frozen=True)
class Task:
    """Patterns of a machine in its surroundings, and the microphones that hear them."""

    scene: Scene
    patterns: Sequence[Pattern]
    positions: Mapping[str, Array]
    """Positions of the microphones by name, (3,), m."""
    settings: RadiationSettings
    frequency_hz: Array
    """Those of the table and, after them, those of the lines."""
    tabulated: int
    """Number of frequencies of the table."""
    kwave: tuple[str, ...] = ()
    """Names of the microphones to which k-Wave computes the room."""

    @property
    def table_hz(self) -> Array:
        """Frequencies of the table."""
        return self.frequency_hz[self.table]

    @property
    def table(self) -> slice:
        """Frequencies of the table among all."""
        return slice(0, self.tabulated)

    @property
    def receivers(self) -> Microphones:
        """The microphones: all patterns at the frequencies of the table."""
        return Microphones(np.array(list(self.positions.values())), self.table)

    @property
    def kwave_rows(self) -> list[int]:
        """Microphones that k-Wave computes."""
        return [row for row, name in enumerate(self.positions) if name in self.kwave]

    @property
    def kwave_table(self) -> slice:
        """Frequencies of the table up to the highest that k-Wave computes."""
        return slice(0, int((self.table_hz <= KWAVE_LIMIT_HZ).sum()))

    @property
    def kwave_microphones(self) -> Microphones:
        """Those that k-Wave computes."""
        return Microphones(self.receivers.points[self.kwave_rows], self.kwave_table)

    @property
    def kwave_highest_hz(self) -> float:
        """Highest frequency that k-Wave's grids must resolve."""
        return min(self.settings.maximum_frequency_hz, KWAVE_LIMIT_HZ)

    @property
    def resolving_spacing_m(self) -> float:
        """Largest spacing that resolves the wave: the study's, or automatic."""
        given_m = self.settings.room_spacing_m
        if given_m is not None:
            return given_m
        shortest_m = SPEED_OF_SOUND_M_PER_S / self.kwave_highest_hz
        return min(shortest_m / _NODES_PER_WAVE, _LARGEST_SPACING_M)
