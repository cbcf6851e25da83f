"""Pictures of deflection, directivity, energies and run-up show the values of their variables."""

import re

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.report.figures.deflection import FRAMES, cycle, deflection_picture, shapes
from vibroacoustics.report.figures.directivity import polar_levels
from vibroacoustics.report.figures.stacked import divided

ANGLE = 2.0 * np.pi * np.arange(8) / 8
HEIGHT = np.array([-0.2, 0.0, 0.2])
OPTIONS = ["none", "ring"]


@pytest.fixture(scope="module")
def moving() -> xr.Dataset:
    """The middle ring bends as an ellipse about axes turned by 45°, the ends stay."""
    field = np.zeros((2, 3, 8, 3), dtype=complex)
    size = 1e-6j * np.cos(2.0 * (ANGLE - np.pi / 4.0))
    field[:, 1, :, 0], field[:, 1, :, 1] = size * np.cos(ANGLE), size * np.sin(ANGLE)
    field[:, 1, :, 2] = 2e-7j
    dims = ("shown_option", "station", "station_angle", "axis")
    return xr.Dataset(
        {"deflection": (dims, field), "deflection_frequency": ("shown_option", [725.0, 725.0]),
         "shown_speed": 2900.0},
        coords={
            "shown_option": OPTIONS, "station_angle": ANGLE, "axis": ["x", "y", "z"],
            "station_radius": ("station", [0.08, 0.08, 0.08]),
            "station_height": ("station", HEIGHT),
            "deflection_line": ("shown_option", ["order 15", "order 15"]),
        },
    )  # fmt: skip


def test_views_hold_the_displacements_of_the_shell(moving):
    ring, side = shapes(moving.sel(shown_option="none"))
    field = moving["deflection"].sel(shown_option="none").values
    for point in (0, 3, 6):
        expected = 0.08 * np.array([np.cos(ANGLE[point]), np.sin(ANGLE[point])])
        np.testing.assert_allclose(ring.points_m[point], expected, atol=1e-12)
        np.testing.assert_array_equal(ring.displacement_m[point], field[1, point, :2])
    # up one side at 45°, down the other at 225°: both move outwards, and up
    np.testing.assert_allclose(side.points_m[[1, 4]], [[0.08, 0.0], [-0.08, 0.0]])
    np.testing.assert_allclose(side.displacement_m[1], [1e-6j, 2e-7j], atol=1e-18)
    np.testing.assert_allclose(side.displacement_m[4], [-1e-6j, 2e-7j], atol=1e-18)
    assert ring.title == "ring 200 mm above the bottom"


def test_a_cycle_begins_at_its_largest_displacement(moving):
    ring, _ = shapes(moving.sel(shown_option="none"))
    frames = cycle(ring.displacement_m, ring.displacement_m)
    size = np.abs(frames).max(axis=(1, 2))
    assert size[0] == pytest.approx(np.abs(ring.displacement_m).max())
    np.testing.assert_allclose(frames[FRAMES // 2], -frames[0], atol=1e-18)
    assert size[FRAMES // 4] == pytest.approx(0.0, abs=1e-18)


def test_the_picture_moves_without_a_script(moving):
    text = deflection_picture(moving).content.decode()
    motions = re.findall(
        r'<path class="moving" d="([^"]+)"[^>]*><animate [^>]*values="([^"]+)"', text
    )
    assert len(motions) == 2 * len(OPTIONS)
    for first, values in motions:
        frames = values.split(";")
        assert len(frames) == FRAMES + 1
        assert frames[0] == frames[-1] == first
        assert len({frame.count("L") for frame in frames}) == 1
    assert "<script" not in text


def test_directivity_is_drawn_where_its_directions_are():
    direction = 2.0 * np.pi * np.arange(36) / 36
    level = 40.0 + 5.0 * np.cos(direction) + np.zeros((2, 1, 2, 36))
    dims = ("shown_option", "polar_band", "polar_plane", "polar_direction")
    coords = {
        "shown_option": OPTIONS, "polar_band": [500.0],
        "polar_plane": ["horizontal", "vertical"], "polar_direction": direction,
    }  # fmt: skip
    around = xr.Dataset(
        {"polar_level": (dims, level), "polar_radius": 1.1, "shown_speed": 2900.0}, coords
    ).assign_attrs(parameters='{"catalogue_receiver": "front_1m"}')
    horizontal, vertical = polar_levels(around).panels
    for degrees in (0.0, 60.0, 180.0):
        for panel in (horizontal, vertical):
            line = panel.marks[1]
            point = np.flatnonzero(np.isclose(line.x, degrees))[0]
            assert line.y[point] == pytest.approx(40.0 + 5.0 * np.cos(np.deg2rad(degrees)))
    assert vertical.polar
    assert horizontal.y.limits == (15.0, 45.0)


def test_a_bar_is_divided_by_shares_of_the_energy():
    # 60 dB, of which a quarter, three quarters and nothing: one works against the others
    share = np.array([[0.3], [0.9], [-0.2]])
    starts, sizes = divided(share, np.array([60.0]), 20.0)
    np.testing.assert_allclose(starts[:, 0], [20.0, 30.0, 60.0])
    np.testing.assert_allclose(sizes[:, 0], [10.0, 30.0, 0.0], atol=1e-9)
