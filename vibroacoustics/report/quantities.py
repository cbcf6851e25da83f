"""Quantities by which an option is compared with no option."""

from dataclasses import dataclass
from typing import Final

from ..base import rounding

NO_BREAK: Final = "\u00a0"
HEARD_DB: Final = 1.0
"""A change of the total below about 1 dB is not heard, even side by side."""


@dataclass(frozen=True)
class Quantity:
    """A quantity of the comparison.

    Attributes
    ----------
    column : column of the comparison
    words : in a sentence
    unit : symbol
    judged : its name among the quantities by which options are judged
    change : variable of its change against no option, dB
    """

    column: str
    words: str
    unit: str
    judged: str
    change: str

    @property
    def is_level(self) -> bool:
        return self.unit.startswith("dB")

    @property
    def floor(self) -> float:
        """Values below are silence, or rounding errors."""
        return rounding.LEVEL_FLOOR_DB if self.is_level else rounding.FORCE_FLOOR

    def write(self, value: float) -> str:
        """The value with its unit, rounded, kept on one line."""
        number = rounding.level(value) if self.is_level else rounding.significant(value)
        return f"{number} {self.unit}".replace(" ", NO_BREAK)


FORCE: Final = Quantity("force_1x_n", "1× force", "N", "force", "force_change_1x")
MOMENT: Final = Quantity("moment_1x_nm", "1× moment", "N m", "moment", "moment_change_1x")
FOOT_FORCE: Final = Quantity(
    "foot_force_1x_n", "1× foot force", "N", "foot_force", "foot_force_change_1x"
)
LINE: Final = Quantity("level_1x_db", "1× line", "dB", "level_1x", "change_1x")
TOTAL: Final = Quantity("level_total_dba", "total level", "dB(A)", "level_total", "change_total")

JUDGED: Final = (FORCE, MOMENT, FOOT_FORCE, TOTAL, LINE)
"""An option is called better or worse by these: they can be measured on a machine."""
