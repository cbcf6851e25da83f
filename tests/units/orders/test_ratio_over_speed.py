"""Ratios over the speed: amplitude and unwrapped phase, and the speeds that a study lacks."""

import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.ratio_over_speed import ratio_over_speed, speeds_to_add


def test_amplitude_and_phase_are_linear_across_180_degrees():
    ratio = np.array([[1.0 * np.exp(1j * np.radians(170)), 3.0 * np.exp(1j * np.radians(-170))]])
    (found,) = ratio_over_speed(np.array([1000.0, 1040.0]), ratio, np.array([1000.0, 1010, 1020]))
    np.testing.assert_allclose(np.abs(found), [1.0, 1.5, 2.0])
    np.testing.assert_allclose(np.degrees(np.angle(found)) % 360.0, [170.0, 175.0, 180.0])


def test_an_even_speed_near_one_of_the_study():
    ratio = np.array([[0.5, 0.25j], [2.0, 4.0]])
    found = ratio_over_speed(np.array([1000.0, 2000.0]), ratio, np.array([1950.0, 1990.0]))
    np.testing.assert_allclose(found, [[0.25j, 0.25j], [4.0, 4.0]], atol=1e-15)


def test_a_gap_is_refused_with_the_speeds_to_add():
    speeds = np.array([1000.0, 1050.0, 1200.0])
    message = "the recording has 1010 to 1190 rpm, of which the study lacks speeds at most 5 %"
    with pytest.raises(ParameterError, match=message) as refused:
        ratio_over_speed(speeds, np.ones((1, 3)), np.array([1010.0, 1190.0]))
    added = [float(word) for word in re.findall(r"\d+", str(refused.value).split(": ")[-1])]
    assert added == [1098.0, 1148.0]
    every = np.sort([*speeds, *added])
    ratio_over_speed(every, np.ones((1, every.size)), np.array([1010.0, 1190.0]))


@settings(suppress_health_check=[HealthCheck.too_slow])
@given(
    st.sets(st.integers(500, 6000), min_size=1, max_size=6),
    st.integers(600, 3000),
    st.floats(1.12, 3.0),
)
def test_with_the_added_speeds_nothing_is_missing(speeds, lowest, factor):
    known = np.sort(np.array(list(speeds), dtype=float))
    highest = lowest * factor
    added = speeds_to_add(known, lowest, highest)
    every = np.sort(np.concatenate([known, added]))
    found = ratio_over_speed(every, np.ones((1, every.size)), np.array([lowest, highest]))
    np.testing.assert_allclose(found, 1.0)
    needed = every[(every >= lowest) & (every <= highest)]
    assert np.all(needed[1:] <= 1.05 * needed[:-1])


def test_a_speed_far_from_the_study_is_refused():
    with pytest.raises(ParameterError, match=r"add to its speed_rpm: 3050$"):
        ratio_over_speed(np.array([1000.0]), np.ones((1, 1)), np.array([3000.0, 3100.0]))
