"""The grid of the room side: nodes for microphone, images and walls; interpolation; decimation."""

import numpy as np
import pytest
from radiation_parts import floor
from support import cube_box

from vibroacoustics.radiation import room_grid
from vibroacoustics.radiation.band_limited import (
    STENCIL_NODES,
    Interpolator,
    interpolation_weights,
)
from vibroacoustics.radiation.exact import Mirror, images
from vibroacoustics.radiation.near_step import pulse, pulse_duration_s, pulse_width_s, transform
from vibroacoustics.radiation.room_green import steps_per_sample

FLOOR = floor(-0.1)
WALL = Mirror(axis=0, sign=1, position_m=0.75)
SOFT_WALL = Mirror(axis=1, sign=-1, position_m=-0.9, reflection=0.7)
MICROPHONE = np.array([0.2, -0.6, 0.217])


@pytest.fixture(scope="module")
def box():
    return cube_box(0.1, 0.0125, on_floor=True)


def grid_of(box, microphone, *mirrors):
    return room_grid.room_grid(np.array(microphone), box, 0.03, mirrors)


@pytest.mark.parametrize(
    "mirrors", [(), (FLOOR,), (FLOOR, WALL), (FLOOR, WALL, SOFT_WALL)], ids=len
)
def test_images_and_walls_lie_on_nodes(box, mirrors):
    grid = grid_of(box, MICROPHONE, *mirrors)
    positions, strengths = images(MICROPHONE, mirrors)
    assert len(grid.source_nodes) == 2 ** len(mirrors)
    for position, strength in zip(positions, strengths, strict=True):
        row = np.linalg.norm(grid.sources - position, axis=1).argmin()
        np.testing.assert_allclose(grid.sources[row], position, atol=1e-12)
        assert grid.source_strengths[row] == strength
    for mirror in mirrors:
        wall = (mirror.position_m - grid.origin[mirror.axis]) / grid.spacing_m[mirror.axis]
        assert wall == pytest.approx(round(wall), abs=1e-9)
    assert np.all(grid.spacing_m <= 0.03 + 1e-12)
    free = np.isin(range(3), [mirror.axis for mirror in mirrors], invert=True)
    assert np.all(grid.spacing_m[free] == 0.03)
    assert grid.time_step_s == room_grid.COURANT_NUMBER * grid.spacing_m.min() / 343.0
    for count, part in zip(grid.shape, grid.block, strict=True):
        assert part.start >= room_grid.PML_NODES
        assert part.stop <= count - room_grid.PML_NODES


@pytest.mark.parametrize(
    ("microphone", "mirrors", "strengths"),
    [
        ((0.5, 0.1, -0.1), (FLOOR,), [2.0]),
        ((0.75, 0.1, -0.1), (FLOOR, WALL), [4.0]),
        ((0.75, 0.1, 0.2), (FLOOR, WALL), [2.0, 2.0]),
        ((0.5, -0.9, 0.0), (SOFT_WALL,), [1.7]),
        ((0.5, 0.1, 0.0), (Mirror(1, -1, -0.9, 0.0),), [1.0]),
    ],
    ids=["floor", "edge", "wall", "soft-wall", "open-wall"],
)
def test_images_on_a_wall_add_up(box, microphone, mirrors, strengths):
    np.testing.assert_allclose(grid_of(box, microphone, *mirrors).source_strengths, strengths)


def test_sources_come_in_the_order_of_memory(box):
    grid = grid_of(box, MICROPHONE, FLOOR, WALL, SOFT_WALL)
    index = [np.ravel_multi_index(node, grid.shape) for node in grid.source_nodes]
    assert index == sorted(index)


def test_interpolation_passes_waves_and_stops_ringing():
    nodes = np.arange(STENCIL_NODES) - (STENCIL_NODES // 2 - 1)
    offset = np.linspace(0.0, 1.0, 21)
    weights = interpolation_weights(offset)
    for k, error in ((0.01, 3e-5), (0.7, 3e-4), (1.4, 3e-4), (1.8, 6e-4)):
        wave = weights @ np.exp(1j * k * nodes)
        assert np.abs(wave - np.exp(1j * k * offset)).max() < error
    assert np.abs(weights @ np.cos(np.pi * nodes)).max() < 0.01


def test_interpolation_in_space_with_a_spacing_for_each_axis():
    first, spacing, shape = np.array([0.1, -0.2, 0.3]), np.array([0.03, 0.02, 0.04]), (26, 30, 24)
    points = first + spacing * np.array(
        [[11.3, 14.0, 12.9], [12.5, 13.2, 10.1], [11.3, 13.2, 10.1]]
    )
    k = 0.8 / spacing * np.array([1.0, -0.7, 0.4])

    def wave(x, y, z):
        return np.cos(k[0] * x + k[1] * y + k[2] * z)

    axes = [f + s * np.arange(n) for f, s, n in zip(first, spacing, shape, strict=True)]
    field = wave(*np.meshgrid(*axes, indexing="ij"))
    values = Interpolator(first, spacing, shape, points)(field)
    np.testing.assert_allclose(values, wave(*points.T), atol=1e-3)


@pytest.mark.parametrize("maximum_hz", [500.0, 2500.0])
@pytest.mark.parametrize("time_step_s", [5.2e-5, 2.6e-5, 1e-5])
def test_fewer_samples_give_the_same_spectrum(maximum_hz, time_step_s):
    """Of the pulse itself: every m-th sample, m times the sum, 1e-8 of each value."""
    width, frequency = pulse_width_s(maximum_hz), np.arange(25.0, maximum_hz + 1, 25.0)
    steps = steps_per_sample(time_step_s, frequency, width)
    time = time_step_s * np.arange(int(1.5 * pulse_duration_s(width) / time_step_s))
    every = transform(frequency, time, pulse(time, width))
    some = steps * transform(frequency, time[::steps], pulse(time[::steps], width))
    assert steps >= 2
    # The pulse is cut off where it is 1e-7 of its peak.
    np.testing.assert_allclose(some, every, rtol=2e-8, atol=2e-7 * steps)
    # Twice as far apart, samples would not do.
    coarse = transform(frequency, time[:: 2 * steps], pulse(time[:: 2 * steps], width))
    assert np.abs(2 * steps * coarse - every).max() > 1e-6 * np.abs(every).max()
