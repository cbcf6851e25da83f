"""Windows at which the sound of a study is rated, and the rules."""

from typing import Literal

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from .rating_rule import RATING_RULES, RatingRules

Period = Literal["night", "day"]


class Window(Parameters):
    """A window at which the rating level is judged."""

    receiver: str
    """Microphone in front of the window."""
    area: str = ""
    """Area of the rules; none where the rules have no limits."""
    period: Period = "night"
    operating_s: float | None = Field(default=None, gt=0.0, le=57600.0)
    """Time that the machine runs: of an hour at night (TA Lärm), of a day; none for all of it."""
    sensitive_s: float = Field(default=0.0, ge=0.0, le=57600.0)
    """Part of the operating time in hours of raised sensitivity."""
    limit_dba: float | None = Field(default=None, ge=0.0, le=120.0)
    """Limit in place of the limit of the area."""
    impulse_adjustment_db: float = Field(default=0.0, ge=0.0, le=12.0)


class Rating(Parameters):
    """Rules and windows of the rating."""

    rules: str = "ta-laerm"
    windows: dict[str, Window] = Field(min_length=1)

    @property
    def applied(self) -> RatingRules:
        """Return the rules of that name."""
        return RATING_RULES[self.rules]

    def contradictions(self) -> Contradictions:
        if self.rules not in RATING_RULES:
            yield f"rules = {self.rules}: unknown; allowed {', '.join(sorted(RATING_RULES))}"
            return
        for name, window in self.windows.items():
            yield from self._of_window(f"windows.{name}", window)

    def _of_window(self, key: str, window: Window) -> Contradictions:
        rules = self.applied
        areas = ", ".join(rules.limits_dba)
        if window.area and window.area not in rules.limits_dba:
            yield f"{key}.area = {window.area}: allowed {areas or 'none by these rules'}"
        elif window.limit_dba is None and not window.area:
            yield f"{key}: " + (
                f"give area ({areas})" if areas else "give limit_dba: these rules have no limits"
            )
        rating_min = rules.rating_time_s[window.period] / 60.0
        operating_min = self.operating_s(window) / 60.0
        if operating_min > rating_min:
            yield (
                f"{key}.operating_min = {operating_min:g} min: allowed up to {rating_min:g} min "
                f"for period = {window.period}"
            )
        longest_min = min(rules.sensitive_time_s.get(window.period, 0.0) / 60.0, operating_min)
        if window.sensitive_s / 60.0 > longest_min:
            yield (
                f"{key}.sensitive_min = {window.sensitive_s / 60.0:g} min: allowed up to "
                f"{longest_min:g} min"
            )

    def operating_s(self, window: Window) -> float:
        """Return the operating time of a window, s: that of the period where none is given."""
        rating_time_s = self.applied.rating_time_s[window.period]
        return rating_time_s if window.operating_s is None else window.operating_s

    def limit_dba(self, window: Window) -> float:
        """Return the limit of a window, dB(A)."""
        if window.limit_dba is not None:
            return window.limit_dba
        return self.applied.limits_dba[window.area][window.period]
