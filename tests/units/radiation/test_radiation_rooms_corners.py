"""L- and U-shaped rooms at the default spacing: natural frequencies against graded elements."""

from dataclasses import replace

import numpy as np
import pytest
from corner_elements import squared_wavenumbers

from vibroacoustics.base.constants import SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation.rooms import Block, Room, RoomSettings
from vibroacoustics.radiation.rooms import wall_step as edges_module
from vibroacoustics.radiation.rooms.air import stable_air
from vibroacoustics.radiation.rooms.cutting import cut, faces

HEIGHT_M = 0.06
SHAPES = {
    "L": ((4.0, 3.0), [((0.0, 0.0), (1.7, 1.3))]),
    "narrow L": ((4.0, 3.0), [((0.0, 0.0), (3.1, 2.2))]),
    "U": ((4.0, 3.0), [((1.4, 0.0), (2.5, 1.6))]),
    "T": ((5.0, 3.0), [((0.0, 0.0), (1.5, 1.2)), ((3.3, 0.0), (5.0, 1.2))]),
}


def exact_hz(shape, highest_hz):
    size, blocks = SHAPES[shape]
    wave_m = SPEED_OF_SOUND_M_PER_S / highest_hz
    count = int(np.pi * np.prod(size) / wave_m**2 + 2.0 * sum(size) / wave_m) + 8
    squared = squared_wavenumbers(size, blocks, count, wave_m)
    frequency_hz = SPEED_OF_SOUND_M_PER_S * np.sqrt(squared) / (2.0 * np.pi)
    assert frequency_hz[-1] > highest_hz
    return frequency_hz[frequency_hz <= highest_hz]


def series_hz(shape, settings, count):
    """Natural frequencies of the step, one layer high."""
    size, blocks = SHAPES[shape]
    solids = tuple(
        Block(f"b{number}", (*low, 0.0), (*high, HEIGHT_M))
        for number, (low, high) in enumerate(blocks)
    )
    room = Room((*size, HEIGHT_M), blocks=solids)
    boxes = tuple(replace(box, nodes=(*box.nodes[:2], 1)) for box in cut(room, settings.spacing_m))
    highest_hz = settings.maximum_frequency_hz
    air = stable_air(boxes, faces(room, boxes), settings.longest_step_s, highest_hz)
    factors = air.balance()
    matrix = np.stack([factors * air.operator(row / factors) for row in np.eye(factors.size)])
    assert np.allclose(matrix, matrix.T, atol=1e-9)
    value = np.linalg.eigvalsh(matrix)[1 : count + 1]
    return np.arcsin(np.sqrt(value) / 2.0) / (np.pi * air.time_step_s)


def worst_error(shape, highest_hz):
    exact = exact_hz(shape, 0.9 * highest_hz)
    series = series_hz(shape, RoomSettings(highest_hz), exact.size)
    return np.abs(series / exact - 1.0).max()


def test_elements_have_published_wavenumbers():
    """M. Dauge, Benchmark computations for Maxwell equations (2003): the L of Neumann, 2 x 2."""
    published = [1.47562182408, 3.53403136678, 9.86960440109, 9.86960440109]
    ours = squared_wavenumbers((2.0, 2.0), [((0.0, 0.0), (1.0, 1.0))], 4, 1.0)
    np.testing.assert_allclose(ours, published, rtol=2e-6)


@pytest.mark.parametrize("shape", ["L", "narrow L", "U"])
@pytest.mark.parametrize("highest_hz", [355.0, pytest.param(710.0, marks=pytest.mark.long)])
def test_rooms_with_corners_have_their_frequencies(shape, highest_hz):
    assert worst_error(shape, highest_hz) <= 1e-3


@pytest.mark.long
@pytest.mark.parametrize("shape", SHAPES)
def test_rooms_with_corners_have_their_frequencies_to_1_khz(shape):
    assert worst_error(shape, 1000.0) <= 1e-3


@pytest.mark.long
def test_without_lighter_air_at_edges_they_are_too_low(monkeypatch):
    monkeypatch.setattr(edges_module, "EDGE_RATIO", 0.0)
    assert worst_error("U", 355.0) > 1.5e-3
