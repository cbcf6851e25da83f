"""Adjustments of ISO 1996-2, without limits."""

from ...base.registry import register
from ..rating_rule import RatingRules

ISO_1996_2 = RatingRules(
    name="iso-1996-2",
    title="ISO 1996-2",
    source="ISO 1996-2:2017, table J.1 (as DIN 45681:2005, table 1)",
    rating_time_s={"night": 8.0 * 3600.0, "day": 16.0 * 3600.0},
    tonal_steps=((0.0, 0.0), (2.0, 1.0), (4.0, 2.0), (6.0, 3.0), (9.0, 4.0), (12.0, 5.0)),
    largest_adjustment_db=6.0,
)
register(ISO_1996_2)
