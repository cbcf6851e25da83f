"""The design space of a study: what varies, what is wanted, what is allowed, what scatters."""

from collections.abc import Mapping
from typing import Any, Final, Literal

from pydantic import Field, field_validator

from ..base.parameters import Contradictions, Parameters

Number = int | float
Statistic = Literal["worst", "mean"] | float
"""Worst, mean, or the share of the values that shall lie below (or above, where more is better)."""
_ENDS: Final = frozenset({"range", "list", "step", "points", "ratio", "plus_minus"})


class DesignVariable(Parameters):
    """Values that a variable may take, in the unit of its key."""

    range: tuple[Number, Number] | None = None
    step: Number | None = Field(default=None, gt=0.0)
    """Within the range; any value of it where there is none."""
    list: tuple[Number | str, ...] | None = Field(default=None, min_length=1, max_length=10_000)
    """Numbers or words in place of a range."""
    points: int | None = Field(default=None, ge=2, le=100_000)
    """Number of points of a range in a grid."""

    def contradictions(self) -> Contradictions:
        if (self.range is None) == (self.list is None):
            yield "give range = [lowest, highest] or list = [...]"
        if self.list is not None and (self.step is not None or self.points is not None):
            yield "step, points: belong to a range, not to a list"
        if self.list is not None and len(set(self.list)) < len(self.list):
            yield f"list = {[*self.list]}: names a value twice"
        if self.range is not None and not self.range[0] < self.range[1]:
            low, high = self.range
            yield f"range = [{low:g}, {high:g}]: must rise"


class Tolerance(Parameters):
    """Tolerance about the intended value, evenly spread, in the unit of its key."""

    ratio: float | None = Field(default=None, gt=0.0, lt=1.0)
    """Share of the value, to both sides."""
    plus_minus: float | None = Field(default=None, gt=0.0)
    range: tuple[float, float] | None = None
    """The value itself, whatever is meant: the angle of a residual unbalance."""

    def contradictions(self) -> Contradictions:
        if [self.ratio, self.plus_minus, self.range].count(None) != 2:
            yield "give one of ratio, plus_minus and range"
        if self.range is not None and not self.range[0] < self.range[1]:
            yield f"range = [{self.range[0]:g}, {self.range[1]:g}]: must rise"


class Wanted(Parameters):
    """A figure of a design, one number over speeds, microphones and samples."""

    figure: str = Field(min_length=1)
    order: int | None = Field(default=None, ge=1, le=1000)
    reported: str | None = None
    """Name of a reported figure, for `figure = "reported"`."""
    speeds: Statistic = "worst"
    receivers: Statistic = "mean"
    samples: Statistic | None = None
    """Statistic over the samples of machine and tolerances; 0.9 is met by nine of ten.

    Without it the median of a study with uncertainty, else nine pieces of ten.
    """

    @field_validator("speeds", "receivers", "samples")
    @classmethod
    def _share(cls, value: Statistic) -> Statistic:
        if isinstance(value, float) and not 0.0 < value <= 1.0:
            raise ValueError(f"{value:g}: allowed worst, mean or a share above 0 to 1")
        return value


class Objective(Wanted):
    """A figure that shall be small, or large."""

    goal: Literal["least", "greatest"] = "least"


class Constraint(Wanted):
    """A figure that a design must keep to, in its unit."""

    at_most: float | None = None
    at_least: float | None = None

    def contradictions(self) -> Contradictions:
        if (self.at_most is None) == (self.at_least is None):
            yield "give at_most or at_least"


class Search(Parameters):
    """Search for the best designs."""

    method: Literal["evolution", "active"] = "evolution"
    """Generations of designs, or one run after another where a Gaussian process expects most."""
    population: int = Field(default=64, ge=8, le=10_000)
    """Designs a generation."""
    generations: int = Field(default=100, ge=1, le=100_000)
    seed: int = Field(default=1, ge=0, le=2**31 - 1)
    """Seed of the random numbers; the same seed gives the same designs."""
    best: int = Field(default=5, ge=1, le=20)
    """Designs that are reported one by one."""
    fresh_samples: int = Field(default=10_000, ge=100, le=1_000_000)
    """Samples of the tolerances that the search has not used; a design's promise rests on them."""
    runs: int = Field(default=60, ge=30, le=1000)
    """Runs of an active search at most, with those of the best design at its end."""
    repeats: int = Field(default=8, ge=2, le=100)
    """Runs of the best design at the end of an active search, whose mean it promises."""
    least_gain: float = Field(default=0.001, ge=0.0, le=1e6)
    """Expected gain of a run, in the unit of the objective, below which an active search ends."""

    def contradictions(self) -> Contradictions:
        most = self.runs // 2 - 5
        if self.method == "active" and self.repeats > most:
            yield f"repeats = {self.repeats}: must be 2 to {most} with runs = {self.runs}"


class Design(Parameters):
    """Table `design` of a study."""

    option: tuple[str, ...] = Field(min_length=1, max_length=100)
    """Options of the study among which a design chooses; in a file also one name."""
    variables: dict[str, DesignVariable] = Field(default_factory=dict, max_length=64)
    """Variables by dotted key of an option's or the machine's value, with its unit."""
    objectives: dict[str, Objective] = Field(min_length=1, max_length=16)
    constraints: dict[str, Constraint] = Field(default_factory=dict, max_length=32)
    tolerances: dict[str, Tolerance] = Field(default_factory=dict, max_length=64)
    tolerance_samples: int = Field(default=64, ge=1, le=1_000_000)
    """Samples of the tolerances, the same for all designs."""
    sampling: Literal["grid", "latin-hypercube", "sobol"] = "grid"
    samples: int = Field(default=1000, ge=1, le=100_000_000)
    """Designs of a sample."""

    search: Search = Search()

    @field_validator("option", mode="before")
    @classmethod
    def _names(cls, value: Any) -> Any:
        return (value,) if isinstance(value, str) else value

    @field_validator("variables", "tolerances", mode="before")
    @classmethod
    def _dotted(cls, value: Any) -> Any:
        return flattened(value) if isinstance(value, Mapping) else value

    def contradictions(self) -> Contradictions:
        if len(set(self.option)) < len(self.option):
            yield "option: names one twice"
        if self.search.method == "active" and len(self.objectives) > 1:
            yield "search.method = active: must have one objective; make the others constraints"


def flattened(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Tables by dotted key, written in quotes or not: `options.weight.mass_kg = { range }`."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        inner = isinstance(value, Mapping) and bool(value) and not _ENDS & set(value)
        flat |= flattened(value, f"{prefix}{key}.") if inner else {f"{prefix}{key}": value}
    return flat
