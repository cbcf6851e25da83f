"""Operating points of a machine's file: one that a study names holds, and what is refused."""

from pathlib import Path

import pytest
from sources_study import SOURCES_STUDY
from support import MACHINE_FILE

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.study.loading import load_machine, load_study


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY)


def gas_records(study):
    return {record.field: record.value for record in study.records if record.field[:4] == "gas."}


def test_values_of_the_named_point_hold_with_their_sources(study):
    """Suction and discharge of ARI; what the point leaves out stays as the machine has it."""
    at_ari = study.replace({"operation.point": "ari"})
    gas = at_ari.machine.gas
    assert (gas.suction_pressure_pa, gas.discharge_pressure_pa) == pytest.approx((9.98e5, 33.86e5))
    assert gas.equalisation_angle_rad == study.machine.gas.equalisation_angle_rad
    assert gas_records(at_ari)["gas.suction_pressure_bar"] == "9.98"
    assert at_ari.replace({"operation.point": None}).machine == study.machine
    # The index of the point has no range, that of the machine has one.
    names = {"gas.polytropic_index"}
    assert {limits.name for limits in study.ranges} - {
        limits.name for limits in at_ari.ranges
    } == names


def test_a_study_replaces_values_of_its_point(study):
    values = {"operation.point": "ari", "machine.gas.suction_pressure_bar": 9.0}
    gas = study.replace(values).machine.gas
    assert gas.suction_pressure_pa == pytest.approx(9.0e5)
    assert gas.discharge_pressure_pa == pytest.approx(33.86e5)


def test_an_unknown_point_is_refused(study):
    with pytest.raises(ParameterError, match=r"operation.point = sun: unknown; allowed ari, en_5"):
        study.replace({"operation.point": "sun"})
    with pytest.raises(ParameterError, match=r"operation.point = 3: must be the name"):
        study.replace({"operation.point": 3})


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("suction_pressure_bar = { value = 9.98", "suction_bar = { value = 9.98", "no such value"),
        (
            "suction_pressure_bar = { value = 9.98",
            "suction_pressure_bar = { value = 99.8",
            "exceed",
        ),
        ("[operating_points.ari.gas]", "[operating_points.ari.gases]", "no such value"),
    ],
)
def test_a_point_that_does_not_fit_the_machine_is_refused(tmp_path: Path, old, new, words):
    """When the machine is read alone too, whichever point a study names."""
    text = MACHINE_FILE.read_text(encoding="utf-8")
    assert text.count(old) == 1
    (tmp_path / "machine.toml").write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ParameterError, match=words):
        load_machine(tmp_path / "machine.toml")


def test_points_must_be_a_table(tmp_path: Path):
    text = MACHINE_FILE.read_text(encoding="utf-8")
    (tmp_path / "machine.toml").write_text(f"operating_points = 3\n{text}", encoding="utf-8")
    with pytest.raises(ParameterError):
        load_machine(tmp_path / "machine.toml")


# --- the opening ---------------------------------------------------------------------------------


def test_a_study_samples_what_its_law_of_the_opening_reads(study):
    """The angle of the one law, passages, volumes and gas in the shell of the other, which has
    flows; the gas's state has no range."""
    inertia = study.replace({"machine.gas.opening_law": "inertia"})
    by_angle, by_inertia = ({limits.name for limits in one.ranges} for one in (study, inertia))
    assert by_angle - by_inertia == {"gas.equalisation_angle_rad"}
    tables = [name.partition(".")[0] for name in by_inertia - by_angle]
    assert set(tables) == {
        "opening",
        "leakage",
        "discharge_dome",
        "suction_annulus",
    }
    assert tables.count("opening") == 7
    assert "gas.discharge_density_kg_per_m3" in gas_records(inertia)
    assert "gas.discharge_density_kg_per_m3" not in gas_records(study)


def test_a_law_without_what_it_needs_is_refused(study, tmp_path: Path):
    small = {"value": 1.5, "source": "test"}
    values = {"machine.gas.opening_law": "inertia", "machine.opening.chamber_volume_cm3": small}
    with pytest.raises(ParameterError, match=r"sources.gas.*1.5 cm³: must exceed 1.53 cm³"):
        study.replace(values)
    with pytest.raises(ParameterError, match=r"opening_law"):
        study.replace({"machine.gas.opening_law": "magic"})
