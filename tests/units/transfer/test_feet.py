"""Feet anywhere, mounts over frequency from a file, floors that give way."""

from pathlib import Path

import numpy as np
import pytest
from support import ROOT, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.feet import Feet, Mounts, MountStiffness
from vibroacoustics.machine.floor import Floor
from vibroacoustics.machine.housing import Housing
from vibroacoustics.report.sections.assumptions import not_modelled
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.transfer import MachineOnMounts, on_mounts

COPELAND = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text()
HOUSING = Housing(mass_kg=35.0, inertia_xx_kg_m2=0.57, inertia_yy_kg_m2=0.5, inertia_zz_kg_m2=0.12)
MOUNTS = Mounts(
    pitch_m=0.2,
    lateral_stiffness_n_per_m=2e4,
    vertical_stiffness_n_per_m=5e4,
    loss_factor_ratio=0.1,
)
FREQUENCY_HZ = np.array([0.0, 3.0, 12.0, 50.0, 400.0])
LOAD = np.array([3.0, -2.0 + 1.0j, 4.0, 0.3j, -0.2, 0.5])
THREE = {"foot_1": (0.15, 0.02), "foot_2": (-0.08, 0.11), "foot_3": (-0.05, -0.13)}


def three_feet(height_m: float, **own: dict) -> Feet:
    return Feet.model_validate(
        {
            name: {"x_m": x, "y_m": y, "height_m": height_m, **own.get(name, {})}
            for name, (x, y) in THREE.items()
        }
    )


def machine_with(folder: Path, tables: str, **files: str):
    """The Copeland with further tables, and files beside its own."""
    for name, text in files.items():
        (folder / f"{name}.csv").write_text(text)
    (folder / "machine.toml").write_text(COPELAND + tables)
    return load_machine(folder / "machine.toml")


def from_file(name: str, table: str) -> str:
    return f'\n[{table}]\nfile = {{ value = "{name}.csv", source = "measured" }}\n'


HEAD = "frequency_hz,lateral_n_per_mm,vertical_n_per_mm,loss_factor\n"


def test_constant_stiffness_from_a_file_changes_nothing(tmp_path):
    given = load_machine(ROOT / "data" / "machines" / "copeland_zp41k3e.toml")
    mounts = given.mounts
    row = [
        1e-3 * mounts.lateral_stiffness_n_per_m,
        1e-3 * mounts.vertical_stiffness_n_per_m,
        mounts.loss_factor_ratio,
    ]
    rows = "".join(f"{hertz},{','.join(map(repr, row))}\n" for hertz in (5, 80, 600))
    machine = machine_with(tmp_path, from_file("mount", "mount_stiffness"), mount=HEAD + rows)
    for found, expected in zip(
        vars(on_mounts(machine).response(LOAD, FREQUENCY_HZ)).values(),
        vars(on_mounts(given).response(LOAD, FREQUENCY_HZ)).values(),
        strict=True,
    ):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-15)
    for found, expected in zip(
        on_mounts(machine).natural_modes(), on_mounts(given).natural_modes(), strict=True
    ):
        np.testing.assert_allclose(np.abs(found), np.abs(expected), rtol=1e-9, atol=1e-6)
    table = machine.mount_stiffness
    assert MountStiffness.model_validate_json(table.model_dump_json()) == table
    assert machine.mount_stiffness.file == "mount.csv"


def test_load_on_three_feet_by_the_law_of_the_lever():
    """In the plane of the centre of mass the forces of three feet are its barycentric weights."""
    own = {"foot_2": {"vertical_stiffness_n_per_m": 9e4}}
    body = MachineOnMounts(HOUSING, MOUNTS, 0.0, feet=three_feet(0.0, **own))
    force = body.response(np.array([0, 0, 1.0, 0, 0, 0], complex), 0.0).foot_force
    weights = np.linalg.solve(
        np.vstack([np.array(list(THREE.values())).T, np.ones(3)]), [0.0, 0.0, 1.0]
    )
    np.testing.assert_allclose(force[:, 2], weights, rtol=1e-12)
    np.testing.assert_allclose(force[:, :2], 0.0, atol=1e-12)
    assert body.stand.names == tuple(THREE)


def test_three_unequal_feet_against_their_equations(tmp_path):
    """Newton and Euler written out, a foot with a stiffness over frequency on a floor."""
    (tmp_path / "k.csv").write_text(HEAD + "10,30,60,0.1\n110,50,160,0.3\n")
    table = MountStiffness(file=str(tmp_path / "k.csv"))
    own = {
        "foot_1": {"lateral_stiffness_n_per_m": 7e4, "loss_factor_ratio": 0.2},
        "foot_2": {"stiffness": table},
    }
    floor = Floor(mass_kg=20.0, stiffness_n_per_m=4e5, loss_factor_ratio=0.05)
    feet = three_feet(-0.19, **own)
    body = MachineOnMounts(HOUSING, MOUNTS, -0.19, feet=feet, floor=floor)
    response = body.response(LOAD * np.ones((5, 1)), FREQUENCY_HZ)
    mass = np.array([35.0, 35.0, 35.0, 0.57, 0.5, 0.12])
    places = np.array([(x, y, -0.19) for x, y in THREE.values()])
    for at, hertz in enumerate(FREQUENCY_HZ):
        omega, loss = 2.0 * np.pi * hertz, 1.0 * (hertz > 0.0)
        share = np.clip((hertz - 10.0) / 100.0, 0.0, 1.0)
        soft, hard = 1.0 + 0.1j * loss, 1.0 + 0.3j * loss
        second = [(1.0 - share) * low * soft + share * high * hard
                  for low, high in ((3e4, 5e4), (3e4, 5e4), (6e4, 16e4))]  # fmt: skip
        stiffness = np.array([
            np.array([7e4, 7e4, 5e4]) * (1.0 + 0.2j * loss),
            second,
            np.array([2e4, 2e4, 5e4]) * (1.0 + 0.1j * loss),
        ])  # fmt: skip
        stiffness[:, 2] = 1.0 / (
            1.0 / stiffness[:, 2] + 1.0 / (4e5 * (1.0 + 0.05j * loss) - omega**2 * 20.0)
        )

        def left_over(motion, stiffness=stiffness, omega=omega):
            force = stiffness * (motion[:3] + np.cross(motion[3:], places))
            moment = np.cross(places, force).sum(axis=0)
            return np.concatenate([force.sum(axis=0), moment]) - omega**2 * mass * motion

        motion = np.linalg.solve(np.array([left_over(unit) for unit in np.eye(6)]).T, LOAD)
        np.testing.assert_allclose(response.velocity[at], 1j * omega * motion, rtol=1e-10)
        force = stiffness * (motion[:3] + np.cross(motion[3:], places))
        np.testing.assert_allclose(response.foot_force[at], force, rtol=1e-9, atol=1e-12)


def test_natural_frequency_is_where_the_stiffness_belongs_to_it(tmp_path):
    """Bounce on four mounts k0 (1 + f/f0): m (2πf)² = 4 k0 (1 + f/f0), a quadratic."""
    (tmp_path / "k.csv").write_text(HEAD + "0,20,50,0.1\n400,420,1050,0.4\n")
    table = MountStiffness(file=str(tmp_path / "k.csv"))
    body = MachineOnMounts(HOUSING, MOUNTS, 0.0, mount_stiffness=table)
    roots = np.roots([4.0 * np.pi**2 * 35.0, -4.0 * 5e4 / 20.0, -4.0 * 5e4])
    frequencies, shapes = body.natural_modes()
    bounce = int(np.argmax(np.abs(shapes[:, 0, 2])))
    assert frequencies[bounce] == pytest.approx(roots.max(), rel=1e-9)


def test_natural_frequency_of_constant_mounts_beside_others_over_frequency(tmp_path):
    """Two opposite mounts k0 (1 + f/f0), two k0: m (2πf)² = 2 k0 (1 + f/f0) + 2 k0 in bounce."""
    (tmp_path / "k.csv").write_text(HEAD + "0,20,50,0.1\n400,420,1050,0.4\n")
    table = MountStiffness(file=str(tmp_path / "k.csv"))
    places = [(0.1, 0.0), (0.0, 0.1), (-0.1, 0.0), (0.0, -0.1)]
    feet = {f"foot_{n + 1}": {"x_m": x, "y_m": y} for n, (x, y) in enumerate(places)}
    for name in ("foot_1", "foot_3"):
        feet[name]["stiffness"] = table
    body = MachineOnMounts(HOUSING, MOUNTS, 0.0, feet=Feet.model_validate(feet))
    roots = np.roots([4.0 * np.pi**2 * 35.0, -2.0 * 5e4 / 20.0, -4.0 * 5e4])
    frequencies, shapes = body.natural_modes()
    bounce = int(np.argmax(np.abs(shapes[:, 0, 2])))
    assert frequencies[bounce] == pytest.approx(roots.max(), rel=1e-9)


@pytest.mark.parametrize("form", ["mobility", "receptance"])
def test_measured_floor_equals_the_mass_on_a_spring_that_it_is(tmp_path, form):
    floor = Floor(mass_kg=20.0, stiffness_n_per_m=4e5, loss_factor_ratio=0.05)
    hertz = np.array([3.0, 12.0, 50.0, 400.0])
    receptance = floor.receptance("front_left", hertz)[:, 2]
    if form == "mobility":
        head, values = "vertical_mobility_m_per_ns", 2j * np.pi * hertz * receptance
    else:
        head, values = "vertical_receptance_um_per_n", 1e6 * receptance
    rows = "".join(
        f"{f!r},{abs(value)!r},{float(np.degrees(np.angle(value)))!r}\n"
        for f, value in zip(hertz.tolist(), values.tolist(), strict=True)
    )
    text = f"# hammer\nfrequency_hz,{head},vertical_phase_deg\n{rows}"
    machine = machine_with(tmp_path, from_file("floor", "floor_mobility"), floor=text)
    body = on_mounts(machine)
    modelled = MachineOnMounts(machine.housing, machine.mounts, body.foot_height_m, floor=floor)
    found, expected = (each.response(LOAD, hertz) for each in (body, modelled))
    np.testing.assert_allclose(found.foot_force, expected.foot_force, rtol=1e-10)
    rigid = MachineOnMounts(machine.housing, machine.mounts, body.foot_height_m)
    assert np.abs(rigid.response(LOAD, hertz).foot_force / expected.foot_force - 1).max() > 0.1


def test_study_on_three_feet_goes_to_its_results(tmp_path):
    tables = (
        "".join(
            f"\n[feet.{name}]\n"
            f'x_mm = {{ value = {1e3 * x}, source = "drawing" }}\n'
            f'y_mm = {{ value = {1e3 * y}, source = "drawing" }}\n'
            for name, (x, y) in THREE.items()
        )
        + from_file("k", "feet.foot_3.stiffness")
        + from_file("floor", "floor_mobility")
    )
    floor = "foot,frequency_hz,vertical_mobility_m_per_ns,vertical_phase_deg\n" + "".join(
        f"foot_{foot},{hertz},1e-4,{90 - foot}\n" for foot in (1, 2, 3) for hertz in (5, 500)
    )
    machine = machine_with(tmp_path, tables, k=HEAD + "10,20,50,0.1\n", floor=floor)
    assert machine.unread == {"mounts.pitch_m"}
    study = load_study(ROOT / "tests" / "studies" / "tiny.toml")
    study = study.replace({"machine.file": str(tmp_path / "machine.toml")})
    results = pipeline.run(study, radiation=made_up_radiation)
    assert results["foot"].values.tolist() == list(THREE)
    assert "compliant under each foot" in " ".join(not_modelled(results))
    assert not [record for record in study.records if record.field == "mounts.pitch_mm"]


@pytest.mark.parametrize(
    ("table", "text", "words"),
    [
        ("mount_stiffness", "", "k.csv: is empty"),
        ("mount_stiffness", HEAD, "has no rows"),
        ("mount_stiffness", "frequency_hz,lateral_n_per_mm\n",
         "vertical_n_per_m, loss_factor are mi"),
        ("mount_stiffness", HEAD.replace("lateral_n_per_mm", "lateral_kg"),
         "lateral_kg: unit kg: must be N/m or N/mm"),
        ("mount_stiffness", HEAD.replace("loss_factor", "colour"), "vertical_n_per_mm, colour"),
        ("mount_stiffness", HEAD + "1,2,3\n", "line 2: 3 cells, the head has 4"),
        ("mount_stiffness", HEAD + "1,2,3,nan\n", "line 2: loss_factor = nan: must be a finite"),
        ("mount_stiffness", HEAD + "1,2,,0.1\n", "vertical_n_per_mm = nothing: must be a finite"),
        ("mount_stiffness", HEAD + "1,2,-3,0.1\n",
         "line 2: vertical_n_per_m = -3000 N/m: must be 100 to 1e+09 N/m"),
        ("mount_stiffness", HEAD + "1,2,3,11\n", "loss_factor = 11: allowed 0 to 10"),
        ("mount_stiffness", HEAD + "9,2,3,0\n9,2,3,0\n", "line 3: frequency_hz = 9: must rise"),
        ("floor_mobility", "frequency_hz,vertical_mobility_m_per_ns,vertical_phase_deg\n0,1,2\n",
         "frequency_hz = 0: must rise, from above 0"),
        ("floor_mobility", "frequency_hz,vertical_mobility_m_per_n,vertical_phase_deg\n1,1,2\n",
         "vertical_mobility_m_per_n: unit m_per_n: must be m/(N s)"),
        ("floor_mobility",
         "foot,frequency_hz,vertical_mobility_m_per_ns,vertical_phase_deg\nfront_left,1,1,2\n",
         "has no rows for front_right"),
    ],
)  # fmt: skip
def test_bad_files_are_refused_in_a_line(tmp_path, table, text, words):
    with pytest.raises(ParameterError) as refusal:
        machine_with(tmp_path, from_file("k", table), k=text)
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ('\n[mount_stiffness]\nfile = "k.csv"\n', "mount_stiffness.file = k.csv: needs a source"),
        (from_file("none", "mount_stiffness"), "none.csv: no such file"),
        ("".join(f'\n[feet.foot_{n}]\nx_mm = {{ value = {n}0, source = "d" }}\n'
                 'y_mm = { value = 0, source = "d" }\n' for n in (1, 2, 3)),
         "feet: the feet stand in one line"),
    ],
)  # fmt: skip
def test_bad_tables_are_refused_in_a_line(tmp_path, tables, words):
    with pytest.raises(ParameterError) as refusal:
        machine_with(tmp_path, tables, k=HEAD + "10,20,50,0.1\n")
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)
