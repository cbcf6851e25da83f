"""Rules of a country for the rating level: periods, limits by area, adjustments for tones."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from ..base.registry import Registry

Steps = tuple[tuple[float, float], ...]
"""Largest mean audibility and the adjustment up to it, dB, rising."""


@dataclass(frozen=True)
class RatingRules:
    """Rules by which a rating level is formed and judged.

    Attributes
    ----------
    name : in study files
    title : title in reports
    source : document, and where its values are quoted
    rating_time_s : length of each period
    tonal_steps : adjustments for tones
    largest_adjustment_db : for tones above the last step
    limits_dba : by area and period; without areas a window gives its own limit
    sensitive_areas : areas with hours of raised sensitivity
    sensitive_raise_db : adjustment in these hours
    sensitive_time_s : largest length of these hours, by period

    Examples
    --------
    >>> rules = va.RatingRules("short", "Short", "made up", {"night": 3600.0}, ((0.0, 0.0),), 5.0)
    >>> rules.limits_dba
    {}
    """

    name: str
    title: str
    source: str
    rating_time_s: Mapping[str, float]
    tonal_steps: Steps
    largest_adjustment_db: float
    limits_dba: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    sensitive_areas: tuple[str, ...] = ()
    sensitive_raise_db: float = 0.0
    sensitive_time_s: Mapping[str, float] = field(default_factory=dict)


RATING_RULES: Final[Registry[RatingRules]] = Registry(
    "rating rules", RatingRules, "name", "study.rating_rules", "vibroacoustics.rating_rules"
)
"""Rules by name."""
