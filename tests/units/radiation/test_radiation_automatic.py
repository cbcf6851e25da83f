"""Automatic settings of the radiation: cells of the near field, step of the table."""

import numpy as np
import pytest

from vibroacoustics.base.constants import SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation.bodies import block, sphere
from vibroacoustics.radiation.by_cut_cells import near_spacing_m
from vibroacoustics.radiation.exact import Mirror, green
from vibroacoustics.radiation.interpolation import interpolant
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.radiation.transfer_vectors import frequencies_hz
from vibroacoustics.study.radiation import RadiationSettings
from vibroacoustics.study.surroundings import Cabinet, Surroundings, Wall

BALL = Scene(sphere(0.09), (), ())
PLATE = Scene(block(np.zeros(3), np.array([0.5, 0.5, 0.02])), (), ())


def test_body_decides_at_low_frequencies():
    """A sphere has a third of its radius of volume per area, a wide plate half its thickness."""
    low = RadiationSettings(maximum_frequency_hz=500.0)
    assert near_spacing_m(BALL, low) == pytest.approx(0.09 / 6.0, rel=2e-3)
    assert near_spacing_m(PLATE, low) == 0.006


def test_wave_decides_at_high_frequencies():
    for highest_hz in (4000.0, 10000.0):
        high = RadiationSettings(maximum_frequency_hz=highest_hz)
        expected = SPEED_OF_SOUND_M_PER_S / highest_hz / 14.5
        assert near_spacing_m(BALL, high) == near_spacing_m(PLATE, high) == pytest.approx(expected)


def test_panels_are_as_thick_as_the_coarser_cells():
    cabinet = Cabinet(depth_m=0.5, width_m=0.5, height_m=0.6, panel_thickness_m=0.012)
    settings = RadiationSettings(
        maximum_frequency_hz=500.0, surroundings=Surroundings(cabinet=cabinet)
    )
    assert near_spacing_m(BALL, settings) == pytest.approx(0.008)


def test_spacing_of_the_study_is_kept():
    settings = RadiationSettings(maximum_frequency_hz=500.0, near_field_spacing_m=0.02)
    assert near_spacing_m(BALL, settings) == 0.02


def with_walls(*distances_m: float, **values: float) -> RadiationSettings:
    """Settings with hard walls at distances along −x and −y."""
    walls = {side: Wall(distance_m=at) for side, at in zip(("-x", "-y"), distances_m, strict=False)}
    return RadiationSettings(
        surroundings=Surroundings(walls=walls), maximum_frequency_hz=1000.0, **values
    )


def test_step_of_the_table_is_a_whole_part_of_25_hz():
    steps = [with_walls(*at).table_step_hz for at in ((), (0.35, 0.35), (1.0,), (1.5, 1.5))]
    assert steps == [25.0, 25.0, 12.5, 25.0 / 3.0]
    assert with_walls(3.0, frequency_step_hz=50.0).table_step_hz == 50.0


def pressure(receiver, frequency_hz, mirrors):
    """Of a monopole at the origin, of unit volume velocity, over the air's density."""
    return 2j * np.pi * frequency_hz * green(receiver, np.zeros(3), frequency_hz, mirrors)[:, 0]


@pytest.mark.parametrize("distances_m", [(0.8,), (1.0,), (2.0,), (2.0, 3.0)])
def test_echoes_are_resolved(distances_m):
    """The error between tabulated frequencies is at most 0.01 dB an echo, of the direct sound.

    The piece about 0 Hz is two steps wide, which is 16 times the error of fourth order.
    """
    settings = with_walls(*distances_m)
    mirrors = [Mirror(axis=axis, sign=-1, position_m=-at) for axis, at in enumerate(distances_m)]
    receiver = np.array([[0.9, 0.4, 0.1]])

    def error(table_hz, from_hz, to_hz):
        between_hz = np.linspace(from_hz, to_hz, 500)
        response = pressure(receiver, table_hz, mirrors)
        found = interpolant(table_hz, response, np.linalg.norm(receiver))(between_hz)
        wrong = np.abs(found - pressure(receiver, between_hz, mirrors))
        return np.max(wrong / np.abs(pressure(receiver, between_hz, [])))

    table_hz = frequencies_hz(settings)
    allowed = (2.0 ** len(mirrors) - 1.0) * (2.0 * np.pi * 0.13) ** 4 / 384.0
    assert error(table_hz, 75.0, 900.0) < allowed
    assert error(table_hz, 1.0, 75.0) < 16.0 * allowed
    assert error(table_hz[1::2], 75.0, 900.0) > 10.0 * error(table_hz, 75.0, 900.0)
