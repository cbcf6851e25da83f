"""Table `room` of a study: what it takes, and one line for what cannot be."""

import pytest
from support import ROOT, TINY, command_here

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.radiation.rooms.room import read_library
from vibroacoustics.study.coarse import coarse
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.room import library

KITCHEN = {
    "size_mm": [4000.0, 3000.0, 2500.0],
    "foot_mm": [3500.0, 400.0],
    "walls": {"floor": "tiles", "ceiling": {"absorption_ratio": [0.2, 0.5, 0.8, 0.8, 0.7, 0.5]}},
    "furniture": {
        "worktop": {
            "lower_mm": [0.0, 0.0, 0.0],
            "upper_mm": [2000.0, 600.0, 900.0],
            "material": "boards",
        }
    },
    "patches": {
        "window": {
            "side": "-x",
            "lower_mm": [1000.0, 900.0],
            "upper_mm": [2200.0, 2100.0],
            "material": "window",
        }
    },
    "listeners": {"table": {"x_mm": 2000.0, "y_mm": 2200.0, "height_mm": 1200.0}},
    "limits": {"day_dba": 40.0, "night_dba": 30.0},
}
WORKTOP = KITCHEN["furniture"]["worktop"]


def with_room(**changes):
    return load_study(TINY).replace({"room": {**KITCHEN, **changes}})


def test_names_of_the_library_become_its_values():
    room = with_room().room
    assert room.size_m == (4.0, 3.0, 2.5)
    assert room.walls["floor"] == library()["tiles"]
    assert room.walls["ceiling"].absorption_ratio[2] == 0.8
    assert room.listeners["table"].height_m == 1.2
    assert room.limits.night_dba == 30.0


def test_the_library_is_that_of_the_room_solver():
    solver = read_library(ROOT / "data" / "rooms" / "materials.toml")
    assert {name: one.absorption[1:] for name, one in solver.items()} == {
        name: one.absorption_ratio for name, one in library().items()
    }


def test_a_machine_stands_on_furniture():
    room = with_room(foot_mm=[1000.0, 300.0], standing_height_mm=900.0).room
    assert room.standing_height_m == 0.9


def test_no_room_is_none():
    assert load_study(TINY).room is None


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"walls": {"floor": "marble"}},
            "room.walls.floor: marble is no material of the library; allowed plaster, masonry",
        ),
        (
            {"walls": {"floor": {"absorption_ratio": [0.1, 0.2, 1.3, 0.1, 0.1, 0.1]}}},
            "room.walls.floor.absorption_ratio.2 = 1.3: out of range",
        ),
        (
            {"listeners": {"cook": {"x_mm": 1000.0, "y_mm": 300.0, "height_mm": 500.0}}},
            "listeners.cook: at [1000.0, 300.0, 500.0] mm: lies in furniture.worktop",
        ),
        (
            {"listeners": {"cook": {"x_mm": 5000.0, "y_mm": 300.0, "height_mm": 500.0}}},
            "listeners.cook: at [5000.0, 300.0, 500.0] mm: must lie in the room",
        ),
        (
            {"listeners": {"cook": {"x_mm": 3500.0, "y_mm": 400.0, "height_mm": 200.0}}},
            "room.listeners.cook: lies in the machine",
        ),
        ({"listeners": {}}, "room.listeners = {}: "),
        (
            {"listeners": {"front_1m": KITCHEN["listeners"]["table"]}},
            "room.listeners.front_1m: a microphone has this name, receivers.front_1m",
        ),
        (
            {"foot_mm": [3990.0, 400.0]},
            "room.foot_mm = [3990.0, 400.0]: the shell reaches from",
        ),
        (
            {"foot_mm": [2050.0, 400.0]},
            "room.foot_mm = [2050.0, 400.0]: the shell stands in furniture.worktop",
        ),
        (
            {"standing_height_mm": 900.0},
            "standing_height_mm = 900 mm: neither the floor nor the top of furniture at foot_mm; "
            "allowed 0 mm",
        ),
        (
            {"furniture": {"worktop": {**WORKTOP, "upper_mm": [2000.0, 600.0, 2900.0]}}},
            "furniture.worktop: from 0 to 2900 mm: must rise and lie in the room, 0 to 2500 mm",
        ),
        (
            {"patches": {"window": {**KITCHEN["patches"]["window"], "upper_mm": [3500.0, 2100.0]}}},
            "patches.window: from 1000 to 3500 mm: must rise and lie in the room, 0 to 3000 mm",
        ),
        ({"size_mm": [30000.0, 30000.0, 2500.0]}, "a volume of 2250 m³; allowed to 500 m³"),
        (
            {"maximum_frequency_hz": 4000.0},
            "room.maximum_frequency_hz = 4000.0 Hz: out of range; allowed from 250 to 1000 Hz",
        ),
    ],
)
def test_what_cannot_be_is_one_line(changes, words):
    with pytest.raises(ParameterError) as caught:
        with_room(**changes)
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize(
    ("surroundings", "words"),
    [
        ({"walls": {"-x": {"distance_mm": 500.0}}}, "surroundings has walls or a cabinet"),
        ({"ground": {"material": "lawn"}}, "surroundings has ground or a barrier"),
        ({"floor": False}, "room: needs radiation.surroundings.floor = true"),
    ],
)
def test_the_machine_comes_from_a_hard_floor(surroundings, words):
    study = load_study(TINY).replace({"radiation.room_solver": "closed-form"})
    with pytest.raises(ParameterError, match=words):
        study.replace({"radiation.surroundings": surroundings, "room": KITCHEN})


def test_a_file_is_refused_in_one_line(tmp_path):
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file = tmp_path / "study.toml"
    file.write_text(
        text + "[room]\nsize_mm = [4000.0, 3000.0, 2500.0]\nfoot_mm = [3500.0, 400.0]\n"
        "[room.walls]\nflor = 'tiles'\n"
        "[room.listeners.table]\nx_mm = 2000.0\ny_mm = 2200.0\nheight_mm = 1200.0\n"
    )
    outcome = command_here("check", file)
    assert outcome.returncode == 2
    assert "room.walls.flor" in outcome.stderr
    assert len(outcome.stderr.splitlines()) == 1


def test_coarse_lowers_the_highest_frequency_of_the_room():
    looked = coarse(with_room())
    assert looked.room.maximum_frequency_hz == 710.0
    assert any("waves in the room to 710 instead of 1000 Hz" in one for one in looked.coarsened)
    already = with_room(maximum_frequency_hz=300.0)
    assert coarse(already).room.maximum_frequency_hz == 300.0
