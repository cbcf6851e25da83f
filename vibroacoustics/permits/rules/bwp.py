"""Overview by TA Lärm A.2.4.3, as the calculator of the German heat pump association."""

from typing import ClassVar, Literal

from ...base.decibel import level_of_amplitude
from ...base.registry import register
from ..areas import AreaRule
from ..rule import CalculationLine, PermitUnit
from .ta_laerm import LIMITS_DBA, SENSITIVE_AREAS, SENSITIVE_DB


class Overview(AreaRule):
    """L = L_W + K_0 - 20 lg s - 11, with K_R on the whole day.

    A window with what is around the unit.
    """

    kind: ClassVar[str] = "bwp"
    title: ClassVar[str] = "TA Lärm, overview"
    edition: ClassVar[str] = "TA Lärm 1998, A.2.4.3, as in the calculator of BWP"
    decimals: ClassVar[int | None] = 0

    limits_dba = LIMITS_DBA
    room_angle_db: Literal[3, 6, 9] = 3
    """K_0: free on the ground, at a wall, in a corner."""
    shielding_db: Literal[0, 5, 15] = 0

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Level of a unit over hard ground."""
        power, tone = unit.power_dba(self.period), unit.tone_adjustment_db
        distance = level_of_amplitude(self.distance_m) + 11.0
        level = power + tone + self.room_angle_db - self.shielding_db - distance
        return [
            CalculationLine("sound power level, L_WA", power, "dB(A)"),
            CalculationLine("tone, K_T", tone),
            CalculationLine("room angle, K_0", float(self.room_angle_db)),
            CalculationLine("shielding, subtracted", float(self.shielding_db)),
            CalculationLine("20 lg s + 11", distance),
            CalculationLine("level L_WA + K_T + K_0 - shielding - (20 lg s + 11)", level, "dB(A)"),
        ]

    def adjustment_lines(self) -> list[CalculationLine]:
        """K_R of areas with hours of raised sensitivity, on the whole day."""
        raised = self.period == "day" and self.area in SENSITIVE_AREAS
        return [CalculationLine("raised sensitivity by day, K_R", SENSITIVE_DB)] if raised else []


register(Overview)
