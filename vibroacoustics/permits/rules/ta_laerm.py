"""TA Lärm, Germany, detailed: ISO 9613-2 by octaves, hours of raised sensitivity."""

from typing import ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from ...base.decibel import level_of_power
from ...base.registry import register
from ...levels.rating import rating_level_db
from ...study.rating_rules.ta_laerm import TA_LAERM
from ..areas import AreaRule
from ..outdoors import OutdoorRule, outdoor_lines
from ..rule import CalculationLine, PermitUnit

LIMITS_DBA: Final = TA_LAERM.limits_dba
SENSITIVE_AREAS: Final = TA_LAERM.sensitive_areas
SENSITIVE_DB: Final = TA_LAERM.sensitive_raise_db
_SENSITIVE_HOURS: Final = {"weekday": 3.0, "sunday": 7.0}
"""6 to 7 and 20 to 22 h; on Sundays also 7 to 9 and 13 to 15 h (TA Lärm 6.5)."""
_DAY_HOURS: Final = 16.0


class Detailed(OutdoorRule, AreaRule):
    """Rating level by TA Lärm A.1.4 with ISO 9613-2, compared in whole decibels.

    A window in an area, with what is between it and the unit.
    """

    kind: ClassVar[str] = "ta-laerm"
    title: ClassVar[str] = "TA Lärm, detailed"
    edition: ClassVar[str] = "TA Lärm 1998 with LAI's notes of 24 February 2023; ISO 9613-2:1996"
    decimals: ClassVar[int | None] = 0
    limits: ClassVar[str] = "Without C_met, other sources, and peaks of start and stop."

    limits_dba = LIMITS_DBA
    operating_hours: float = Field(default=16.0, gt=0.0, le=16.0)
    """Hours of operation by day, spread evenly; at night the loudest hour counts."""
    day: Literal["weekday", "sunday"] = "sunday"

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Level of a unit by octaves, with its tone."""
        lines = outdoor_lines(unit, self)
        tone = unit.tone_adjustment_db
        level = lines[-1].value + tone
        return [
            *lines,
            CalculationLine("tone, K_T", tone),
            CalculationLine("level with K_T", level, "dB(A)"),
        ]

    def adjustment_lines(self) -> list[CalculationLine]:
        """Operating time by day, and its hours of raised sensitivity."""
        if self.period == "night":
            return []
        share = float(level_of_power(self.operating_hours / _DAY_HOURS))
        lines = [CalculationLine("operating time, 10 lg(t/16 h)", share)]
        if self.area in SENSITIVE_AREAS:
            raised = _SENSITIVE_HOURS[self.day]
            hours = np.array([_DAY_HOURS - raised, raised])
            mean = float(rating_level_db(np.array([0.0, SENSITIVE_DB]), hours, _DAY_HOURS))
            words = f"raised sensitivity, {SENSITIVE_DB:.0f} dB in {raised:.0f} of 16 h"
            lines.append(CalculationLine(words, mean))
        return lines


register(Detailed)
