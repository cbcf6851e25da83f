"""Rules of countries: their printed examples, limits and rounding."""

import numpy as np
import pytest
from scipy.special import ndtr

from vibroacoustics.permits.rule import PERMIT_RULES, PermitUnit
from vibroacoustics.permits.verdict import judged, least_distance_m, level_of

LAI_TABLE_5_M = (
    1.0, 1.2, 1.7, 2.2, 3.0, 3.9, 5.2, 6.7, 8.6, 10.9, 13.9, 17.6, 22.2, 25.4, 29.4, 34.4, 40.8,
    48.8, 58.9, 71.7, 87.6,
)  # fmt: skip


def unit(power=60.0, tone=0.0, **more):
    return PermitUnit(day_power_dba=power, tone_adjustment_db=tone, **more)


def window(kind, **values):
    return PERMIT_RULES[kind](**values)


def level(one, at):
    return level_of({"unit": one}, {"unit": at})[1]


def verdict(one, at):
    return judged({"unit": one}, {"unit": at})


@pytest.mark.parametrize(
    ("emission", "least_m"), list(zip(range(40, 82, 2), LAI_TABLE_5_M, strict=True))
)
def test_least_distances_of_the_lai_guide(emission, least_m):
    """LAI guide 2023, table 5, pure residential: within 0.15 m."""
    at = window("lai-guide", area="purely-residential", distance_m=10.0)
    found = least_distance_m({"unit": unit(emission)}, {"unit": at})
    assert found == pytest.approx(least_m, abs=0.12)


@pytest.mark.parametrize("period", ["day", "night"])
def test_the_lai_guide_judges_the_night(period):
    """40 - 6 dB in a general residential area; a limit of one's own is taken as it is."""
    common = {"distance_m": 10.0, "period": period}
    assert window("lai-guide", area="general-residential", **common).allowed_dba == 34.0
    assert window("lai-guide", limit_dba=33.0, **common).allowed_dba == 33.0


def test_a_screen_behind_the_window_is_refused():
    with pytest.raises(ValueError, match="must be below distance_m = 6 m"):
        window("nl-bbl", distance_m=6.0, screen_distance_m=8.0)


def test_what_a_tone_costs_by_the_lai_guide():
    """62 dB(A) at a wall, general residential: 13.9 m without a tone, 19.7 m with 3 dB."""
    at = window("lai-guide", area="general-residential", distance_m=10.0, reflection_db=3)
    found = verdict(unit(62.0, 3.0), at)
    assert found.least_distance_m == pytest.approx(19.7, abs=0.05)
    assert found.least_distance_m - found.tone_m == pytest.approx(13.9, abs=0.05)


@pytest.mark.parametrize(("period", "printed"), [("day", 47.4), ("night", 33.4)])
def test_the_calculator_of_the_heat_pump_association(period, printed):
    """59 and 51 dB(A), K_T 3, at a wall, 6 m."""
    one = unit(59.0, 3.0, night_power_dba=51.0)
    at = window("bwp", area="general-residential", period=period, distance_m=6.0, room_angle_db=6)
    assert round(level(one, at), 1) == printed


def test_hours_of_raised_sensitivity():
    """56 dB(A) all day on a weekday in a general residential area: 57.9."""
    common = {"distance_m": 10.0, "period": "day", "day": "weekday"}
    plain = level(unit(), window("ta-laerm", area="mixed", **common))
    raised = level(unit(), window("ta-laerm", area="general-residential", **common))
    assert 56.0 + raised - plain == pytest.approx(57.9, abs=0.05)


@pytest.mark.parametrize(
    ("surfaces", "view", "barrier", "expected"),
    [
        (2, "full", "solid", 42.0),  # manual of Panasonic, p. 99: 67 dB(A), Q 4, 10 m
        (1, "full", "solid", 39.0), (3, "full", "solid", 45.0),
        (2, "partial", "solid", 37.0), (2, "none", "solid", 32.0),
        (2, "partial", "thin", 39.5), (2, "none", "thin", 37.0),
    ],
)  # fmt: skip
def test_mcs_020(surfaces, view, barrier, expected):
    at = window("mcs-020", distance_m=10.0, surfaces=surfaces, view=view, barrier=barrier)
    assert level(unit(67.0, 6.0, night_power_dba=50.0), at) == pytest.approx(expected, abs=0.05)


def test_mcs_020_is_rounded_to_a_tenth():
    """37.04 meets 37.0, 37.06 does not."""
    at = window("mcs-020", distance_m=10.0)
    spread = level(unit(0.0), at)
    assert verdict(unit(37.04 - spread), at).is_met
    assert not verdict(unit(37.06 - spread), at).is_met


def test_the_earlier_mcs_020_adds_a_background():
    """A level of 37.7 beside 40 dB(A) is 42.0."""
    at = window("mcs-020", distance_m=10.0, version="older")
    one = unit(37.7 - level(unit(0.0), window("mcs-020", distance_m=10.0)))
    assert level(one, at) == pytest.approx(10.0 * np.log10(10.0**3.77 + 10.0**4.0))
    assert at.allowed_dba == 42.0
    assert verdict(one, at).is_met


def test_cercle_bruit():
    """60 dB(A) at a wall, 14 m, at night: L_eq 32, L_r 44."""
    at = window("cercle-bruit", area="II", distance_m=14.0, directivity_db=6)
    assert round(at.level_lines(unit(60.0))[-1].value) == 32
    assert round(level(unit(60.0), at)) == 44
    half = window("cercle-bruit", area="II", distance_m=14.0, directivity_db=6, operating_hours=6)
    assert level(unit(60.0), half) == pytest.approx(level(unit(60.0), at) - 3.01, abs=0.01)


def test_netherlands_adds_5_db_for_a_tone_of_any_size():
    at = window("nl-bbl", distance_m=6.0)
    assert level(unit(tone=3.0), at) == pytest.approx(level(unit(), at) + 5.0)
    assert at.allowed_dba == 40.0
    assert window("nl-bbl", distance_m=6.0, period="day").allowed_dba == 45.0


def test_france_limits_the_emergence():
    """3 dB over the background means as loud as the background: at 30 dB(A) 30 - 0.02."""
    at = window("fr-emergence", distance_m=6.0, background_dba=30.0)
    assert at.allowed_dba == pytest.approx(30.0 + 10.0 * np.log10(10.0**0.3 - 1.0))
    day = window("fr-emergence", distance_m=6.0, background_dba=30.0, period="day")
    assert day.allowed_dba == pytest.approx(33.35, abs=0.01)


@pytest.mark.parametrize(("level_db", "is_met"), [(40.49, True), (40.50, False)])
def test_german_levels_are_compared_in_whole_decibels(level_db, is_met):
    """LAI 2023 with DIN 1333: 40.49 meets 40, 40.50 does not."""
    at = window("bwp", area="general-residential", distance_m=6.0)
    found = verdict(unit(level_db - level(unit(0.0), at)), at)
    assert found.is_met == is_met


@pytest.mark.parametrize(("deviation", "expected"), [(3.0, 0.57), (1.5, 0.63)])
def test_probability_at_the_limit(deviation, expected):
    at = window("bwp", area="general-residential", distance_m=6.0)
    one = unit(40.0 - level(unit(0.0), at), deviation_db=deviation)
    assert verdict(one, at).probability == pytest.approx(expected, abs=0.005)


def test_energies_of_units_add_and_errors_do_not():
    """Two equal units: 3 dB more, and 1/√2 of the deviation."""
    at = window("bwp", area="general-residential", distance_m=6.0)
    one = unit(40.0 - level(unit(0.0), at))
    both = judged({"a": one, "b": one}, {"a": at, "b": at})
    assert both.level_dba == pytest.approx(40.0 + 10.0 * np.log10(2.0))
    over = 40.5 - both.level_dba
    assert both.probability == pytest.approx(ndtr(over / (1.5 / np.sqrt(2.0))))


def test_the_least_distance_is_where_the_rounded_level_meets_the_limit():
    for kind, more in (
        ("ta-laerm", {"area": "purely-residential", "receiver_ground_ratio": 1.0}),
        ("mcs-020", {}), ("cercle-bruit", {"area": "I"}), ("nl-bbl", {}),
    ):  # fmt: skip
        one, at = unit(75.0, 3.0), window(kind, distance_m=6.0, **more)
        least = verdict(one, at).least_distance_m
        for factor, is_met in ((0.995, False), (1.005, True)):
            moved = at.model_copy(update={"distance_m": least * factor})
            assert verdict(one, moved).is_met == is_met, (kind, factor)


def test_an_unreachable_limit_has_no_least_distance():
    at = window("mcs-020", distance_m=10.0, limit_dba=0.0)
    assert np.isnan(verdict(unit(140.0), at).least_distance_m)
