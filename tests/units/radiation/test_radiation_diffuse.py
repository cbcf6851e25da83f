"""The diffuse field of a room, and its seam to the waves."""

import numpy as np
import pytest
from documents import ISO_9613_1
from evidence import claim

from vibroacoustics.base.air_attenuation import air_attenuation_per_m
from vibroacoustics.radiation.rooms import (
    Block,
    DiffuseRoom,
    Material,
    Room,
    blend,
    gain_at_position_db,
    line_of_sight,
    mean_square_per_power,
)
from vibroacoustics.radiation.rooms.diffuse import (
    reverberation_time_s,
    surface_m2,
)
from vibroacoustics.radiation.rooms.room import SIDES

BOARDS = Material("boards", (0.1,) * 7)
FRIDGE = Block("fridge", (0.0, 0.0, 0.0), (0.6, 0.6, 1.8), BOARDS)
ROOM = Room((4.0, 3.0, 2.5), dict.fromkeys(SIDES, BOARDS), (FRIDGE,))


def test_air_attenuates_as_the_standard_tables():
    """ISO 9613-1, table 1, 20 °C and 50 %: 0.123, 1.32, 4.66, 29.4 dB/km at exact midbands."""
    midbands = 1000.0 * 10.0 ** np.array([-1.2, -0.6, 0.0, 0.6])
    db_per_km = 1e4 / np.log(10.0) * air_attenuation_per_m(midbands)
    for hertz, ours, printed in zip(midbands, db_per_km, (0.123, 1.32, 4.66, 29.4), strict=True):
        claim(
            f"Attenuation of air at {hertz:.0f} Hz, 20 °C and 50 %", kind="printed", unit="dB/km",
            source=ISO_9613_1("table 1"), computed=ours, reference=printed,
            tolerance=5e-3 * printed, topics=("room",),
        )  # fmt: skip


def test_the_surface_is_that_of_walls_and_blocks():
    # What the fridge covers of the walls, it has itself; its corner takes none from the sum.
    assert surface_m2(ROOM) == pytest.approx(2.0 * (12.0 + 10.0 + 7.5))


def test_the_diffuse_field_is_that_of_the_room_constant():
    room = DiffuseRoom(np.linspace(4.0, 10.0, 7), 50.0, 0.0)
    area = 7.0  # of the fourth octave
    expected = 1.2 * 343.0 * (1.0 / (8.0 * np.pi) + 4.0 * (1.0 - area / 50.0) / area)
    at = np.array([500.0])
    assert mean_square_per_power(at, 2.0, room, True)[0] == pytest.approx(expected)
    hidden = mean_square_per_power(at, 2.0, room, False)[0]
    assert hidden == pytest.approx(1.2 * 343.0 * 4.0 * (1.0 - area / 50.0) / area)


def test_octaves_are_interpolated_and_held_at_the_ends():
    room = DiffuseRoom(np.array([4.0, 6.0, 6.0, 6.0, 6.0, 6.0, 8.0]), 50.0, 0.0)
    between = float(np.sqrt(63.0 * 125.0))
    assert np.allclose(room.area_m2(np.array([20.0, between, 8000.0])), [4.0, 5.0, 8.0])


def test_the_reverberation_time_is_that_of_walls_and_air():
    diffuse = DiffuseRoom.of(ROOM)
    low, high = diffuse.reverberation_time_s(np.array([63.0, 4000.0]))
    assert low == pytest.approx(reverberation_time_s(ROOM), rel=1e-3)  # of walls alone
    area = diffuse.area_m2(np.array([4000.0]))[0]
    assert high == pytest.approx(24.0 * np.log(10.0) * (30.0 - 0.648) / (343.0 * area), rel=1e-9)
    bare = DiffuseRoom(np.full(7, 1e-3), 50.0, 30.0)
    assert bare.reverberation_time_s(np.array([63.0]))[0] == 5.0


def test_air_adds_to_the_walls():
    diffuse = DiffuseRoom.of(ROOM)
    at = np.array([4000.0])
    walls = 0.1 * diffuse.surface_m2
    added = 4.0 * air_attenuation_per_m(at)[0] * (30.0 - 0.648)
    assert diffuse.area_m2(at)[0] == pytest.approx(walls + added)
    assert added > 0.1 * walls


def test_a_room_that_absorbs_all_has_a_constant_nevertheless():
    room = DiffuseRoom(np.full(7, 60.0), 50.0, 0.0)
    assert np.all(np.isfinite(room.constant_m2(np.array([100.0, 1000.0]))))


@pytest.mark.parametrize(
    ("start", "end", "seen"),
    [
        ((0.3, 1.0, 0.5), (2.0, 2.0, 1.0), True),
        ((0.3, 1.0, 0.5), (0.8, 0.3, 0.5), False),
        ((0.3, 1.0, 2.0), (0.3, 0.1, 1.7), False),
        ((0.3, 1.0, 2.0), (0.3, 0.1, 2.0), True),
        ((0.6, 0.1, 0.5), (0.6, 2.0, 0.5), True),  # along its side
    ],
)
def test_blocks_stand_in_the_line_of_sight(start, end, seen):
    assert line_of_sight(ROOM, np.array(start), np.array(end)) == seen
    assert line_of_sight(ROOM, np.array(end), np.array(start)) == seen


def test_the_seam_goes_from_waves_to_the_diffuse_field():
    weight = blend(np.array([0.0, 100.0, 400.0, np.sqrt(400.0 * 630.0), 630.0, 4000.0]))
    assert np.allclose(weight, [0.0, 0.0, 0.0, 0.5, 1.0, 1.0])
    assert np.all(np.diff(blend(np.geomspace(400.0, 630.0, 50))) > 0.0)


def test_the_place_gains_the_mean_ratio():
    diffuse = np.array([[1.0, 2.0, 0.0], [4.0, 1.0, 1.0]])
    waves = np.array([[3.0, 2.0, 5.0], [4.0, 3.0, 2.0]])
    assert gain_at_position_db(waves, diffuse) == pytest.approx(10.0 * np.log10(2.0))
    assert gain_at_position_db(np.zeros((2, 3)), diffuse) == 0.0
