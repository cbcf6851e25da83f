"""Scoring: scale and weight of each criterion, and the values that a study gives."""

from collections.abc import Collection, Mapping

from pydantic import Field

from ..base.parameters import Contradictions, Parameters
from .criterion import CRITERIA

Given = Mapping[str, Mapping[str, float]]
"""Values of criteria that are judged, not computed, by option and criterion."""


class PublishedTable(Parameters):
    """A published table of scores, as printed."""

    source: str
    options: tuple[str, ...]
    criteria: tuple[str, ...]
    scores: tuple[tuple[float, ...], ...]
    """One row per option."""
    sums: tuple[float, ...]


class CriterionScale(Parameters):
    """Weight of a criterion and the values that count as best and worst, in its unit.

    Fixed scales keep a score from changing when an option is added or left out. More is better
    where `best` lies above `worst`.
    """

    weight: float = Field(ge=0.0, le=1e6)
    best: float
    worst: float
    title: str = Field(default="", max_length=60)
    """Title in reports in place of the criterion's words; these where empty."""
    label: str = ""
    """Plain words of a given criterion; those of its name where empty."""
    unit: str = ""
    """Unit of a given criterion; that of its name's suffix where empty."""

    def contradictions(self) -> Contradictions:
        if self.worst == self.best:
            yield f"worst = {self.worst:g}: must differ from best"


class Measurable(Parameters):
    """Smallest changes that could be measured; an option is called better or worse by these only.

    Assumed: 0.5 dB is what a sound level meter repeats at one place, 5 % what a force under a foot
    repeats from one mounting to the next; near 0 dB in a band of 1 Hz is the noise that a measuring
    microphone makes itself at 50 Hz.
    """

    level_db: float = Field(default=0.5, gt=0.0, le=20.0)
    force_ratio: float = Field(default=0.05, gt=0.0, lt=1.0)
    """Share of the force or moment without the option."""
    quietest_line_db: float = Field(default=0.0, ge=-40.0, le=60.0)
    """A line that is quieter counts as this."""
    samples_ratio: float = Field(default=0.5, ge=0.0, lt=1.0)
    """Share of the samples above which a change counts."""


class Scoring(Parameters):
    criteria: dict[str, CriterionScale] = Field(min_length=1)
    measurable: Measurable = Measurable()
    random_weightings: int = Field(default=2000, ge=1, le=1_000_000)
    seed: int = Field(default=20061, ge=0, lt=2**63)
    published: PublishedTable | None = None

    def contradictions(self) -> Contradictions:
        if sum(scale.weight for scale in self.criteria.values()) <= 0.0:
            yield "at least one criterion needs a weight above 0"


def check_given(values_of_option: Given, options: Collection[str]) -> None:
    """Refuse given values that belong to no option, or whose name cannot be a criterion's.

    Raises
    ------
    ValueError
        One line that names option and key.
    """
    for option, values in values_of_option.items():
        if option not in options:
            raise ValueError(f"given.{option}: there is no such option")
        for name in values:
            where = f"options.{option}.given.{name}"
            if not name.isidentifier():
                raise ValueError(f"{where}: a criterion's name is letters, digits and underscores")
            if name in CRITERIA:
                raise ValueError(f"{where}: is the name of a computed criterion; choose another")


def check_scales(scoring: Scoring, values_of_option: Given, options: Collection[str]) -> None:
    """Refuse scored criteria that are unknown, or not given by every option.

    Raises
    ------
    ValueError
        One line that names the key.
    """
    names = {name for values in values_of_option.values() for name in values}
    for name, scale in scoring.criteria.items():
        where = f"scoring.criteria.{name}"
        if name in CRITERIA:
            if scale.label or scale.unit:
                raise ValueError(f"{where}: label and unit are for given criteria only")
        elif name not in names:
            raise ValueError(f"{where}: {CRITERIA.unknown(name, names)}")
        for option in options if name in names else ():
            if name not in values_of_option.get(option, {}):
                raise ValueError(
                    f"options.{option}.given.{name}: is missing; it is scored, so every option "
                    "needs it"
                )
