"""Exponents of the speed: of two speeds, of a quantity alone, and their deviation."""

import numpy as np
import pytest

from vibroacoustics.measured.trial_runs.scatter import at_nominal_speed, slopes

SPEEDS = np.array([1500.0, 3000.0])
UNITS = {"end": "mm/s", "mic": "Pa", "foot": "N"}


@pytest.mark.parametrize("turn_deg", [0.0, 20.0])
def test_two_speeds_give_the_exponent_and_a_turning_phase_its_deviation(turn_deg):
    turn = np.deg2rad(turn_deg)
    growth = 2.0**1.3 * np.exp(1j * turn)
    readings = np.array([[1.0, growth], [2j, 2j * growth]])
    found = slopes(readings, ("end", "end"), SPEEDS, UNITS)
    np.testing.assert_allclose(found.exponent, 1.3)
    np.testing.assert_allclose(found.deviation, 0.1 + 0.5 * turn / np.log(2.0))


def test_one_speed_has_the_exponent_of_the_quantity():
    found = slopes(np.ones((2, 3), complex), tuple(UNITS), np.full(3, 1500.0), UNITS)
    assert found.exponent.tolist() == [2.0, 3.0, 2.0]
    assert found.deviation.tolist() == [1.0, 1.0, 1.0]
    far = slopes(np.ones((2, 2), complex), ("end", "end"), np.array([1000.0, 3000.0]), UNITS)
    assert far.exponent.tolist() == [2.0, 2.0]


def test_readings_are_scaled_to_the_nominal_speed():
    growth = slopes(np.array([[1.0, 4.0]]), ("end", "end"), SPEEDS, UNITS)
    actual = np.array([[1515.0, 2970.0]])
    corrected = at_nominal_speed(np.array([[1.0, 4.0]], complex), actual, SPEEDS, growth)
    np.testing.assert_allclose(corrected.readings, [[1.01**-2, 4.0 * 0.99**-2]])
    expected = corrected.readings * np.log([[1.01, 0.99]]) * growth.deviation
    np.testing.assert_allclose(corrected.by_speed, expected)
