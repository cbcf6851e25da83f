"""TOML to a study: units, sources, overrides, extension."""

import shutil

import pytest
from pydantic import ValidationError
from support import MACHINE_FILE, PIPELINES, ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.study.loading import load_study


@pytest.fixture
def extend(tmp_path):
    """Load a study that extends the thesis's."""
    shutil.copytree(PIPELINES, tmp_path / "pipelines")
    shutil.copytree(ROOT / "data" / "machines", tmp_path / "data" / "machines")
    shutil.copytree(ROOT / "data" / "validation", tmp_path / "data" / "validation")

    def load(text: str):
        path = tmp_path / "pipelines" / "extended.toml"
        path.write_text(f'extends = "copeland_thesis.toml"\n{text}\n', encoding="utf-8")
        return load_study(path)

    return load


def test_values_are_si(thesis_study):
    machine = thesis_study.machine
    assert machine.kinematics.orbit_radius_m == pytest.approx(6.75e-3)
    assert machine.mounts.vertical_stiffness_n_per_m == pytest.approx(5e4)
    assert machine.shell.outer_diameter_m == pytest.approx(0.165)
    assert thesis_study.operation.speed_rpm == (2900.0, 3500.0)
    assert thesis_study.receivers["left_1m"].y_m == pytest.approx(0.9375)


def test_all_options_of_the_issue_are_there(thesis_study):
    assert set(thesis_study.options) == {
        "none", "pendulum-side", "pendulum-inline", "spring-mass", "spring-mass-printed",
        "twin-oldham", "damping", "counterweight-half",
    }  # fmt: skip


def test_false_removes_a_table_of_the_extended_study(extend):
    options = extend("[options]\npendulum-side = false").options
    assert "pendulum-side" not in options
    assert len(options) == 7


def test_false_of_no_table_is_refused(extend):
    with pytest.raises(ParameterError, match=r"options\.pendulum = False: must be a table"):
        extend("[options]\npendulum = false")


def test_records_name_file_field_value_unit_source_and_range(thesis_study):
    by_field = {record.field: record for record in thesis_study.records}
    ring = by_field["oldham.mass_kg"]
    assert (ring.file, ring.value, ring.unit) == (MACHINE_FILE.name, "0.0727", "kg")
    assert not ring.assumed
    pitch = by_field["mounts.pitch_mm"]
    assert pitch.assumed
    assert (pitch.lowest, pitch.highest) == (170.0, 200.0)
    stroke = by_field["kinematics.orbit_radius_mm"]
    assert (stroke.file, stroke.value) == ("copeland_thesis.toml", "6.75")


OF_SOURCES = {
    "wraps", "gas", "keys", "motor", "rotor", "structure", "variation", "stopping", "frame",
    "shaft",
}  # fmt: skip
"""Tables that only sources and stops read, and those of the frame that they drive."""
OF_NEITHER = {"suspension", "opening", "discharge_dome", "suction_annulus", "discharge_muffler",
              "balance_quality", "synchronous_motor", "air_gap", "stator_yoke", "turning_back",
              "check_valve", "leakage", "suction_pockets", "refrigerant"}  # fmt: skip
SOURCES_STUDY = ROOT / "tests" / "studies" / "sources_small.toml"


def numbers(table, prefix):
    """Places of all values of a table but switches, those of tables in it too."""
    for field, value in table.items():
        if isinstance(value, dict):
            yield from numbers(value, f"{prefix}.{field}")
        elif value is not None and not isinstance(value, bool | str):  # a choice is no number
            yield f"{prefix}.{field.rsplit('_', 1)[0][:8]}"


@pytest.mark.parametrize("with_sources", [False, True])
def test_every_number_of_the_machine_that_is_read_has_a_record(thesis_study, with_sources):
    study = load_study(SOURCES_STUDY) if with_sources else thesis_study
    recorded = {record.field for record in study.records}
    machine = study.machine.model_dump(exclude={"name", "errata", *OF_NEITHER}, exclude_unset=True)
    assert machine.pop("kind") == "oldham-scroll"
    assert set(machine) > OF_SOURCES
    for table, values in machine.items():
        read = with_sources or table not in OF_SOURCES
        assert any(name.startswith(f"{table}.") for name in recorded) == read, table
        if read:
            for place in numbers(values, table):
                assert any(name.startswith(place) for name in recorded), place


def test_assumed_values_lie_in_their_range(thesis_study):
    for record in thesis_study.records:
        assert record.source, record.field
        if record.assumed:
            assert record.lowest is not None, record.field
            assert record.lowest < record.highest, record.field
            assert record.lowest <= float(record.value) <= record.highest


def test_study_is_frozen(thesis_study):
    with pytest.raises(ValidationError, match="frozen"):
        thesis_study.title = "another"


def test_parameters_are_plain_json(thesis_study):
    from vibroacoustics.results.provenance import canonical_json, sha256

    text = canonical_json(thesis_study.parameters())
    assert text.isascii()
    again = canonical_json(load_study(PIPELINES / "copeland_thesis.toml").parameters())
    assert sha256(text.encode()) == sha256(again.encode())


def test_extending_takes_everything_over(extend, thesis_study):
    study = extend('title = "mine"')
    assert study.title == "mine"
    assert study.options == thesis_study.options
    assert study.machine == thesis_study.machine


def test_extending_replaces_a_quantity_whole(extend):
    study = extend("[options.damping]\ndamping_ns_per_m = { value = 500.0, source = 'measured' }")
    assert study.options["damping"].damping_ns_per_m == 500.0
    (record,) = (r for r in study.records if r.field == "options.damping.damping_ns_per_m")
    assert (record.source, record.lowest, record.file) == ("measured", None, "extended.toml")


def test_extending_in_another_unit(extend):
    study = extend("[receivers.left_1m]\nx_m = -0.6")
    assert study.receivers["left_1m"].x_m == -0.6


def test_extending_adds_an_option(extend):
    study = extend('[options.stiffer]\nkind = "ring-damping"\ndamping_ns_per_m = 20.0')
    assert study.options["stiffer"].damping_ns_per_m == 20.0
    assert len(study.options) == 9


def test_override_in_another_unit(extend):
    study = extend(
        "[machine.override.oldham]\nmass_g = { value = 80.0, source = 'weighed' }\n"
        "[machine.override.kinematics]\norbit_radius_mm = { value = 5.0, source = 'measured' }"
    )
    assert study.machine.oldham.mass_kg == pytest.approx(0.08)
    assert study.machine.kinematics.orbit_radius_m == pytest.approx(5e-3)


def test_same_study_from_a_relative_path(monkeypatch, thesis_study):
    monkeypatch.chdir(PIPELINES)
    assert load_study("copeland_thesis.toml") == thesis_study
