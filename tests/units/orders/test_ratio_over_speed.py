"""Ratios over the speed: amplitude and unwrapped phase, and the error between speeds."""

import numpy as np
import pytest

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders.ratio_over_speed import (
    interpolation_error,
    is_studied,
    ratio_over_speed,
    used_speeds,
)


def test_amplitude_and_phase_are_linear_across_180_degrees():
    ratio = np.array([[1.0 * np.exp(1j * np.radians(170)), 3.0 * np.exp(1j * np.radians(-170))]])
    (found,) = ratio_over_speed(np.array([1000.0, 1400.0]), ratio, np.array([1000.0, 1100, 1200]))
    np.testing.assert_allclose(np.abs(found), [1.0, 1.5, 2.0])
    np.testing.assert_allclose(np.degrees(np.angle(found)) % 360.0, [170.0, 175.0, 180.0])


def test_an_even_speed_near_one_of_the_study():
    ratio = np.array([[0.5, 0.25j], [2.0, 4.0]])
    found = ratio_over_speed(np.array([1000.0, 2000.0]), ratio, np.array([1950.0, 1990.0]))
    np.testing.assert_allclose(found, [[0.25j, 0.25j], [4.0, 4.0]], atol=1e-15)


def test_beyond_the_ends_a_ratio_is_constant():
    found = ratio_over_speed(np.array([1000.0, 2000.0]), np.array([[1.0, 3.0]]),
                             np.array([960.0, 1500.0, 2090.0]))  # fmt: skip
    np.testing.assert_allclose(found, [[1.0, 2.0, 3.0]])
    studied = is_studied(np.array([1000.0, 2000.0]), np.array([940.0, 960.0, 2090.0, 2110.0]))
    assert studied.tolist() == [False, True, True, False]


def test_speeds_that_surround_those_of_a_recording():
    speeds = np.array([1000.0, 1500.0, 2000.0, 3000.0])
    assert used_speeds(speeds, 1600.0, 1900.0).tolist() == [1, 2]
    assert used_speeds(speeds, 900.0, 1600.0).tolist() == [0, 1, 2]
    assert used_speeds(speeds, 2900.0, 3100.0).tolist() == [3]


@pytest.mark.parametrize("speeds", [(3000.0, 3100.0), (500.0, 940.0)])
def test_a_speed_far_from_the_study_is_refused(speeds):
    with pytest.raises(ParameterError, match="the study 1000: they must overlap, or be at"):
        ratio_over_speed(np.array([1000.0]), np.ones((1, 1)), np.array(speeds))


def test_the_error_is_that_of_each_speed_left_out():
    """Of N², h²/2 at twice the gap h of 500 rpm, worst where N² is least; of a straight line 0."""
    speeds = np.array([1000.0, 1500.0, 2000.0, 2500.0])
    ratio = np.array([speeds**2, speeds], dtype=complex)
    expected = [500.0**2 / 1500.0**2, 0.0]
    np.testing.assert_allclose(interpolation_error(speeds, ratio), expected, atol=1e-12)
    between = np.linspace(1000.0, 2500.0, 301)
    found = ratio_over_speed(speeds, ratio, between)[0]
    assert np.max(np.abs(found / between**2 - 1.0)) <= expected[0] / 4.0 * (1500.0 / 1224.0) ** 2


def test_the_error_of_close_speeds_is_none_and_that_of_two_is_unknown():
    assert interpolation_error(np.array([1000.0, 1050.0]), np.ones((1, 2))) == 0.0
    assert np.isnan(interpolation_error(np.array([1000.0, 1100.0]), np.ones((1, 2))))
