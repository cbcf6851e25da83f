"""Spreading of unmodelled noise: distance law, images and ground by a second method."""

from pathlib import Path

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.base.constants import SPEED_OF_SOUND_M_PER_S
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.radiation.spreading import spreading_of

STUDY = Path(__file__).parents[2] / "studies" / "small.toml"
BANDS_HZ = np.array([100.0, 1000.0, 4000.0])
FAR = {"x_mm": 6000.0, "y_mm": 0.0, "height_mm": 1500.0}


def _study(changes: dict[str, object]) -> va.Study:
    return va.load_study(STUDY).replace({"receivers.far": FAR, **changes})


def test_noise_over_a_hard_floor_falls_with_the_square_of_the_distance() -> None:
    by_microphone = spreading_of(_study({}), BANDS_HZ)
    published_m2 = 1.0825**2 + 0.23**2
    assert by_microphone["front_1m"] == pytest.approx(np.ones(3), abs=1e-15)
    assert by_microphone["far"] == pytest.approx(published_m2 / (36.0 + 2.25), rel=1e-12)


def test_noise_of_equally_far_microphones_is_the_same() -> None:
    ring = {"x_mm": 0.0, "y_mm": -1082.5, "height_mm": 230.0}
    assert spreading_of(_study({"receivers.ring": ring}), BANDS_HZ)["ring"] == pytest.approx(
        np.ones(3), abs=1e-12
    )


def test_a_wall_behind_the_machine_adds_its_images() -> None:
    """Images of floor and wall by loops, over more frequencies than the function has."""
    study = _study(
        {
            "radiation.room_solver": "closed-form",
            "radiation.surroundings.walls.-x": {"distance_mm": 500.0, "absorption_ratio": 0.19},
        }
    )
    shell, mean = study.machine.shell, {}
    heights = np.array([1.0, 3.0, 5.0]) / 6.0 * shell.height_m + shell.floor_clearance_m
    radius = 0.5 * shell.outer_diameter_m
    for name in ("front_1m", "far"):
        receiver = study.receivers[name]
        square = np.zeros((3, 200))
        hertz = BANDS_HZ[:, None] * 10.0 ** np.linspace(-0.05, 0.05, 200)
        for height in heights:
            for x, y in ((radius, 0.0), (-radius, 0.0), (0.0, radius), (0.0, -radius)):
                field = np.zeros((3, 200), complex)
                for up in (1.0, -1.0):
                    for image_x, strength in ((x, 1.0), (-1.0 - x, 0.9)):
                        away = np.linalg.norm([
                            receiver.x_m - image_x, receiver.y_m - y,
                            receiver.height_m - up * height,
                        ])  # fmt: skip
                        turn = 2.0 * np.pi * hertz / SPEED_OF_SOUND_M_PER_S * away
                        field += strength * np.exp(-1j * turn) / away
                square += np.abs(field) ** 2
        mean[name] = square.mean(axis=1)
    found = 10.0 * np.log10(spreading_of(study, BANDS_HZ)["far"])
    expected = 10.0 * np.log10(mean["far"] / mean["front_1m"])
    assert found == pytest.approx(expected, abs=0.3)


def test_soft_ground_and_a_barrier_take_more_than_distance() -> None:
    ground = {
        "radiation.room_solver": "closed-form",
        "radiation.surroundings.ground": {"material": "pasture"},
    }
    fence = {"side": "+x", "distance_mm": 3000.0, "height_mm": 1800.0}
    hard = spreading_of(_study({}), BANDS_HZ)["far"]
    soft = spreading_of(_study(ground), BANDS_HZ)["far"]
    behind = spreading_of(_study({**ground, "radiation.surroundings.barrier": fence}), BANDS_HZ)[
        "far"
    ]
    assert soft[0] == pytest.approx(hard[0], rel=0.3)
    assert np.all(behind < 0.5 * hard)


def test_axes_spread_noise_to_their_microphones() -> None:
    axes = LevelAxes([50.0], ["none"], [], ["b", "a"], [], (), {"b": np.array([0.5, 0.25])})
    noise = np.array([[[2.0, 4.0]]])
    assert axes.spread(noise) == pytest.approx(np.array([[[[1.0, 1.0], [2.0, 4.0]]]]))
