"""Transfer vectors that are given, in place of those that are computed."""

import numpy as np
import pytest
from support import TINY

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError

FREQUENCY_HZ = 2900.0 / 60.0 * np.arange(1, 22)  # the orders themselves: nothing between them


@pytest.fixture(scope="module")
def study():
    return va.load_study(TINY)


def vectors(receivers=1, motions=6, frequencies=21):
    return 0.01 * np.ones((receivers, motions, frequencies), complex)


def test_pressure_is_velocity_times_what_is_given(study):
    results = va.run(study, radiation=va.given_radiation(vectors(), FREQUENCY_HZ))
    velocity = results["velocity_order"].sum(["source", "dof"]).sel(order=1)
    level = 20.0 * np.log10(abs(0.01 * velocity) / np.sqrt(2.0) / 20e-6)
    found = results["order_level"].sel(order=1, weighting="Z", receiver="front_1m")
    np.testing.assert_allclose(found, level, atol=1e-9)
    place = study.receivers["front_1m"]
    height = place.height_m + study.machine.shell.floor_z_m
    distance = np.sqrt(place.x_m**2 + place.y_m**2 + height**2)
    np.testing.assert_allclose(results["distance"].item(), distance)


@pytest.mark.parametrize(
    ("values", "frequency", "message"),
    [
        (vectors(motions=5), FREQUENCY_HZ, "has 5 motions, must have 6"),
        (vectors(frequencies=3), FREQUENCY_HZ, "with 21 frequencies"),
        (np.nan * vectors(), FREQUENCY_HZ, "must be finite"),
        (vectors(), FREQUENCY_HZ[::-1], "must be at least two numbers that rise"),
    ],
)
def test_shapes_are_checked(values, frequency, message):
    with pytest.raises(ParameterError, match=message):
        va.given_radiation(values, frequency)


@pytest.mark.parametrize(
    ("values", "frequency", "message"),
    [
        (vectors(receivers=2), FREQUENCY_HZ, "has 2 receivers; the study has front_1m"),
        (
            vectors(),
            FREQUENCY_HZ / 2.0,
            r"ends at 507.5 Hz; radiation\.maximum_frequency_hz is 1000",
        ),
    ],
)
def test_the_study_is_checked(study, values, frequency, message):
    with pytest.raises(ParameterError, match=message):
        va.run(study, radiation=va.given_radiation(values, frequency))
