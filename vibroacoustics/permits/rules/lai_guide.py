"""LAI guide to noise of stationary devices, Germany: least distance by an emission level."""

from typing import ClassVar, Final, Literal

from ...base.registry import register
from ..areas import AreaRule
from ..iso_9613_2 import Path, alternative_ground_db, divergence_db, reflection_db
from ..rule import CalculationLine, PermitUnit
from .ta_laerm import LIMITS_DBA

SOURCE_HEIGHT_M: Final = 1.5
RECEIVER_HEIGHT_M: Final = 2.0
AIR_DB_PER_M: Final = 0.002
IRRELEVANT_DB: Final = 6.0
"""Distance to the night limit below which a unit adds nothing that counts (TA Lärm 3.2.1)."""


class LaiGuide(AreaRule):
    """Simplified method of the guide; the unit is judged at night.

    A window with its shielding and reflections.
    """

    kind: ClassVar[str] = "lai-guide"
    title: ClassVar[str] = "LAI guide"
    edition: ClassVar[str] = "LAI, Leitfaden Schallschutz bei stationären Geräten, 28 August 2023"
    limits: ClassVar[str] = "Source 1.5 m and receiver 2 m above the ground, 2 dB/km in air."

    limits_dba = LIMITS_DBA
    shielding_db: Literal[0, 5, 15] = 0
    """Shielding: 0, in part 5, by a closed wall or building 15."""
    reflection_db: Literal[0, 3, 6] = 0
    """Free, at a wall, in a corner."""

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Emission level and its propagation by the alternative method of ISO 9613-2."""
        power, tone = unit.power_dba("night"), unit.tone_adjustment_db
        emission = power - self.shielding_db + self.reflection_db + tone
        path = Path(self.distance_m, SOURCE_HEIGHT_M, RECEIVER_HEIGHT_M)
        ground, near = alternative_ground_db(path), reflection_db(path)
        distance, air = divergence_db(path.slant_m), AIR_DB_PER_M * path.slant_m
        return [
            CalculationLine("sound power level at night, L_WA", power, "dB(A)"),
            CalculationLine("shielding, subtracted", float(self.shielding_db)),
            CalculationLine("reflections, added", float(self.reflection_db)),
            CalculationLine("tone, added", tone),
            CalculationLine("L_E = L_WA - shielding + reflections + tone", emission, "dB(A)"),
            CalculationLine("distance between 1.5 m and 2 m high points, d", path.slant_m, "m"),
            CalculationLine("20 lg d + 11", distance),
            CalculationLine("ground A_gr = 4.8 - (3.5/d)(17 + 300/d), not below 0", ground),
            CalculationLine("reflection of the ground D_Ω", near),
            CalculationLine("air, 0.002 d", air),
            CalculationLine("level L_E + D_Ω - (20 lg d + 11) - A_gr - air",
                 emission + near - distance - ground - air, "dB(A)"),
        ]  # fmt: skip

    @property
    def allowed_dba(self) -> float:
        """Night limit of the area less 6 dB, whatever the period; or the given one as it is."""
        if self.limit_dba is not None:
            return self.limit_dba
        return self.limits_dba[self.area]["night"] - IRRELEVANT_DB


register(LaiGuide)
