"""Spacing of k-Wave's grid: automatic or the study's, and checked only where k-Wave runs."""

import numpy as np
import pytest

from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation.box import closed_box
from vibroacoustics.radiation.room_green import CLEAR_NODES, check_receiver
from vibroacoustics.radiation.room_greens import room_spacing_m
from vibroacoustics.radiation.scene import scene
from vibroacoustics.radiation.task import Task
from vibroacoustics.radiation.transfer_vectors import frequencies_hz
from vibroacoustics.study.radiation import RadiationSettings

SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)
BOX = closed_box([np.linspace(-0.3, 0.3, 7)] * 3, [1] * 3, [5] * 3, [])
"""From -0.2 to 0.2 m along each axis."""


def _task(x_m: float, highest_hz: float, spacing_m: float | None = None) -> Task:
    settings = RadiationSettings(maximum_frequency_hz=highest_hz, room_spacing_m=spacing_m)
    table = frequencies_hz(settings)
    places = {"far": np.array([3.0, 0.0, 0.2]), "near": np.array([x_m, 0.0, 0.2])}
    return Task(scene(SHELL, settings), [], places, settings, table, table.size, tuple(places))


@pytest.mark.parametrize(
    ("highest_hz", "wave_m"), [(10_000.0, 343.0 / 4000.0), (2500.0, 343.0 / 2500.0)]
)
def test_automatic_spacing_has_four_nodes_in_the_shortest_wave(
    highest_hz: float, wave_m: float
) -> None:
    assert room_spacing_m(BOX, _task(1.2, highest_hz)) == pytest.approx(wave_m / 4.0)


def test_automatic_spacing_is_60_mm_at_most() -> None:
    assert room_spacing_m(BOX, _task(1.2, 100.0)) == 0.06


def test_automatic_spacing_shrinks_for_a_near_microphone() -> None:
    """The microphone at 0.3 m off the box, which 60 mm would refuse."""
    task = _task(0.5, 500.0)
    spacing = room_spacing_m(BOX, task)
    assert spacing == pytest.approx(0.3 / (CLEAR_NODES + 1))
    check_receiver("near", task.positions["near"], BOX, spacing, task.scene.walls, 4)


def test_spacing_of_the_study_is_kept() -> None:
    assert room_spacing_m(BOX, _task(1.2, 1000.0, 0.05)) == 0.05


def test_spacing_is_checked_only_where_a_grid_is_built() -> None:
    coarse = {"maximum_frequency_hz": 2000.0, "room_spacing_m": 0.1}
    with pytest.raises(ValueError, match=r"room_spacing_mm = 100 mm: .* allowed up to 49 mm"):
        RadiationSettings(**coarse)
    assert RadiationSettings(**coarse, room_solver="closed-form").room_spacing_m == 0.1
