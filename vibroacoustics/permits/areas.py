"""Rules whose limit follows from an area and the time of day."""

from collections.abc import Mapping
from typing import ClassVar

from ..base.parameters import Contradictions
from .rule import PermitRule


class AreaRule(PermitRule):
    """A window in an area of a rule, with its own limit or that of the area."""

    limits_dba: ClassVar[Mapping[str, Mapping[str, float]]] = {}
    """Limits by area and period."""

    area: str = ""

    def contradictions(self) -> Contradictions:
        areas = ", ".join(self.limits_dba)
        if self.area and self.area not in self.limits_dba:
            yield f"area = {self.area}: allowed {areas}"
        elif not self.area and self.limit_dba is None:
            yield f"give area ({areas}) or limit_dba"

    @property
    def allowed_dba(self) -> float:
        """Limit of the window."""
        if self.limit_dba is not None:
            return self.limit_dba
        return self.limits_dba[self.area][self.period]
