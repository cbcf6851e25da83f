"""Values that are usual alone and contradict each other: forces, masses, speeds, mounts."""

import math
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from support import ROOT

import vibroacoustics as va
from vibroacoustics.machine.isolation import natural_frequency_hz, total_stiffness
from vibroacoustics.machine.usual import doubt_of_mass
from vibroacoustics.transfer.feet import Stand

TABLE = ROOT / "data" / "machines" / "reciprocating_table.toml"
STUDY = ROOT / "pipelines" / "reciprocating_table.toml"
MASS_KG, AMPLITUDE_M = 3.7319, 0.049988  # piston and part of the rod; half the stroke
SHIPPED = sorted((ROOT / "pipelines").glob("*.toml"))


def doubts(load, *args) -> list[str]:
    """Warnings of loading, each one line."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        load(*args)
    lines = [str(each.message) for each in caught]
    assert not any("\n" in line for line in lines)
    return lines


def machine_file(folder: Path, *changes: tuple[str, str]) -> Path:
    """The machine by table with changed lines, each a pattern and what takes its place."""
    text = TABLE.read_text(encoding="utf-8").replace("../tables", str(ROOT / "data" / "tables"))
    for pattern, replacement in changes:
        text, count = re.subn(pattern, replacement, text, count=1)
        assert count == 1
    file = folder / "machine.toml"
    file.write_text(text, encoding="utf-8")
    return file


def study_file(folder: Path, machine: Path, speeds: str = "[800.0, 950.0, 1200.0]") -> Path:
    text = STUDY.read_text(encoding="utf-8").replace("[800.0, 950.0, 1200.0]", speeds)
    text = text.replace("../data/machines/reciprocating_table.toml", str(machine))
    file = folder / "study.toml"
    file.write_text(text.replace("../data", str(ROOT / "data")), encoding="utf-8")
    return file


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: file.stem)
def test_no_shipped_study_is_doubted(file):
    assert doubts(va.load_study, file) == []


@pytest.mark.parametrize(("factor", "is_doubted"), [(0.1, True), (0.5, False), (4.5, False),
                                                    (5.5, False), (9.0, True)])  # fmt: skip
def test_a_mass_beside_a_table_of_other_forces(tmp_path, factor, is_doubted):
    """The forces of the table are 1.73 m r ω² of its mass: 9 times the mass is 5.2 times them."""
    machine = va.load_machine(TABLE)
    mass = factor * MASS_KG
    values = "".join(
        f'{key} = {{ value = {value}, source = "made up" }}\n'
        for key, value in (("mass_kg", mass), ("amplitude_mm", 1e3 * AMPLITUDE_M))
    )
    file = machine_file(tmp_path, (r"\[sliding_mass\]\n", f"[sliding_mass]\n{values}"))
    lines = doubts(va.load_machine, file)
    assert bool(lines) == is_doubted
    if lines:
        first = machine.forces.orders_at(1200.0).sum(axis=0)[2, 1]
        inertia = mass * AMPLITUDE_M * (40.0 * math.pi) ** 2
        assert lines[0].startswith(f"{file}: forces.file = reciprocating_forces.csv: order 1 along")
        for words in (f"{abs(first):.3g} N at 1200 rpm", f"sliding_mass.mass_kg = {mass:g} kg",
                      "amplitude_m = 0.049988 m", f"= {inertia:.3g} N"):  # fmt: skip
            assert words in lines[0]


def test_m_r_omega_squared():
    """A mass of 2 kg at 50 mm, 3000 rpm: 2 · 0.05 · (100π)² = 9870 N."""
    for force, is_doubted in ((9870.0, False), (49e3, False), (50e3, True), (1900.0, True)):
        assert bool(doubt_of_mass("oldham", force, 2.0, 0.05, 3000.0)) == is_doubted


@pytest.mark.parametrize(
    ("speeds", "scaling", "words"),
    [
        ("[1300.0]", "", "has 800 to 1200 rpm"),
        ("[950.0]", "", ""),
        ("[2500.0]", 'scaling = "inertia"\n', "is scaled from 1200 rpm"),
        ("[2300.0]", 'scaling = "inertia"\n', ""),
    ],
)
def test_speeds_of_a_table_and_of_a_study(tmp_path, speeds, scaling, words):
    changes = []
    if scaling:
        rows = (ROOT / "data" / "tables" / "reciprocating_forces.csv").read_text().splitlines()
        kept = [row for row in rows if not re.match(r"(800|900|1000|1100)\.0,", row)]
        (tmp_path / "one.csv").write_text("\n".join(kept))
        line = f'file = {{ value = "{tmp_path / "one.csv"}", source = "a test" }}\n{scaling}'
        changes = [(r'(?s)file = \{ value = "[^"]*reciprocating_forces\.csv.*?\}', line)]
    file = study_file(tmp_path, machine_file(tmp_path, *changes), speeds)
    lines = doubts(va.load_study, file)
    assert bool(lines) == bool(words)
    if words:
        rpm = speeds[1:-1].removesuffix(".0")
        assert lines[0].startswith(f"{file}: operation.speed_rpm = {rpm} rpm: forces.file = ")
        assert words in lines[0]


def test_speeds_far_apart(tmp_path):
    lines = "speed_rpm,crank_angle_deg,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm\n" + "".join(
        f"{speed},{45 * step},{math.cos(step * math.pi / 4)},0,0,0,0,0\n"
        for speed in (1000, 1900, 4000)
        for step in range(8)
    )
    (tmp_path / "f.csv").write_text(lines)
    forces = type(va.load_machine(TABLE).forces)(file=str(tmp_path / "f.csv"))
    assert not forces.doubt_at(1500.0)
    assert not forces.doubt_at(4000.0)
    assert "between 1900 and 4000 rpm" in forces.doubt_at(2000.0)


@pytest.mark.parametrize(("natural_hz", "is_doubted"), [(9.0, False), (9.6, True), (13.3, True)])
def test_mounts_that_order_1_meets(tmp_path, natural_hz, is_doubted):
    """800 rpm is 13.33 Hz: isolated above √2 times the natural frequency, 9.43 Hz."""
    stiffness = (2.0 * math.pi * natural_hz) ** 2 * 260.0 / 5.0 / 1e3
    changes = (
        (r"(?s)\[mount_stiffness\]\nfile = .*?\}\n", ""),
        (r"vertical_stiffness_n_per_mm = \{ value = 150\.0",
         f"vertical_stiffness_n_per_mm = {{ value = {stiffness}"),
        (r"range = \[80\.0, 300\.0\]", f"range = [{0.5 * stiffness}, {2.0 * stiffness}]"),
    )  # fmt: skip
    text = study_file(tmp_path, machine_file(tmp_path, *changes)).read_text(encoding="utf-8")
    text = re.sub(r"(?s)\[options\.softer-mounts\].*?(?=\[receivers\.front)", "", text)
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    lines = doubts(va.load_study, tmp_path / "study.toml")
    assert bool(lines) == is_doubted
    if lines:
        (line,) = lines
        assert line.startswith(f"{tmp_path / 'study.toml'}: operation.speed_rpm = 800 rpm is 1x at")
        for words in ("mounts, vertical,", f"{5e3 * stiffness:.3g} N/m", "260 kg",
                      f"resonates at {natural_hz:.3g} Hz"):  # fmt: skip
            assert words in line


@pytest.mark.parametrize("name", ["reciprocating_table", "copeland_zp41k3e", "zhao_minicrank"])
@pytest.mark.parametrize("hertz", [10.0, 100.0])
def test_stiffness_of_all_mounts_is_that_of_the_load_path(name, hertz):
    machine = va.load_machine(ROOT / "data" / "machines" / f"{name}.toml")
    feet = () if machine.feet is None else tuple(machine.feet.by_name.values())
    stand = Stand(machine.mounts, 0.0, machine.feet, machine.mount_stiffness)
    bushings = stand.bushings("housing")
    diagonal = sum(
        np.real(each.over_frequency(np.array(hertz))) if each.over_frequency
        else np.diagonal(each.stiffness)[:3]
        for each in bushings
    )  # fmt: skip
    total = total_stiffness(machine.mounts, feet, machine.mount_stiffness, hertz)
    np.testing.assert_allclose(total, diagonal[1:3], rtol=1e-12)


def test_natural_frequency_of_a_mass_on_springs():
    assert natural_frequency_hz(4.0 * math.pi**2 * 100.0 * 7.0, 7.0) == pytest.approx(10.0)
