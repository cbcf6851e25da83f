"""Level of a unit at a window by ISO 9613-2, line by line."""

from typing import Literal

from pydantic import Field

from ..base.decibel import energy_sum
from ..base.parameters import Contradictions
from .iso_9613_2 import (
    A_WEIGHTING_DB,
    OCTAVES_HZ,
    Ground,
    Path,
    Screen,
    octave_levels_db,
)
from .rule import CalculationLine, PermitRule, PermitUnit


class OutdoorRule(PermitRule):
    """A window with what is between it and the unit."""

    receiver_height_m: float = Field(default=4.0, ge=0.1, le=100.0)
    ground: Literal["general", "alternative"] = "general"
    """Method of ISO 9613-2, clause 7.3.1 or 7.3.2."""
    source_ground_ratio: float = Field(default=0.0, ge=0.0, le=1.0)
    """Ground factor G, 0 of hard to 1 of porous ground."""
    middle_ground_ratio: float = Field(default=0.0, ge=0.0, le=1.0)
    receiver_ground_ratio: float = Field(default=0.0, ge=0.0, le=1.0)
    wall_reflection_db: Literal[0, 3, 6] = 0
    """Free, at a wall, in a corner (image sources of hard walls)."""
    screen_distance_m: float | None = Field(default=None, gt=0.0, le=2000.0)
    """Horizontal distance of a screen from the unit."""
    screen_height_m: float = Field(default=2.0, gt=0.0, le=100.0)
    temperature_k: float = Field(default=283.15, ge=253.0, le=323.0)
    humidity_ratio: float = Field(default=0.7, ge=0.1, le=1.0)

    def contradictions(self) -> Contradictions:
        screen, distance = self.screen_distance_m, self.distance_m
        if screen is not None and screen >= distance:
            yield f"screen_distance_m = {screen:g} m: must be below distance_m = {distance:g} m"


def outdoor_lines(unit: PermitUnit, window: OutdoorRule) -> list[CalculationLine]:
    """Compute the level of a unit at a window; one line an octave, the level last.

    Parameters
    ----------
    unit : sound power; octaves of equal level where it gives none
    window : distance, ground, air, screen
    """
    path = Path(window.distance_m, unit.height_m, window.receiver_height_m)
    ground = None
    if window.ground == "general":
        ground = Ground(
            window.source_ground_ratio, window.middle_ground_ratio, window.receiver_ground_ratio
        )
    screen = None
    if window.screen_distance_m is not None and window.screen_distance_m < window.distance_m:
        screen = Screen(window.screen_distance_m, window.screen_height_m)
    levels = A_WEIGHTING_DB + octave_levels_db(
        unit.octaves_db(window.period), path, ground, window.temperature_k, window.humidity_ratio,
        screen,
    )  # fmt: skip
    total = float(energy_sum(levels, axis=0))
    wall = float(window.wall_reflection_db)
    octaves = [
        CalculationLine(f"octave {hertz:.0f} Hz, A-weighted, by ISO 9613-2", float(level), "dB(A)")
        for hertz, level in zip(OCTAVES_HZ, levels, strict=True)
    ]
    return [
        CalculationLine("sound power level, L_WA", unit.power_dba(window.period), "dB(A)"),
        CalculationLine("distance, d", path.slant_m, "m"),
        *octaves,
        CalculationLine("sum of the octaves", total, "dB(A)"),
        CalculationLine("reflecting walls, added", wall),
        CalculationLine("level", total + wall, "dB(A)"),
    ]
