"""MCS 020 a), United Kingdom: sound of heat pumps under permitted development."""

from typing import ClassVar, Final, Literal

import numpy as np

from ...base.decibel import energy_sum, level_of_power
from ...base.registry import register
from ..rule import CalculationLine, PermitRule, PermitUnit

LIMIT_DBA: Final = 37.0
OLDER_LIMIT_DBA: Final = 42.0
OLDER_BACKGROUND_DBA: Final = 40.0
LARGEST_VOLUME_M3: Final = 1.5
_BARRIER_DB: Final = {
    ("solid", "full"): 0.0, ("solid", "partial"): 5.0, ("solid", "none"): 10.0,
    ("thin", "full"): 0.0, ("thin", "partial"): 2.5, ("thin", "none"): 5.0,
}  # fmt: skip


class Mcs020(PermitRule):
    """L_p = L_W + 10 lg(Q/4πr²) - B, rounded to 0.1 dB; the low-noise mode does not count.

    The assessment position, 1 m outside the window or door of a neighbour.
    """

    kind: ClassVar[str] = "mcs-020"
    title: ClassVar[str] = "MCS 020 a)"
    edition: ClassVar[str] = "MCS 020 a) 1.1, 14 April 2025, or the edition before it"
    decimals: ClassVar[int | None] = 1
    limits: ClassVar[str] = "Tones do not count."

    surfaces: Literal[1, 2, 3] = 2
    """Reflecting surfaces within 1 m of the unit, the ground one of them; more are not allowed."""
    view: Literal["full", "partial", "none"] = "full"
    """View of the unit from the position."""
    barrier: Literal["solid", "thin"] = "solid"
    """Masonry or a fence of at least 18 mm, or a thinner fence."""
    version: Literal["2025", "older"] = "2025"
    """England since 2025, or the earlier version: Scotland, Wales, Northern Ireland."""

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Level of a unit at full power."""
        ratio = 2.0**self.surfaces
        distance = round(self.distance_m, 1)
        spread = float(level_of_power(np.float64(ratio / (4.0 * np.pi * distance**2))))
        barrier = _BARRIER_DB[self.barrier, self.view]
        level = unit.day_power_dba + spread - barrier
        return [
            CalculationLine("sound power level at full power, L_WA", unit.day_power_dba, "dB(A)"),
            CalculationLine("directivity Q of the surfaces", ratio, ""),
            CalculationLine("distance to 0.1 m, r", distance, "m"),
            CalculationLine("10 lg(Q/4πr²)", spread),
            CalculationLine("barrier, subtracted", barrier),
            CalculationLine("level L_WA + 10 lg(Q/4πr²) - barrier", level, "dB(A)"),
        ]

    def last_lines(self, level_db: float) -> list[CalculationLine]:
        """Background of the earlier version."""
        if self.version == "2025":
            return []
        with_background = float(energy_sum(np.array([level_db, OLDER_BACKGROUND_DBA]), axis=0))
        background = CalculationLine("background, added as energy", OLDER_BACKGROUND_DBA, "dB(A)")
        return [background, CalculationLine("level with background", with_background, "dB(A)")]

    @property
    def allowed_dba(self) -> float:
        """37 dB(A); 42 dB(A) by the earlier version."""
        if self.limit_dba is not None:
            return self.limit_dba
        return LIMIT_DBA if self.version == "2025" else OLDER_LIMIT_DBA

    def refusals(self, unit: PermitUnit) -> list[str]:
        """The volume that is allowed."""
        if unit.volume_m3 is None or unit.volume_m3 <= LARGEST_VOLUME_M3:
            return []
        return [f"volume_m3 = {unit.volume_m3:g}: at most {LARGEST_VOLUME_M3:g} m³ are permitted"]


register(Mcs020)
