"""Building decree Bbl 4.107, Netherlands: limits at the boundary and at windows."""

from typing import ClassVar, Final

from ...base.registry import register
from ..outdoors import OutdoorRule, outdoor_lines
from ..rule import CalculationLine, PermitUnit

LIMITS_DBA: Final = {"day": 45.0, "night": 40.0}
TONE_DB: Final = 5.0


class Netherlands(OutdoorRule):
    """40 dB(A), by day from 7 to 19 h and with a night setting 45; 5 dB more for a tone.

    A place at the boundary, 1.5 m high, or a window.
    """

    kind: ClassVar[str] = "nl-bbl"
    title: ClassVar[str] = "Bbl 4.107"
    edition: ClassVar[str] = "Besluit bouwwerken leefomgeving, article 4.107, since 2021"
    limits: ClassVar[str] = (
        "The decree's own propagation was not found: ISO 9613-2 takes its place."
    )

    receiver_height_m: float = 1.5

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Level of a unit; its source is at two thirds of its height."""
        source = unit.model_copy(update={"height_m": unit.height_m * 2.0 / 3.0})
        lines = outdoor_lines(source, self)
        tone = TONE_DB if unit.tone_adjustment_db else 0.0
        level = lines[-1].value + tone
        return [
            *lines,
            CalculationLine("tone, added", tone),
            CalculationLine("level with tone", level, "dB(A)"),
        ]

    @property
    def allowed_dba(self) -> float:
        """Limit by period."""
        return LIMITS_DBA[self.period] if self.limit_dba is None else self.limit_dba


register(Netherlands)
