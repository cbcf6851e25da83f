"""Code de la santé publique R1336-7, France: emergence over the background."""

from typing import ClassVar, Final

import numpy as np
from pydantic import Field

from ...base.decibel import energy_sum, level_of_power, power_of_level
from ...base.registry import register
from ..outdoors import OutdoorRule, outdoor_lines
from ..rule import CalculationLine, PermitUnit

EMERGENCE_DB: Final = {"day": 5.0, "night": 3.0}


class France(OutdoorRule):
    """The level with the unit may exceed the background by 5 dB by day and 3 dB at night.

    A place with its background.
    """

    kind: ClassVar[str] = "fr-emergence"
    title: ClassVar[str] = "R1336-7"
    edition: ClassVar[str] = "Code de la santé publique, articles R1336-7 and R1336-8"
    limits: ClassVar[str] = (
        "Without the term for the duration (not found), the emergence in octaves indoors and the "
        "test for tones."
    )

    background_dba: float = Field(ge=0.0, le=90.0)
    """Level without the unit, measured."""

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Level of a unit; the code names no propagation, ISO 9613-2 is taken."""
        return outdoor_lines(unit, self)

    @property
    def allowed_dba(self) -> float:
        """Largest level of the unit alone: L_b + 10 lg(10^(E/10) - 1)."""
        if self.limit_dba is not None:
            return self.limit_dba
        rise = power_of_level(np.float64(EMERGENCE_DB[self.period])) - 1.0
        return self.background_dba + float(level_of_power(rise))

    def last_lines(self, level_db: float) -> list[CalculationLine]:
        """Emergence, and the level of the unit alone, which is compared."""
        with_unit = float(energy_sum(np.array([level_db, self.background_dba]), axis=0))
        emergence = CalculationLine(
            "emergence over the background", with_unit - self.background_dba
        )
        return [emergence, CalculationLine("level of the unit alone", level_db, "dB(A)")]


register(France)
