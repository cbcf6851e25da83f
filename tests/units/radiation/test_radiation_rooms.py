"""Rooms: what they are made of, and what they refuse."""

import warnings

import numpy as np
import pytest
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.radiation.exact import free_green
from vibroacoustics.radiation.rooms import (
    HARD,
    Block,
    JoinBox,
    Lattice,
    Material,
    Patch,
    Room,
    RoomSettings,
    read_library,
    room_transfer,
)
from vibroacoustics.radiation.rooms.cutting import cut, faces, rectangles
from vibroacoustics.radiation.rooms.diffuse import (
    absorption_area_m2,
    reverberation_time_s,
    volume_m3,
)
from vibroacoustics.radiation.rooms.impedance import (
    AbsorptionWarning,
    Branches,
    fitted_absorption,
    fitted_branches,
    random_absorption,
    random_absorption_slopes,
    wall_absorption,
    warn_of_absorption,
)
from vibroacoustics.radiation.rooms.room import MOST_ABSORPTION, OCTAVES_HZ, SIDES, material
from vibroacoustics.radiation.rooms.wall_step import (
    WallPatch,
    Walls,
    pass_walls,
    stepped_branches,
)

LIBRARY = read_library(ROOT / "data" / "rooms" / "materials.toml")
TILES, BOARDS = LIBRARY["tiles"], LIBRARY["boards"]


OCTAVES = np.array(OCTAVES_HZ[:5])
STEP_S = 1e-4
"""Longest time step of waves to 1 kHz."""


def any_material(rng):
    """Any whose neighbouring octaves differ by at most a factor of 4."""
    absorption = [rng.uniform(0.02, 0.95)]
    for _ in range(4):
        absorption.append(np.clip(absorption[-1] * 4.0 ** rng.uniform(-1.0, 1.0), 0.01, 0.95))
    return Material("any", (*map(float, absorption), 0.1, 0.1))


def check_passive(branches):
    """All parts above zero, and nothing sent back that did not come, at any frequency."""
    assert np.all(np.concatenate([branches.mass, branches.resistance, branches.spring]) > 0.0)
    assert np.all(branches.admittance(np.geomspace(1.0, 20e3, 4000)).real >= 0.0)


@pytest.mark.parametrize("name", LIBRARY)
def test_materials_of_the_library_absorb_what_is_published(name):
    one = LIBRARY[name]
    assert one.source
    requested = np.minimum(one.absorption[:5], MOST_ABSORPTION)
    assert np.abs(fitted_absorption(one) - requested).max() <= 0.01
    branches = fitted_branches(one)
    check_passive(branches)
    stepped = stepped_branches(branches, STEP_S)
    check_passive(stepped)
    stepped_hz = np.tan(np.pi * OCTAVES * STEP_S) / (np.pi * STEP_S)
    in_steps = random_absorption(stepped.admittance(stepped_hz))
    assert np.abs(in_steps - requested).max() <= 0.01


def test_any_material_absorbs_what_is_requested():
    """At least 27 of 30 within 0.03; a warning names the octaves of the others."""
    rng = np.random.default_rng(33)
    close = 0
    for material_ in (any_material(rng) for _ in range(30)):
        check_passive(fitted_branches(material_))
        error = np.abs(fitted_absorption(material_) - material_.absorption[:5]).max()
        close += error <= 0.03
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            warn_of_absorption(Room((4.0, 3.0, 2.5), {"+x": material_}), 1000.0)
        assert bool(caught) == (error > 0.03)
    assert close >= 27


@pytest.mark.parametrize("number", range(4))
def test_walls_take_more_work_than_they_give_back_at_every_time(number):
    """The trapezoidal rule, driven by noise: work is the mean flux of two steps times pressure."""
    rng = np.random.default_rng(number)
    walls = Walls([WallPatch(0, 1, any_material(rng), 0.0)], STEP_S)
    pressure = rng.standard_normal(4000) * (np.arange(4000) < 2000)
    work, change = [0.0], np.zeros(1)
    for one in pressure:
        before = walls.flux.sum()
        pass_walls(np.array([one]), change, walls.arguments)
        work.append(work[-1] + one * (before + walls.flux.sum()) / 2.0)
    assert min(work) >= 0.0
    assert np.all(np.isfinite(walls.flux))
    assert np.abs(walls.flux).max() < 1e-3 * np.abs(pressure).max()  # died away


def test_slopes_of_the_absorption_are_those_of_differences():
    admittance, step = np.array([0.02 + 0.3j, 0.6 - 0.2j, 1.5 + 1.0j]), 1e-6
    for slope, way in zip(random_absorption_slopes(admittance), (step, 1j * step), strict=True):
        sides = random_absorption(admittance + way) - random_absorption(admittance - way)
        np.testing.assert_allclose(sides / (2.0 * step), slope, rtol=1e-6, atol=1e-9)


def test_surfaces_have_the_requested_absorption_and_that_of_the_waves():
    room = Room(
        (4.0, 3.0, 2.5),
        {"floor": LIBRARY["curtain"]},
        (Block("cupboard", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), BOARDS),),
        (Patch("hatch", "-x", (2.0, 1.0), (2.5, 1.5), LIBRARY["opening"]),),
    )
    at = wall_absorption(room, 710.0)
    waves, requested = at["room_wall_absorption"], at["room_wall_absorption_requested"]
    assert list(at["room_surface"].values) == [
        *(f"walls.{side}" for side in SIDES), "furniture.cupboard", "patches.hatch",
    ]  # fmt: skip
    assert requested.sel(room_surface="walls.floor").values == pytest.approx(
        LIBRARY["curtain"].absorption
    )
    np.testing.assert_allclose(waves[-2, :4], BOARDS.absorption[:4], atol=1e-3)
    assert np.all(np.isnan(waves[:, 4:]))  # above the waves
    assert np.all(waves.sel(room_surface="walls.ceiling")[:4] == 0.0)
    with pytest.warns(AbsorptionWarning) as caught:
        warn_of_absorption(room, 710.0)
    (words,) = (str(one.message) for one in caught)
    assert words.startswith("room.patches.hatch: absorption of waves is 0.94 instead of 1 at 63 Hz")
    assert "1000 Hz" not in words
    assert words.endswith("a locally reacting wall absorbs at most 0.95")


def test_slopes_of_an_admittance_are_those_of_differences():
    branches, at, step = fitted_branches(TILES), np.array([63.0, 400.0]), 1e-5
    parts = [branches.mass, branches.resistance, branches.spring]
    for part, branch in ((0, 1), (1, 0), (2, 4)):
        sides = []
        for share in (np.exp(step), np.exp(-step)):
            changed = [one.copy() for one in parts]
            changed[part][branch] *= share
            sides.append(Branches(*changed).admittance(at))
        slope = branches.slopes(at)[:, part, branch]
        # Differences err by step squared, and by 1e-16 of the whole over the step.
        np.testing.assert_allclose(
            (sides[0] - sides[1]) / (2.0 * step), slope, rtol=1e-6, atol=1e-10
        )


def test_random_incidence_on_a_real_impedance_has_its_closed_form():
    z = np.array([1.57, 5.0, 30.0])
    closed = 8.0 / z * (1.0 + 1.0 / (1.0 + z) - 2.0 / z * np.log(1.0 + z))
    assert np.allclose(random_absorption(1.0 / z), closed, rtol=1e-9)
    assert random_absorption(1.0 / z).max() == pytest.approx(0.951, abs=1e-3)


def test_absorption_that_no_wall_takes_is_clipped_and_named():
    assert LIBRARY["opening"].clipped_octaves_hz == OCTAVES_HZ
    assert TILES.clipped_octaves_hz == ()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Material("m", (0.1,) * 6), "absorption: has 6 values"),
        (lambda: Material("m", (0.1,) * 6 + (1.2,)), "absorption = 1.2 at 4000 Hz: must be 0 to 1"),
        (lambda: material("m", {"absorption_ratio": [0.1]}), "must be six numbers"),
        (lambda: Room((4.0, -3.0, 2.5)), "room.size_m"),
        (
            lambda: Room((4.0, 3.0, 2.5), blocks=(Block("fridge", (0, 0, 0), (5.0, 1.0, 1.0)),)),
            "room.furniture.fridge: from 0 to 5 m: must rise and lie in the room, 0 to 4 m",
        ),
        (
            lambda: Room((4.0,) * 3, patches=(Patch("door", "-x", (1.0, 0.0), (1.0, 2.0), HARD),)),
            "room.patches.door: from 1 to 1 m",
        ),
        (
            lambda: cut(Room((1.0, 1.0, 1.0), blocks=(Block("b", (0, 0, 0), (0.99, 1, 1)),)), 0.1),
            "air of 10 mm at x = 0.99 m; needed at least 50 mm",
        ),
        (
            lambda: cut(Room((1.0, 1.0, 1.0), blocks=(Block("b", (0, 0, 0), (1, 1, 1)),)), 0.1),
            "leave no air",
        ),
    ],
)  # fmt: skip
def test_rooms_that_cannot_be_are_refused(make, message):
    with pytest.raises(ParameterError, match=message):
        make()


@pytest.mark.parametrize(
    ("microphone", "point", "frequency", "message"),
    [
        ([5.0, 1.0, 1.0], [1.0, 1.0, 1.0], 100.0, "microphones.m: the point .* outside the room"),
        ([0.8, 0.8, 0.8], [2.0, 0.2, 0.2], 100.0, "room: the point .* outside the room"),
        ([0.8, 0.8, 0.8], [0.5, 0.5, 0.5], 300.0, "300 Hz is asked for"),
    ],
)
def test_points_outside_the_air_are_refused(microphone, point, frequency, message):
    with pytest.raises(ParameterError, match=message):
        room_transfer(
            Room((1.0, 1.0, 1.0)), [Lattice.of_point(np.array(point))],
            {"m": np.array(microphone)}, np.array([frequency]), RoomSettings(200.0),
        )  # fmt: skip


def test_rectangles_cover_a_set_once_with_the_largest_first():
    chosen = np.array([[True, True, False], [True, True, True]])
    lines = [np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.0, 2.0, 9.0])]
    assert list(rectangles(chosen, lines)) == [((1, 2), (0, 3)), ((0, 1), (0, 2))]


def test_boxes_and_faces_hold_all_air_and_all_walls():
    door = LIBRARY["door"]
    room = Room(
        (4.0, 3.0, 2.5),
        dict.fromkeys(SIDES, TILES) | {"ceiling": BOARDS},
        (Block("fridge", (0.0, 0.0, 0.0), (0.6, 0.6, 1.8), BOARDS),),
        (Patch("door", "+x", (1.0, 0.0), (2.0, 2.1), door),),
    )
    boxes = cut(room, 0.1)
    assert sum(np.prod(box.size) for box in boxes) == pytest.approx(30.0 - 0.648)
    areas: dict[str, float] = {}
    for face in faces(room, boxes):
        name = face.material.name if face.material else "seam"
        areas[name] = areas.get(name, 0.0) + float(np.prod(face.upper - face.lower))
    assert areas["door"] == pytest.approx(2.1)
    assert areas["boards"] == pytest.approx(12.0 + 0.36 + 2 * 0.6 * 1.8)
    assert areas["tiles"] == pytest.approx(47.0 - 2.1 - 0.36 - 2 * 0.6 * 1.8)
    assert volume_m3(room) == pytest.approx(30.0 - 0.648)
    area = absorption_area_m2(room)
    shares = [areas[one.name] * np.array(one.absorption) for one in (TILES, BOARDS, door)]
    assert np.allclose(area, sum(shares))
    assert reverberation_time_s(room) == pytest.approx(
        0.161 * volume_m3(room) / area[:5].min(), rel=1e-2
    )


def test_a_monopole_recorded_on_a_box_sounds_as_in_the_room():
    plaster = LIBRARY["acoustic_ceiling"]
    room = Room(
        (2.4, 2.0, 1.6),
        dict.fromkeys(SIDES, plaster),
        (Block("shelf", (0.0, 0.0, 0.0), (0.5, 2.0, 0.8), BOARDS),),
    )
    source = np.array([1.55, 0.62, 0.51])
    box = JoinBox(np.array([1.35, 0.4, 0.3]), np.array([1.75, 0.8, 0.7]), 400.0)
    frequency = np.arange(60.0, 400.1, 20.0)
    microphone = {"m": np.array([0.7, 1.6, 1.2])}
    lattices = [*box.lattices, Lattice.of_point(source)]
    settings = RoomSettings(400.0, nodes_per_wave=5.0, longest_s=0.6)
    response = room_transfer(room, lattices, microphone, frequency, settings, gradient=True)["m"]
    width = 1e-3
    pressure, slope = [], []
    for points, axis in zip(box.points, box.axes, strict=True):
        ahead, behind = (points + s * width * np.eye(3)[axis] for s in (0.5, -0.5))
        pressure.append(free_green(points, source, frequency))
        slope.append(
            (free_green(ahead, source, frequency) - free_green(behind, source, frequency)) / width
        )
    joined = box.join(pressure, slope, response.values[:6])
    direct = response.values[6][:, 0].ravel()
    assert np.abs(20.0 * np.log10(np.abs(joined / direct))).max() <= 0.2
    assert np.abs(np.angle(joined / direct)).max() <= 0.03
