"""Plug-ins, one file each outside the package: from the command line to the report."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from body_matrices import Mass, Spring, assembled, foot_forces, mass_of, natural_hz, on_feet, solved
from support import ROOT, TINY, assert_refused, command_here

import vibroacoustics.report.study  # noqa: F401  its registries exist before they are copied
from vibroacoustics.base import registry
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.radiation.transfer_vectors import pressure_per_velocity
from vibroacoustics.results.estimates import nominal
from vibroacoustics.results.storage import open_results
from vibroacoustics.study.loading import load_study

THIRD_PARTY = ROOT / "tests" / "third_party"
OPTION = """
[options.counter-shaft]
kind = "counter-shaft"
mass_g = { value = 10.0, source = "a test" }
radius_mm = { value = 20.0, source = "a test" }

[options.damper]
kind = "tuned-damper"
mass_g = { value = 800.0, source = "a test" }
frequency_hz = { value = 48.333, source = "a test" }
loss_factor_ratio = { value = 0.02, source = "a test" }
position_mm = { value = [90.0, -20.0, 110.0], source = "a test" }
directions = ["x", "y"]

[receivers."""
CRITERION = """[scoring.criteria]
force_2x_n = { weight = 1.0, best = 0.0, worst = 1.0 }
"""
SOURCE = """
[sources.table]
kind = "force-table"
force_n = [1000.0, 0.0, -1000.0, 0.0]

[sources.rumble]
kind = "rumble"
force_n = 20.0

[radiation]
"""
ENTRY_POINTS = """[vibroacoustics.options]
counter-shaft = counter_shaft:CounterShaft
tuned-damper = tuned_damper:TunedDamper
[vibroacoustics.sources]
force-table = force_table:ForceTable
rumble = rumble:Rumble
[vibroacoustics.criteria]
force_2x_n = second_order:SecondForce
[vibroacoustics.machines]
lone-rotor = lone_rotor:LoneRotor
"""


def command(*words: object, path: Path | None = None):
    """The command line in a process of its own, with installed packages of a folder."""
    searched = os.pathsep.join(filter(None, [str(path or ""), os.environ.get("PYTHONPATH", "")]))
    return subprocess.run(
        [sys.executable, "-m", "vibroacoustics", *map(str, words)],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": searched},
        check=False,
        timeout=300,
    )


def forgetful_command(*words: object, path: Path | None = None) -> subprocess.CompletedProcess[str]:
    """The command line of this process, which forgets plug-ins and installed packages again."""
    modules = set(sys.modules)
    with pytest.MonkeyPatch.context() as patch:
        for each in registry._REGISTRIES:
            len(each)  # fills it
            for name in ("_things", "_origins", "_faults"):
                patch.setattr(each, name, dict(getattr(each, name)))
            if path is not None:
                patch.setattr(each, "_filled", False)
        if path is not None:
            patch.syspath_prepend(path)
        outcome = command_here(*words)
    for name in set(sys.modules) - modules:
        if name.startswith("plugin_") or (path is not None and (path / f"{name}.py").is_file()):
            del sys.modules[name]
    return outcome


def plugins(*names: str) -> list[object]:
    return [word for name in names for word in ("--plugin", THIRD_PARTY / f"{name}.py")]


@pytest.fixture(scope="module")
def study(tmp_path_factory) -> Path:
    """The tiny study with a third party's balancer and criterion, on its coarsest settings."""
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    text = text.replace("[receivers.", OPTION.lstrip("\n"), 1)
    text = text.replace("[scoring.criteria]\n", CRITERION)
    text = text.replace("[radiation]\n", f'{SOURCE}room_solver = "closed-form"\n')
    file = tmp_path_factory.mktemp("study") / "study.toml"
    file.write_text(text)
    return file


@pytest.fixture(scope="module")
def finished(study, tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("out")
    named = plugins("counter_shaft", "tuned_damper", "second_order", "force_table", "rumble")
    outcome = forgetful_command("run", study, "--out", out, *named)
    assert outcome.returncode == 0, outcome.stderr
    return out


@pytest.fixture(scope="module")
def rigid(study, tmp_path_factory) -> Path:
    """The same without the sources: no value is sampled."""
    folder = tmp_path_factory.mktemp("rigid")
    file = folder / "study.toml"
    file.write_text(study.read_text().replace(SOURCE, "\n[radiation]\n"))
    named = plugins("counter_shaft", "tuned_damper", "second_order")
    outcome = forgetful_command("run", file, "--out", folder / "out", *named)
    assert outcome.returncode == 0, outcome.stderr
    return folder / "out"


def test_balancer_and_criterion_are_in_force_level_score_and_report(finished):
    results = open_results(finished / "results.nc")
    force = results["force_order"].sel(option="counter-shaft", source="balancer", order=1)
    size = 0.01 * 0.02 * (2.0 * np.pi * 2900.0 / 60.0) ** 2
    # x = -r cos θ, y = r sin θ: both components are of one size, 1e-12 is rounding.
    np.testing.assert_allclose(abs(force.values.squeeze()[:2]), size, rtol=1e-12)
    assert np.isfinite(results["level_total"].sel(option="counter-shaft")).all()
    assert "force_2x_n" in results["criterion"].values
    page = (finished / "report.html").read_text()
    for words in (
        "Its gears cost 2.5 W.",
        "The gears of the second shaft run without noise.",
        "Largest force at twice the speed",
    ):
        assert words in page
    assert "Power lost in the gears" in (finished / "figures.csv").read_text()
    assert "counter-shaft" in (finished / "comparison.csv").read_text()
    assert "force_2x_n" in (finished / "scores.csv").read_text()


def test_source_is_in_force_level_and_report(finished):
    """A cosine of 1 kN through four points: the first order alone."""
    results = open_results(finished / "results.nc")
    force = results["force_order"].sel(source="table", option="none", speed=2900.0)
    assert abs(force.sel(axis="x", order=1).item()) == pytest.approx(1e3, rel=1e-12)
    assert np.max(np.abs(force.sel(order=[2, 3, 5]))) < 1e-9
    alone = results["source_level"].sel(sound_source="table", option="none", receiver="front_1m")
    assert 0.0 < alone.item() < results["level_total"].sel(option="none").item()
    page = (finished / "report.html").read_text()
    assert "Force of the table" in page
    assert "Largest force of the table" in (finished / "figures.csv").read_text()


def test_noise_on_the_rigid_machine_is_that_of_one_mass_on_its_mounts(finished):
    """S |p v/F|² over each third octave, v/F = jω/(4 k (1 + jη) - ω² m), in level and share."""
    results = open_results(finished / "results.nc")
    machine = load_study(TINY).machine
    frequency = np.arange(0.5, 1000.0)
    omega, mounts = 2.0 * np.pi * frequency, machine.mounts
    held = 4.0 * mounts.vertical_stiffness_n_per_m * (1.0 + 1j * mounts.loss_factor_ratio)
    velocity = 1j * omega / (held - omega**2 * machine.housing.mass_kg)
    pressure = pressure_per_velocity(results["transfer_vector"])(frequency)[:, 2] * velocity
    density = 20.0**2 / 1000.0
    levels = nominal(results, "source_band_level").sel(sound_source="rumble", option="none")
    levels = levels.sel(speed=2900.0)
    assert levels.sizes["band"] > 10
    for index, band in enumerate(levels["band"].values):
        middle = 10.0 ** (0.1 * np.round(10.0 * np.log10(band)))
        within = np.abs(np.log10(frequency / middle)) < 0.05
        expected = density * np.sum(np.abs(pressure[:, within]) ** 2, axis=1)
        found = REFERENCE_PRESSURE_PA**2 * 10.0 ** (levels.isel(band=index).values / 10.0)
        assert found == pytest.approx(expected, rel=1e-6), band
    ways = results["path"].sel(path=results["path_source"] == "rumble").values.tolist()
    assert "rumble: housing tz" in ways


def hand_made(machine) -> tuple[np.ndarray, np.ndarray]:
    """Housing and damper of the study, mass and complex stiffness, (12, 12)."""
    mass_kg, point = 0.8, np.array([0.09, -0.02, 0.11])
    inertia = 0.4 * mass_kg * (mass_kg / (4.0 / 3.0 * np.pi * 7850.0)) ** (2.0 / 3.0)
    guide, square = 1e4, (2.0 * np.pi * 48.333) ** 2
    entries = [mass_kg, mass_kg, guide * mass_kg, *3 * [guide * inertia]]
    spring = (1.0 + 0.02j) * square * np.diag(entries)
    masses = [mass_of(machine.housing), Mass(mass_kg, inertia * np.eye(3), point)]
    return assembled(masses, [*on_feet(machine), Spring(1, 0, point, spring)])


def test_tuned_damper_is_two_rigid_bodies_solved_by_hand(rigid):
    """Housing, feet and natural frequencies to 1e-9 of the largest."""
    results, machine = open_results(rigid / "results.nc"), load_study(TINY).machine
    mass, stiffness = hand_made(machine)
    own = results.sel(option="damper", speed=2900.0).sum("source")
    loads = np.concatenate([own["force_order"].transpose("axis", "order").values,
                            own["moment_order"].transpose("axis", "order").values])  # fmt: skip
    loads = np.concatenate([loads, np.zeros_like(loads)])
    hertz = own["order_frequency"].values
    moved = np.array(
        [solved(mass, stiffness, load, f) for f, load in zip(hertz, loads.T, strict=True)]
    )
    velocity = 2j * np.pi * hertz[:, None] * moved[:, :6]
    found = own["velocity_order"].transpose("order", "dof").values
    np.testing.assert_allclose(found, velocity, rtol=0.0, atol=1e-9 * abs(velocity).max())
    force = np.array([foot_forces(on_feet(machine), one) for one in moved[1:]])
    feet = own["foot_force_order"].transpose("order", "foot", "axis").values[1:]
    np.testing.assert_allclose(feet, force, rtol=0.0, atol=1e-9 * abs(force).max())
    expected = natural_hz(mass, stiffness)
    modes = results["option_natural_frequency"].sel(option="damper").values
    np.testing.assert_allclose(modes, expected, rtol=0.0, atol=1e-9 * expected.max())
    assert np.isnan(results["option_natural_frequency"].sel(option="none")).all()
    passed_on = results["option_mount_transmissibility"].sel(option="damper")
    unit = np.zeros(12)
    unit[1] = 1.0
    for hertz in passed_on["mount_frequency"].values[::50]:
        feet = foot_forces(on_feet(machine), solved(mass, stiffness, unit, hertz))
        along_y = passed_on.sel(axis="y", mount_frequency=hertz).item()
        assert along_y == pytest.approx(feet[:, 1].sum(), rel=1e-9)


def test_tuned_damper_lowers_its_line_where_it_is(finished):
    """To the loss of its spring: without loss the point would not move along x and y."""
    results = open_results(finished / "results.nc")
    moved = {}
    for option in ("none", "damper"):
        own = results["velocity_order"].sel(option=option, speed=2900.0, order=1).sum("source")
        turned = np.cross(own.values[3:], [0.09, -0.02, 0.11])
        moved[option] = np.linalg.norm((own.values[:3] + turned)[:2])
    assert moved["damper"] < 0.5 * moved["none"]


def test_tuned_damper_is_in_report_and_figures(finished):
    page = (finished / "report.html").read_text()
    assert "Rigid-body modes on the mounts with attached bodies" in page
    assert re.search("damper moves along [xy] [0-9]+ %", page)
    assert "The ball of the tuned damper does not radiate sound" in page
    results = open_results(finished / "results.nc")
    added = results["reported_figure"].sel(figure="added_mass_kg", option="damper")
    assert added.values == pytest.approx(0.8, rel=1e-12)
    none, damper = (results["level_total"].sel(option=name) for name in ("none", "damper"))
    assert abs(none - damper).max() > 1e-3


def test_hashes_of_the_files_are_in_the_results(finished):
    kept = json.loads(open_results(finished / "results.nc").attrs["plugins"])
    assert kept["kind of option counter-shaft"]["file"] == "counter_shaft.py"
    assert all(re.fullmatch("[0-9a-f]{64}", own["sha256"]) for own in kept.values())


@pytest.mark.long
def test_the_report_is_made_again_without_the_files(finished, tmp_path):
    """In this process, which knows none of them."""
    outcome = command_here("report", finished / "results.nc", "--out", tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    assert (tmp_path / "report.html").read_bytes() == (finished / "report.html").read_bytes()


@pytest.fixture
def refused():
    """Asserts a refusal by the command line of this process, which forgets the plug-ins again."""

    def refused(words: list[object], *said: str) -> None:
        assert_refused(forgetful_command(*words), *said)

    return refused


def test_without_the_files_the_study_is_refused(study, refused, tmp_path):
    run = ["run", study, "--out", tmp_path]
    refused(run, "options.counter-shaft.kind = counter-shaft: unknown", "allowed")
    named = plugins("counter_shaft", "tuned_damper", "force_table", "rumble")
    refused([*run, *named], "force_2x_n", "unknown")
    named = plugins("counter_shaft", "tuned_damper", "second_order", "rumble")
    refused([*run, *named], "sources.table.kind = force-table: unknown; allowed")
    assert not any(tmp_path.iterdir())


def test_refusal_names_key_unit_and_bounds(study, refused, tmp_path):
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(study.read_text().replace("mass_g = { value = 10.0", "mass_g = { value = 2e3"))
    named = plugins("counter_shaft", "tuned_damper", "second_order", "force_table", "rumble")
    run = ["run", wrong, "--out", tmp_path / "out", *named]
    refused(run, "options.counter-shaft.mass_g = 2000.0 g", "above 0 to 1000 g")


def test_a_name_that_is_built_in_is_refused(study, tmp_path):
    clash = tmp_path / "clash.py"
    text = (THIRD_PARTY / "counter_shaft.py").read_text()
    clash.write_text(text.replace('"counter-shaft"', '"lanchester"'))
    outcome = forgetful_command("run", study, "--plugin", clash)
    assert_refused(outcome, "clash.py: kind of option lanchester: is built in")


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Path:
    """A folder of installed packages that holds the plug-ins with their entry points."""
    folder = tmp_path_factory.mktemp("site")
    for file in THIRD_PARTY.glob("*.py"):
        text = file.read_text().replace("@vibroacoustics.register\n", "")
        (folder / file.name).write_text(text)
    information = folder / "third_party-1.2.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: third_party\nVersion: 1.2\n"
    )
    (information / "entry_points.txt").write_text(ENTRY_POINTS)
    return folder


@pytest.mark.long
def test_installed_packages_need_no_word_on_the_command_line(study, installed, tmp_path):
    outcome = command("run", study, "--out", tmp_path, path=installed)
    assert outcome.returncode == 0, outcome.stderr
    kept = json.loads(open_results(tmp_path / "results.nc").attrs["plugins"])
    assert kept["kind of option counter-shaft"]["version"] == "1.2"


def rotor_study(folder: Path) -> Path:
    """A study of a third party's machine: the Copeland's housing with a lone rotor in it."""
    machine = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text()
    tables = re.split(r"(?m)^(?=\[)", machine)
    kept = [
        table
        for table in tables[1:]
        if re.match(r"\[(housing|mounts|shell|overall_noise)\b", table)
    ]
    unbalance = (
        'unbalance_mass_g = { value = 5.0, source = "a test" }\n'
        'unbalance_radius_mm = { value = 20.0, source = "a test" }\n'
    )
    (folder / "rotor.toml").write_text(
        f'name = "A lone rotor"\nkind = "lone-rotor"\n{unbalance}\n{"".join(kept)}'
    )
    text = TINY.read_text().replace("../../data/machines/copeland_zp41k3e.toml", "rotor.toml")
    text = re.sub(r"(?s)\[options\.counterweight-half\].*?\n\n", "", text)
    text = text.replace("[radiation]\n", '[radiation]\nroom_solver = "closed-form"\n')
    (folder / "study.toml").write_text(text)
    return folder / "study.toml"


def test_a_kind_of_machine_runs_to_the_report(refused, tmp_path):
    study = rotor_study(tmp_path)
    named = plugins("lone_rotor")
    outcome = forgetful_command("run", study, "--out", tmp_path / "out", *named)
    assert outcome.returncode == 0, outcome.stderr
    results = open_results(tmp_path / "out" / "results.nc")
    size = 0.005 * 0.02 * (2.0 * np.pi * 2900.0 / 60.0) ** 2
    assert results["force_amplitude"].sel(order=1).item() == pytest.approx(size, rel=1e-12)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "The rotor&#39;s bearings are left out." in page
    again = tmp_path / "again"
    shutil.copytree(tmp_path / "out", again)
    assert command_here("report", again / "results.nc").returncode == 0
    refused(["run", study, "--out", tmp_path / "no"], "machine.kind = lone-rotor: unknown")


def test_a_ring_option_is_refused_on_a_third_partys_machine(refused, tmp_path):
    study = rotor_study(tmp_path)
    ring = '[options.damped]\nkind = "ring-damping"\ndamping_ns_per_m = 5.0\n\n[receivers.'
    study.write_text(study.read_text().replace("[receivers.", ring, 1))
    words = "options.damped.kind = ring-damping: needs an Oldham ring; the machine"
    refused(["run", study, *plugins("lone_rotor")], words)
