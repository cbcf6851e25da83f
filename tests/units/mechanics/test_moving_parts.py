"""Moving parts: paths, their second derivative, force and moment."""

import numpy as np
import pytest
from support import CRANK_ANGLE, turning

from vibroacoustics.mechanics.added import Added
from vibroacoustics.mechanics.moving_parts import (
    MovingPart,
    derivative,
    path,
    wrench,
)


@pytest.mark.parametrize("order", [1, 2, 7, 127])
@pytest.mark.parametrize("samples", [255, 256])
def test_second_derivative_of_a_harmonic(order, samples):
    angle = 2.0 * np.pi * np.arange(samples) / samples
    wave = np.cos(order * angle + 0.3)
    # The rounding eps of the wave at any order is multiplied by up to 128².
    np.testing.assert_allclose(
        derivative(wave, 2), -(order**2) * wave, atol=128**2 * np.finfo(float).eps
    )


def test_second_derivative_works_along_the_last_axis():
    stack = np.stack([np.cos(CRANK_ANGLE), np.sin(2 * CRANK_ANGLE)])
    both = derivative(stack, 2)
    np.testing.assert_array_equal(both[1], derivative(stack[1], 2))


def test_force_of_a_slider_by_hand():
    """1 kg, 10 mm, 50 Hz: 986.96 N once per revolution, outwards at the dead centre."""
    slider = MovingPart("slider", 1.0, path(0.01 * np.cos(CRANK_ANGLE), 0.0, 0.2))
    force, moment = wrench([slider], turning(50.0))
    assert force[0, 0] == pytest.approx(986.96044, rel=1e-8)
    assert force[0, 128] == pytest.approx(-986.96044, rel=1e-8)
    # 0.2 m above the centre of mass a force along +x turns about +y.
    assert moment[1, 0] == pytest.approx(0.2 * 986.96044, rel=1e-8)
    assert np.max(np.abs(force[1:])) == 0.0
    assert np.max(np.abs(moment[[0, 2]])) == 0.0


def test_force_of_a_rotor_points_outwards():
    rotor = MovingPart(
        "rotor", 2.0, path(0.01 * np.cos(CRANK_ANGLE), 0.01 * np.sin(CRANK_ANGLE), 0.0)
    )
    force, moment = wrench([rotor], turning(50.0))
    np.testing.assert_allclose(
        force, 2.0 * (2.0 * np.pi * 50.0) ** 2 * rotor.position_m, atol=1e-8
    )  # 128² eps · 0.01 m · 2 kg ω² = 7e-9 N
    assert np.max(np.abs(moment)) < 1e-8


def test_path_has_three_rows_of_floats():
    stacked = path(0, CRANK_ANGLE, 1)
    assert stacked.shape == (3, 256)
    assert stacked.dtype == float


def test_balancing_of_nothing_is_empty():
    assert Added().parts == ()
    assert dict(Added().figures) == {}


def test_moving_parts_are_frozen():
    part = MovingPart("a", 1.0, path(0.0, 0.0, CRANK_ANGLE))
    with pytest.raises(AttributeError):
        part.mass_kg = 2.0
