"""Values of a study replaced in Python are validated as those of a file are."""

import copy

import numpy as np
import pytest
from support import PIPELINES

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.study.loading import load_study


@pytest.fixture(scope="module")
def study():
    return load_study(PIPELINES / "copeland_thesis.toml")


def test_values_change_and_the_study_stays(study):
    before = study.parameters()
    changed = study.replace(
        {
            "operation.speed_rpm": np.array([3500.0]),
            "options.pendulum-side.length_mm": 30,
            "options": {"pendulum-inline": {"length_m": np.float64(0.031)}},
            "machine.mounts.loss_factor_ratio": 0.15,
        }
    )
    assert changed.operation.speed_rpm == (3500.0,)
    assert changed.options["pendulum-side"].length_m == 0.03
    assert changed.options["pendulum-inline"].length_m == 0.031
    assert changed.machine.mounts.loss_factor_ratio == 0.15
    assert changed.machine.kinematics == study.machine.kinematics
    assert study.parameters() == before
    assert study.replace({}) == study


def test_replacing_again_keeps_what_was_replaced(study):
    twice = study.replace({"machine.kinematics.orbit_radius_m": 0.004}).replace({"title": "Two"})
    assert (twice.title, twice.machine.kinematics.orbit_radius_m) == ("Two", 0.004)


def test_it_is_what_a_file_that_extends_gives(study, tmp_path):
    file = tmp_path / "copeland_thesis.toml"
    file.write_text(
        f'extends = "{PIPELINES}/copeland_thesis.toml"\n'
        '[machine.override]\nmounts.pitch_mm = { value = 200, source = "replaced in Python" }\n'
        '[options.weight]\nkind = "counterweight"\nmass_g = 100\nradius_mm = 20\n'
        "angle_deg = 180\nheight_mm = 0\n"
    )
    weight = {"mass_g": 100, "radius_mm": 20, "angle_deg": 180, "height_mm": 0}
    values = {
        "machine.mounts.pitch_mm": 200,
        "options.weight": {"kind": "counterweight", **weight},
    }
    of_file, here = load_study(file), study.replace(values)
    rename = {"copeland_thesis.toml": "", "study.replace": ""}

    def plain(study):
        records = [r.model_copy(update={"file": rename.get(r.file, r.file)}) for r in study.records]
        return study.model_copy(update={"records": tuple(records)}).parameters()

    assert plain(here) == plain(of_file)


def test_none_takes_out(study):
    assert "twin-oldham" not in study.replace({"options.twin-oldham": None}).options
    with pytest.raises(ParameterError, match=r"^study.replace: options.x = None: there is none"):
        study.replace({"options.x": None})


def test_records_say_who(study):
    changed = study.replace({"machine.mounts.pitch_mm": 200.0})
    (record,) = [r for r in changed.records if r.field == "mounts.pitch_mm"]
    assert (record.file, record.source, record.value) == (
        "study.replace", "replaced in Python", "200",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"operation.speed": [2900.0]}, "study.replace: operation.speed: unknown key"),
        ({"operation.speed_rpm": [10.0]}, "speed_rpm = 10 rpm: allowed 60 to 60000 rpm"),
        ({"operation.speed_rpm": "fast"}, "study.replace: operation.speed_rpm"),
        ({"options.pendulum-side.length_mm": -1.0}, "length_mm = -1.0 mm"),
        ({"machine.mounts.pitch_mm": -1.0}, "machine.override.mounts.pitch_mm = -1.0 mm"),
        ({"machine.mounts.colour": 1.0}, "machine.override.mounts.colour: the machine has no such"),
        ({"options.none": None}, "options: an option named none"),
        ({"": 1.0}, "'': must be a dotted key"),
        ({"title.x": 1.0}, "copeland_thesis.toml: title = "),
    ],
)
def test_refusals_are_those_of_a_file(study, values, message):
    with pytest.raises(ParameterError) as refusal:
        study.replace(values)
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_study_changed_behind_its_back_is_not_replaced(study):
    for other in (study.model_copy(update={"title": "Other"}), copy.deepcopy(study)):
        with pytest.raises(ParameterError, match="was not read by load_study"):
            other.replace({})
