"""Limits and adjustments of the German TA Lärm."""

from ...base.registry import register
from ..rating_rule import RatingRules

TA_LAERM = RatingRules(
    name="ta-laerm",
    title="TA Lärm",
    source=(
        "TA Lärm 1998, 6.1 (limits as quoted by hlnug.de; urban areas since 2017), 6.5, A.1.4; "
        "steps of 3 and 6 dB (A.3.3.5) by audibility are assumed"
    ),
    rating_time_s={"night": 3600.0, "day": 16.0 * 3600.0},
    tonal_steps=((2.0, 0.0), (9.0, 3.0)),
    largest_adjustment_db=6.0,
    limits_dba={
        "industrial": {"day": 70.0, "night": 70.0},
        "commercial": {"day": 65.0, "night": 50.0},
        "urban": {"day": 63.0, "night": 45.0},
        "mixed": {"day": 60.0, "night": 45.0},
        "general-residential": {"day": 55.0, "night": 40.0},
        "purely-residential": {"day": 50.0, "night": 35.0},
        "spa": {"day": 45.0, "night": 35.0},
    },
    sensitive_areas=("general-residential", "purely-residential", "spa"),
    sensitive_raise_db=6.0,
    sensitive_time_s={"day": 7.0 * 3600.0},
)
register(TA_LAERM)
