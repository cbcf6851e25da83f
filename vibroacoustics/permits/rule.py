"""Rules by which authorities judge a unit at a window; each is one file that registers itself."""

from typing import Annotated, ClassVar, Final, Literal, NamedTuple

import numpy as np
from pydantic import Field, SerializeAsAny

from ..base.arrays import Array
from ..base.decibel import energy_sum
from ..base.parameters import AnyOf, Contradictions, KindOfParameters, Parameters
from ..base.registry import Registry
from .iso_9613_2 import A_WEIGHTING_DB, OCTAVES_HZ

Period = Literal["day", "night"]


class CalculationLine(NamedTuple):
    """One line of a calculation that can be repeated with a pocket calculator.

    Attributes
    ----------
    text : quantity, and how it follows from the lines above
    value : value
    unit : unit

    Examples
    --------
    >>> va.CalculationLine("distance, r", 6.5, "m").value
    6.5
    """

    text: str
    value: float
    unit: str = "dB"


class PermitUnit(Parameters):
    """A unit outdoors and its sound power by day and at night.

    Attributes
    ----------
    day_power_dba, night_power_dba : A-weighted sound power levels; at night as by day without one
    octave_power_db : unweighted levels of the octaves 63 Hz to 8 kHz, of which the shape counts
    deviation_db : standard deviation of the level at a window by unit and propagation (assumed)
    tone_adjustment_db : K_T of 0, 3 or 6 dB; 3 where nothing is known (LAI guide 2023)
    height_m : height of the source
    capacity_w : heating capacity, for limits of sound power by law
    volume_m3 : volume of the unit

    Examples
    --------
    >>> va.PermitUnit(day_power_dba=58.0, night_power_dba=52.0).power_dba("night")
    52.0
    """

    day_power_dba: float = Field(ge=0.0, le=140.0)
    night_power_dba: float | None = Field(default=None, ge=0.0, le=140.0)
    octave_power_db: tuple[float, ...] | None = None
    deviation_db: float = Field(default=1.5, ge=0.0, le=10.0)
    tone_adjustment_db: float = Field(default=3.0, ge=0.0, le=6.0)
    height_m: float = Field(default=1.0, ge=0.1, le=100.0)
    capacity_w: float | None = Field(default=None, gt=0.0, le=1e6)
    volume_m3: float | None = Field(default=None, gt=0.0, le=1000.0)

    def contradictions(self) -> Contradictions:
        octaves = self.octave_power_db
        if octaves is not None and len(octaves) != OCTAVES_HZ.size:
            yield f"octave_power_db: has {len(octaves)} values: must be 8, of 63 Hz to 8 kHz"
        if self.tone_adjustment_db not in (0.0, 3.0, 6.0):
            yield f"tone_adjustment_db = {self.tone_adjustment_db:g}: must be 0, 3 or 6"

    def power_dba(self, period: Period) -> float:
        """A-weighted sound power level in a period."""
        if period == "night" and self.night_power_dba is not None:
            return self.night_power_dba
        return self.day_power_dba

    def octaves_db(self, period: Period) -> Array:
        """Unweighted octaves with the A-weighted level of a period, shape (octave,), dB."""
        shape: Array = np.array(self.octave_power_db or [0.0] * OCTAVES_HZ.size)
        total = float(energy_sum(shape + A_WEIGHTING_DB, axis=0))
        return np.asarray(shape + self.power_dba(period) - total)


class PermitRule(KindOfParameters):
    """A window or boundary at which units are judged, by the rule of an authority.

    A further one is one file of `permits/rules`, or of a third party, whose class is registered.

    Attributes
    ----------
    distance_m : horizontal distance of the units
    period : day or night
    limit_dba : limit in place of that of the rule

    Examples
    --------
    >>> class Elsewhere(va.PermitRule):
    ...     kind, title, edition = "elsewhere", "Elsewhere", "made up, 2026"
    ...     def level_lines(self, unit):
    ...         level = unit.day_power_dba - 28.0 - 0.6 * (self.distance_m - 10.0)
    ...         return [va.CalculationLine("level", level, "dB(A)")]
    >>> Elsewhere(distance_m=10.0).level_lines(va.PermitUnit(day_power_dba=60.0))[-1].value
    32.0
    """

    title: ClassVar[str]
    """Title in reports."""
    edition: ClassVar[str]
    """Document with its date."""
    decimals: ClassVar[int | None] = None
    """Decimals of the level that is compared; None compares it as computed."""
    limits: ClassVar[str] = ""
    """Sentence on parts of the rule that are not computed."""

    distance_m: float = Field(gt=0.1, le=2000.0)
    period: Period = "night"
    limit_dba: float | None = Field(default=None, ge=0.0, le=120.0)

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        """Compute the level of one unit; the last line is the level.

        Parameters
        ----------
        unit : sound power
        """
        raise NotImplementedError

    def adjustment_lines(self) -> list[CalculationLine]:
        """Return what is added to the level of all units; nothing by default."""
        return []

    def last_lines(self, level_db: float) -> list[CalculationLine]:
        """Return lines that lead to the level that is compared, the last; by default it stays.

        Parameters
        ----------
        level_db : level of all units with their adjustments
        """
        return []

    @property
    def allowed_dba(self) -> float:
        """Limit of the rule, or the given one."""
        raise NotImplementedError

    def refusals(self, unit: PermitUnit) -> list[str]:
        """Say what the rule does not allow of a unit, a line each; nothing by default.

        Parameters
        ----------
        unit : unit
        """
        return []


PERMIT_RULES: Final[Registry[type[PermitRule]]] = Registry(
    "permit rules", PermitRule, "kind", "permits.rules", "vibroacoustics.permit_rules"
)
"""Rules by kind."""

AnyRule = Annotated[SerializeAsAny[PermitRule], AnyOf(PERMIT_RULES)]
