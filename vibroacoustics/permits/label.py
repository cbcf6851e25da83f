"""Limits of the sound power of heat pumps by heating capacity: EU law and German subsidy."""

from typing import Final, NamedTuple

from .rule import PermitUnit
from .verdict import probability

CAPACITY_W: Final = (6e3, 12e3, 30e3, 70e3)
"""Largest capacity of each class."""
LIMITS_DBA: Final = {
    "EU 813/2013, annex II": (65.0, 70.0, 78.0, 88.0),
    "BEG since 1 January 2026": (55.0, 60.0, 68.0, 78.0),
}


class LabelLimit(NamedTuple):
    """Limit of a unit's sound power by day.

    Attributes
    ----------
    law : law or subsidy, with its date
    limit_dba : largest A-weighted sound power level
    is_met : whether the stated level is at most the limit
    probability : that a measured unit meets it, by the deviation of the unit
    """

    law: str
    limit_dba: float
    is_met: bool
    probability: float


def label_limits(unit: PermitUnit) -> list[LabelLimit]:
    """Return the limits for the capacity of a unit; none without one, or above 70 kW.

    Parameters
    ----------
    unit : sound power and capacity
    """
    capacity = unit.capacity_w
    if capacity is None or capacity > CAPACITY_W[-1]:
        return []
    column = next(number for number, most in enumerate(CAPACITY_W) if capacity <= most)
    return [
        LabelLimit(
            law,
            limits[column],
            unit.day_power_dba <= limits[column],
            probability(unit.day_power_dba, unit.deviation_db, limits[column], None),
        )
        for law, limits in LIMITS_DBA.items()
    ]
