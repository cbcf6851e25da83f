"""Rating levels by hand calculation, limits and steps as printed, refusals in one line."""

import numpy as np
import pytest
from documents import TA_LAERM
from evidence import claim

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.parameters import Parameters
from vibroacoustics.levels.rating import (
    at_window,
    rating_level_db,
    rating_levels,
    stepped_adjustment_db,
)
from vibroacoustics.study.rating import Rating
from vibroacoustics.study.rating_rule import RATING_RULES


def _rating(**window: object) -> Rating:
    first = {"receiver": "front", "area": "purely-residential", **window}
    return Rating.model_validate({"windows": {"bedroom": first}})


def test_half_of_the_time_is_three_decibels_less() -> None:
    parts = np.array([[40.0, 50.0], [-300.0, -300.0]])
    found = rating_level_db(parts, np.array([1800.0, 1800.0]), 3600.0)
    assert found == pytest.approx([40.0 - 3.0103, 50.0 - 3.0103], abs=1e-4)


def test_hours_of_raised_sensitivity_count_six_decibels_more() -> None:
    """10 h of 16 at 40 + 3 dB, of which 2 h count 6 dB more: (8 + 2 * 3.9811)/16 = 0.99763."""
    rating = _rating(period="day", operating_s=36000.0, sensitive_s=7200.0)
    found = at_window(rating, rating.windows["bedroom"], np.array([40.0]), np.array([3.0]))
    assert found == pytest.approx([43.0 - 0.0103], abs=1e-4)


def test_in_a_mixed_area_no_hour_is_more_sensitive() -> None:
    rating = _rating(area="mixed", period="day", operating_s=36000.0, sensitive_s=7200.0)
    found = at_window(rating, rating.windows["bedroom"], np.array([40.0]), np.array([0.0]))
    assert found == pytest.approx([40.0 - 2.0412], abs=1e-4)


def test_impulses_add_to_the_level() -> None:
    rating = _rating(impulse_adjustment_db=3.0)
    found = at_window(rating, rating.windows["bedroom"], np.array([31.0]), np.array([0.0]))
    assert found == pytest.approx([34.0])


def test_levels_at_a_window_are_those_of_its_microphone() -> None:
    found = rating_levels(
        _rating(), ["back", "front"], np.array([[90.0, 33.0], [90.0, 33.0]]),
        np.array([[20.0, 1.9], [20.0, 2.1]]),
    )  # fmt: skip
    assert found["rating_adjustment"] == pytest.approx(np.array([[0.0], [3.0]]))
    assert found["rating_level"] == pytest.approx(np.array([[33.0], [36.0]]))
    assert found["limit_probability"] == pytest.approx(np.array([[1.0], [0.0]]))


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        ("ta-laerm", [0, 0, 0, 3, 3, 3, 6, 6, 6]),
        ("iso-1996-2", [0, 1, 1, 2, 3, 4, 5, 5, 6]),
    ],
)
def test_steps_of_the_adjustment(rules: str, expected: list[int]) -> None:
    audibility = np.array([-10.0, 0.1, 2.0, 4.0, 6.0, 9.0, 9.1, 12.0, 12.1])
    assert stepped_adjustment_db(audibility, RATING_RULES[rules]).tolist() == expected


@pytest.mark.parametrize(
    ("area", "day", "night"),
    [
        ("industrial", 70, 70), ("commercial", 65, 50), ("urban", 63, 45), ("mixed", 60, 45),
        ("general-residential", 55, 40), ("purely-residential", 50, 35), ("spa", 45, 35),
    ],
)  # fmt: skip
def test_limits_of_ta_laerm(area: str, day: int, night: int) -> None:
    for period, limit in (("day", day), ("night", night)):
        rating = _rating(area=area, period=period)
        claim(
            f"Limit of an area {area} at {period}", kind="printed", source=TA_LAERM("6.1"),
            computed=rating.limit_dba(rating.windows["bedroom"]), reference=limit, tolerance=0.5,
            unit="dB(A)", topics=("rating",),
        )  # fmt: skip


@pytest.mark.parametrize(
    ("window", "words"),
    [
        ({"area": "forest"}, "windows.bedroom.area = forest: allowed industrial, commercial"),
        ({"area": ""}, "windows.bedroom: give area"),
        ({"operating_s": 7200.0}, "operating_min = 120 min: allowed up to 60 min for period"),
        ({"sensitive_s": 60.0}, "sensitive_min = 1 min: allowed up to 0 min"),
    ],
)
def test_a_wrong_window_is_refused(window: dict[str, object], words: str) -> None:
    with pytest.raises((ParameterError, ValueError), match=words):
        _rating(**window)


def test_rules_without_limits_need_a_limit() -> None:
    window = {"receiver": "front"}
    with pytest.raises(ValueError, match="give limit_dba: these rules have no limits"):
        Rating.model_validate({"rules": "iso-1996-2", "windows": {"a": window}})
    given = {"rules": "iso-1996-2", "windows": {"a": {**window, "limit_dba": 42.0}}}
    rating = Rating.model_validate(given)
    assert rating.limit_dba(rating.windows["a"]) == 42.0
    assert isinstance(rating, Parameters)
