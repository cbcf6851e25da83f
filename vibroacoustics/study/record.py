"""Sources of values."""

from ..base.parameters import Parameters
from .example import MARK


class ParameterRecord(Parameters):
    """Source of a value: one row of the assumptions table."""

    file: str
    field: str
    value: str
    unit: str
    source: str
    lowest: float | None = None
    highest: float | None = None
    example: bool = False
    """Whether the value is that of the template which its file began with."""

    @property
    def assumed(self) -> bool:
        return self.source.startswith("assumed")

    @property
    def stale(self) -> bool:
        """Whether the source is a template's, of another value."""
        return self.source.startswith(MARK)
