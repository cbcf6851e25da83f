"""Where values come from."""

from ..base.parameters import Parameters


class ParameterRecord(Parameters):
    """Where a value comes from: one row of the assumptions table."""

    file: str
    field: str
    value: str
    unit: str
    source: str
    lowest: float | None = None
    highest: float | None = None

    @property
    def assumed(self) -> bool:
        return self.source.startswith("assumed")
