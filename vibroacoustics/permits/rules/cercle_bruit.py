"""Cercle Bruit 6.21, Switzerland: heat pumps by planning values of the noise ordinance."""

from typing import ClassVar, Final, Literal

from pydantic import Field

from ...base.decibel import level_of_amplitude, level_of_power
from ...base.registry import register
from ..areas import AreaRule
from ..rule import CalculationLine, PermitUnit

PLANNING_DBA: Final = {
    "I": {"day": 50.0, "night": 40.0},
    "II": {"day": 55.0, "night": 45.0},
    "III": {"day": 60.0, "night": 50.0},
    "IV": {"day": 65.0, "night": 55.0},
}
_TIME_DB: Final = {"day": 5.0, "night": 10.0}
_HOURS: Final = 12.0


class CercleBruit(AreaRule):
    """L_r = L_WA - 11 + D_C - 20 lg s + K_1 + K_2 + K_3 + 10 lg(t/720 min).

    A window in an area of sensitivity I to IV.
    """

    kind: ClassVar[str] = "cercle-bruit"
    title: ClassVar[str] = "Cercle Bruit 6.21"
    edition: ClassVar[str] = (
        "Cercle Bruit, Vollzugshilfe 6.21, 1 November 2024; planning values of LSV annex 6"
    )
    decimals: ClassVar[int | None] = None
    limits: ClassVar[str] = (
        "Besides, a measure is due where 1 % of the cost or less buys 3 dB or more (precaution)."
    )

    limits_dba = PLANNING_DBA
    directivity_db: Literal[3, 6, 9] = 3
    """D_C: free and 3 m or more from walls, at a wall, in a corner."""
    audible_tone_db: Literal[0, 2, 4, 6] = 2
    """K_2: 2 dB where nothing else is shown."""
    impulse_db: Literal[0, 2, 4, 6] = 0
    """K_3."""
    operating_hours: float = Field(default=12.0, gt=0.0, le=12.0)
    """Hours of operation in the 12 h from 7 or 19 h."""

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Level of a unit, by its sound power at 2 °C."""
        power = unit.power_dba(self.period)
        distance = level_of_amplitude(self.distance_m)
        level = power - 11.0 + self.directivity_db - distance
        return [
            CalculationLine("sound power level at 2 °C, L_WA", power, "dB(A)"),
            CalculationLine("directivity, D_C", float(self.directivity_db)),
            CalculationLine("20 lg s", distance),
            CalculationLine("level L_eq = L_WA - 11 + D_C - 20 lg s", level, "dB(A)"),
        ]

    def adjustment_lines(self) -> list[CalculationLine]:
        """K_1 by the time of day, K_2 for tones, K_3 for impulses, operating time."""
        share = float(level_of_power(self.operating_hours / _HOURS))
        return [
            CalculationLine("time of day, K_1", _TIME_DB[self.period]),
            CalculationLine("tone, K_2", float(self.audible_tone_db)),
            CalculationLine("impulses, K_3", float(self.impulse_db)),
            CalculationLine("operating time, 10 lg(t/720 min)", share),
        ]


register(CercleBruit)
