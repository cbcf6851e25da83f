"""What can be sampled: every value with a range, whole numbers, what follows, what contradicts."""

import shutil
from dataclasses import replace
from operator import attrgetter
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from sampled_machines import all_sampled
from sources_study import (
    SOURCES_STUDY,
    case_of,
    made_up_modes,
    nominal_run,
    path_of,
    run_made_up,
    with_tables,
)
from support import MACHINE_FILE, ROOT

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.machine.cases import Cases
from vibroacoustics.machine.machine import Machine
from vibroacoustics.machine.source import Shared
from vibroacoustics.radiation.pressure import wrench_pressure
from vibroacoustics.radiation.transfer_vectors import pressure_per_velocity
from vibroacoustics.sources.cases import loads_of, without_time_series
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.samples import samples_of, with_sample
from vibroacoustics.study.sampling import latin_hypercubes, narrowed
from vibroacoustics.study.study import Study
from vibroacoustics.study.uncertainty import Range
from vibroacoustics.transfer.load_path import LoadPath
from vibroacoustics.transfer.machine import on_mounts
from vibroacoustics.transfer.observers import Observers
from vibroacoustics.transfer.path import computed_path
from vibroacoustics.transfer.study_path import projection_errors
from vibroacoustics.uncertainty.every_sample import in_every_sample
from vibroacoustics.uncertainty.sampled_cases import moves_otherwise, sampled_cases
from vibroacoustics.uncertainty.sampled_forces import amplitudes, force_variables, sampled_forces

TEXT = SOURCES_STUDY.read_text(encoding="utf-8")
MACHINE_TEXT = MACHINE_FILE.read_text(encoding="utf-8")
TWELVE = (
    ("gas", "polytropic_index"),
    ("gas", "equalisation_angle_rad"),
    ("keys", "clearance_m"),
    ("keys", "crown_radius_m"),
    ("keys", "restitution_ratio"),
    ("keys", "oil_layer_m"),
    ("keys", "friction_ratio"),
    ("keys", "scroll_inertia_kg_m2"),
    ("motor", "capacitance_f"),
    ("structure", "loss_factor_ratio"),
    ("variation", "mobility_change_db"),
    ("variation", "frequency_factor_ratio"),
)


@pytest.fixture(scope="module")
def study() -> Study:
    return load_study(SOURCES_STUDY)


def load_changed(folder: Path, *replaced: tuple[str, str], study: str = TEXT) -> Study:
    """The study with texts of its machine file replaced."""
    text = MACHINE_TEXT
    for old, new in replaced:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    shutil.copytree(ROOT / "data" / "validation", folder / "validation", dirs_exist_ok=True)
    (folder / "machine.toml").write_text(text, encoding="utf-8")
    named = study.replace("../../data/machines/copeland_zp41k3e.toml", "machine.toml")
    (folder / "study.toml").write_text(named, encoding="utf-8")
    return load_study(folder / "study.toml")


def within(study: Study, *names: str) -> Study:
    """The study with these ranges only."""
    kept = tuple(item for item in study.ranges if item.name in names)
    assert len(kept) == len(names)
    return study.model_copy(update={"ranges": kept})


# --- which values --------------------------------------------------------------------------------


def test_every_value_with_a_range_is_sampled_or_held_with_a_reason(study):
    """Of the tables that the study reads: that of the shaft is not among them."""
    ranged = {
        record.field.rpartition(".")[0]
        for record in study.records
        if record.file == MACHINE_FILE.name and record.lowest is not None
    }
    sampled, held = (
        {item.table for item in study.ranges},
        {item.table for item in study.held_ranges},
    )
    assert sampled | held == ranged
    assert held == {"kinematics", "shell", "stopping", "overall_noise", "remainder"}
    count = sum(record.lowest is not None for record in study.records)
    assert len(study.ranges) + len(study.held_ranges) == count > 60
    assert "structure.bearing_housing.height_m" in {item.name for item in study.ranges}
    assert all(len(item.reason) > 20 for item in study.held_ranges)
    assert "two studies" in study.held_ranges[0].reason


def test_a_study_without_sources_samples_nothing():
    thesis = load_study(ROOT / "pipelines" / "copeland_thesis.toml")
    assert thesis.ranges == thesis.held_ranges == ()


def test_data_of_the_catalogue_are_not_sampled(tmp_path):
    level = 'value = 56.0, source = "thesis table 2, sound pressure level at 1 m"'
    changed = load_changed(tmp_path, (level, f"{level}, range = [54.0, 58.0]"))
    held = {item.name: item.reason for item in changed.held_ranges}
    assert "data" in held["overall_noise.level_dba"]
    assert "overall_noise.level_dba" not in {item.name for item in changed.ranges}


def test_values_of_measured_modes_do_not_change_with_the_wall(tmp_path):
    text = TEXT.replace("[uncertainty]", '[shell_modes]\nfile = "modes.uff"\n\n[uncertainty]')
    measured = load_changed(tmp_path, study=text)
    held = {item.name: item.reason for item in measured.held_ranges}
    assert "measured" in held["structure.thickness_m"]
    assert "structure.bearing_housing.welds" not in held
    assert Path(measured.shell_modes.file).is_relative_to(tmp_path)


OF_EVERY_KIND = ("mayekawa_wbhe", "mayekawa_banks", "dagilis_slider_link", "estupinan_hermetic",
                 "zhao_minicrank")  # fmt: skip


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("mayekawa_wbhe", "gas.crankcase_pressure_pa"),
        ("mayekawa_banks", "cylinders.rod_pitch_m"),
        ("dagilis_slider_link", "suspension.discharge_tube.inner_diameter_m"),
        ("estupinan_hermetic", "shaft.rotor_distance_m"),
        ("zhao_minicrank", "mounts.pitch_m"),
    ],
)
def test_every_machine_takes_the_ends_of_its_ranges(tmp_path, monkeypatch, name, value):
    study = all_sampled(tmp_path, monkeypatch, name, 200)
    assert value in {item.name for item in study.ranges}
    lists = {item.name for item in study.held_ranges if item.reason == "are lists"}
    assert bool(lists) == (study.machine.suspension is not None or name == "mayekawa_banks")


@pytest.mark.filterwarnings("error:.*contradict themselves")
@pytest.mark.parametrize("name", OF_EVERY_KIND)
def test_all_of_200_samples_of_every_machine_fit_together(tmp_path, monkeypatch, name):
    """Without limits 11, 2, 15, 10 and 35 % of them contradict themselves."""
    study = all_sampled(tmp_path, monkeypatch, name, 200)
    found = samples_of(study)
    assert len(found.samples) == 200
    assert not found.refused
    for limits in study.ranges:
        values = [sample[limits.table, limits.field] for sample in found.samples]
        assert limits.lowest <= min(values) <= max(values) <= limits.highest


def test_samples_are_refused_without_the_limits(tmp_path, monkeypatch):
    """That the samples above fit is the limits' doing."""
    study = all_sampled(tmp_path, monkeypatch, "zhao_minicrank", 200)
    monkeypatch.setattr(type(study.machine), "limits", ())
    found = samples_of(study)
    assert len(found.refused) > 0.2 * found.tried


def test_a_narrowed_value_keeps_its_share_of_the_range():
    even = Range(table="a", field="b", lowest=1.0, highest=3.0)
    assert narrowed(even, 1.5, -np.inf, np.inf) == 1.5
    assert narrowed(even, 1.5, 0.0, 2.0) == pytest.approx(1.25)
    assert narrowed(even, 1.5, 2.0, 9.0) == pytest.approx(2.25)
    assert narrowed(even, 1.5, 4.0, 5.0) == 1.5  # nothing is left: it is refused as it stands
    wide = Range(table="a", field="b", lowest=1.0, highest=100.0)
    assert narrowed(wide, 10.0, 1.0, 25.0) == pytest.approx(5.0)


# --- whole numbers -------------------------------------------------------------------------------


def test_whole_numbers_are_sampled_as_such_and_each_as_often(study):
    limits = Range(table="structure.stator", field="welds", lowest=4, highest=8, integer=True)
    settings = study.uncertainty.model_copy(update={"random_samples": 50})
    sampled = [
        sample["structure.stator", "welds"]
        for sample in next(latin_hypercubes((limits,), settings))
    ]
    assert all(isinstance(value, int) for value in sampled)
    assert np.bincount(sampled, minlength=9)[4:].tolist() == [10] * 5
    whole = {item.name for item in study.ranges if item.integer}
    assert whole == {
        f"structure.{joint}.welds" for joint in ("bearing_housing", "fixed_scroll", "stator")
    }


def test_range_of_a_whole_number_with_a_broken_end_is_refused(tmp_path):
    old = 'three or four are usual", range = [3, 4]'
    with pytest.raises(ParameterError, match=r"structure\.bearing_housing\.welds = 4\.5"):
        load_changed(tmp_path, (old, old.replace("[3, 4]", "[3, 4.5]")))


# --- what follows from others --------------------------------------------------------------------


def test_orbit_follows_the_wraps(study):
    base = study.machine
    sampled = with_sample(base, base, {("wraps", "thickness_m"): 3.0e-3})
    ratio = sampled.wraps.orbit_radius_m / base.wraps.orbit_radius_m
    assert ratio > 1.05
    assert sampled.kinematics.orbit_radius_m == pytest.approx(
        ratio * base.kinematics.orbit_radius_m, rel=1e-12
    )


def test_inertias_follow_the_masses_unless_they_are_sampled_themselves(study):
    base = study.machine
    mass = {("housing", "mass_kg"): 28.0, ("orbiting_scroll", "mass_kg"): 1.8}
    sampled = with_sample(base, base, mass)
    assert sampled.housing.inertia_xx_kg_m2 == pytest.approx(0.57 * 28.0 / 35.0)
    assert sampled.housing.inertia_yy_kg_m2 == pytest.approx(0.57 * 28.0 / 35.0)
    assert sampled.keys.scroll_inertia_kg_m2 == pytest.approx(8e-4 * 1.5)
    apart = with_sample(base, base, {**mass, ("housing", "inertia_xx_kg_m2"): 0.5})
    assert apart.housing.inertia_xx_kg_m2 == 0.5
    assert apart.housing.inertia_yy_kg_m2 == pytest.approx(0.5)  # round about z
    light = {("housing", "inertia_xx_kg_m2"): 0.45, ("housing", "inertia_zz_kg_m2"): 0.10}
    assert with_sample(base, base, light).housing.inertia_yy_kg_m2 == pytest.approx(
        0.45
    )  # not 0.57
    said = {item.name: item.independent_of for item in study.ranges if item.independent_of}
    assert said == {
        "housing.inertia_xx_kg_m2": ("housing.mass_kg",),
        "housing.inertia_zz_kg_m2": ("housing.mass_kg",),
        "keys.scroll_inertia_kg_m2": ("orbiting_scroll.mass_kg",),
    }


def test_the_twelve_values_change_themselves_alone(study):
    """As a plain copy with these values: nothing follows from them."""
    base = study.machine
    for sample in next(latin_hypercubes(study.ranges, study.uncertainty)):
        tables: dict[str, dict[str, float]] = {}
        for table, field in TWELVE:
            tables.setdefault(table, {})[field] = sample[table, field]
        twelve = {pair: sample[pair] for pair in TWELVE}
        assert with_sample(base, base, twelve) == with_tables(study, **tables).machine
        assert not moves_otherwise(with_sample(base, base, twelve), base, study)


# --- contradictions ------------------------------------------------------------------------------


def test_samples_that_contradict_themselves_are_told_and_sampled_anew(tmp_path):
    """8 welds of up to 100° do not fit around: 360° are 45° each."""
    old = 'lands of 30 mm", range = [10.0, 40.0]'
    many = TEXT.replace("random_samples = 4", "random_samples = 20")
    told = r"study\.toml: \d+ of \d+ samples \(\d+ %\) contradict themselves.*spread_deg"
    with pytest.warns(UserWarning, match=told):
        changed = load_changed(tmp_path, (old, old.replace("40.0", "100.0")), study=many)
    found = samples_of(changed)
    assert len(found.samples) == changed.uncertainty.random_samples
    assert found.refused
    for sample in found.samples:
        joint = with_sample(changed.machine, changed.machine, sample).structure.stator
        assert joint.welds * joint.spread_rad <= 2.0 * np.pi


def test_ranges_that_hardly_ever_fit_are_refused(tmp_path):
    old = 'lands of 30 mm", range = [10.0, 40.0]'
    few = 'lands of the laminations touch the shell", range = [4, 8]'
    with pytest.raises(ParameterError, match=r"samples contradict themselves.*welds") as refusal:
        load_changed(
            tmp_path,
            (old, old.replace("[10.0, 40.0]", "[20.0, 360.0]")),
            (few, few.replace("[4, 8]", "[6, 64]")),
        )
    assert len(str(refusal.value).splitlines()) == 1


def test_sources_have_their_say_on_a_sample(study, monkeypatch):
    """The wraps must orbit as the machine does."""
    kind = type(study.sources["gas"])
    monkeypatch.setattr(
        kind,
        "why_not",
        classmethod(lambda cls, m: "too light" if m.housing.mass_kg < 31.5 else None),
    )
    found = samples_of(study)
    assert set(found.refused) == {"sources.gas: too light"}
    assert all(sample["housing", "mass_kg"] >= 31.5 for sample in found.samples)


@pytest.mark.long
def test_a_sample_without_solution_has_no_weight(study, monkeypatch):
    revolution = type(study.machine).revolution

    def at_times(machine: Machine, speed_rpm: float, samples: int):
        if machine.orbiting_scroll.mass_kg > 1.55:
            raise SolverError("it does not turn")
        return revolution(machine, speed_rpm, samples)

    monkeypatch.setattr(type(study.machine), "revolution", at_times)
    heavy = [sample["orbiting_scroll", "mass_kg"] > 1.55 for sample in samples_of(study).samples]
    assert sum(heavy) == 1
    quiet = with_tables(study, overall_noise={"level_dba": 90.0})
    with pytest.warns(UserWarning, match="1 of 4 samples have no solution.*it does not turn"):
        results = run_made_up(quiet)
    first = slice(len(heavy))  # of the bank
    assert np.isnan(results["prior_sample_level"].values[first]).tolist() == heavy
    assert (results["prior_sample_weight"].values[0, first] == 0.0).tolist() == heavy
    assert np.isfinite(results["level_modelled_by_sample"].values).all()
    rows = {tuple(row) for row in results["sampled_value"].values}
    assert not np.isnan([*rows]).any()
    mass = results["sampled_value"].sel(uncertain_parameter="orbiting_scroll.mass_kg")
    assert mass.max() <= 1.55


def test_every_sample_is_told_of_in_order():
    found = in_every_sample([{("a", "b"): 1.0}, {("a", "b"): 2.0}], lambda d: d["a", "b"], -1.0, no)
    assert found == [1.0, 2.0]


def no(*_: object) -> None:
    """No progress."""


# --- motion --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def rigid(study):
    return pressure_per_velocity(made_up_modes(study)["transfer_vector"])


def sampled_pressure(study, rigid, sample, option="none"):
    case = case_of(study, option)
    bare, _ = without_time_series(replace(case, shared=Shared()), {})
    key = (case.speed_rpm, option)
    sampled = sampled_cases(Cases({key: bare}, {}, {key: {}}), study, sample)
    if not sampled.wrenches[key]:
        return None
    path, moved = LoadPath(on_mounts(sampled.cases[key].machine)), sampled.wrenches[key]
    orders = np.arange(next(iter(moved["moving_parts"].values())).shape[-1])
    frequency = case.shaft_frequency_hz * orders
    return {name: path.observed(Observers(rigid), load, frequency) for name, load in moved.items()}


def test_motion_as_given_sounds_as_in_the_results(study, rigid):
    """A change by 1e-12 of a mount goes the way of the samples."""
    results = nominal_run()
    stiffness = study.machine.mounts.vertical_stiffness_n_per_m * (1.0 + 1e-12)
    sample = {("mounts", "vertical_stiffness_n_per_m"): stiffness}
    for option in study.options:
        expected = wrench_pressure(results, "transfer_vector").sel(speed=2900.0, option=option)
        expected = expected.sum("source").transpose("receiver", "order").values
        found = sampled_pressure(study, rigid, sample, option)["moving_parts"]
        size = np.abs(expected).max()
        np.testing.assert_allclose(found, expected, atol=1e-9 * size, err_msg=option)


def test_forces_are_those_of_a_machine_with_the_sampled_values(study):
    """Of every option, beside a run of a study whose machine has the sampled mounts."""
    stiffness = 4.0 * study.machine.mounts.lateral_stiffness_n_per_m
    sample = {("mounts", "lateral_stiffness_n_per_m"): stiffness}
    machine = with_sample(study.machine, study.machine, sample)
    expected = run_made_up(study.model_copy(update={"machine": machine, "ranges": ()}))
    given = run_made_up(study.model_copy(update={"ranges": ()}))
    for option in study.options:
        case = case_of(study, option)
        bare, _ = without_time_series(replace(case, shared=Shared()), {})
        key = (case.speed_rpm, option)
        sampled = sampled_cases(Cases({key: bare}, {}, {key: {}}), study, sample)
        found = amplitudes(sampled.cases[key], sampled.wrenches[key])
        at = {"speed": 2900.0, "option": option}
        for name, values in found.items():
            of_machine = expected[name].sel(at).transpose(..., "order").values
            np.testing.assert_allclose(values, of_machine, rtol=1e-9, atol=1e-9, err_msg=option)
        foot, nominal = (
            one["largest_foot_force"].sel(order=1, **at).item() for one in (expected, given)
        )
        assert found["foot_force_amplitude"][:, 1].max() == pytest.approx(foot, rel=1e-9)
        assert abs(foot / nominal - 1.0) > 0.1


def test_forces_that_a_sample_leaves_are_the_nominal_ones(study):
    """Samples of the keys' friction leave the motion, and change the figures of the keys."""
    given = run_made_up(study.model_copy(update={"ranges": ()}))
    nominal = Cases({}, {}, {})
    for option in study.options:
        key, case = (2900.0, option), case_of(study, option)
        nominal.wrenches[key] = {}
        bare = without_time_series(replace(case, shared=Shared()), loads_of(study, case))
        nominal.cases[key], nominal.loads[key] = bare
    sampled = sampled_cases(nominal, study, {("keys", "friction_ratio"): 0.05})
    own = sampled_forces(study, nominal, sampled, given)
    assert all(list(values) == ["reported_figure"] for values in own.values())
    values = force_variables(own, given)
    assert set(values) == {
        "force_amplitude", "moment_amplitude", "foot_force_amplitude", "largest_foot_force",
        "reported_figure",
    }  # fmt: skip
    for name in sorted(set(values) - {"reported_figure"}):
        nominal_values = given[name].transpose("speed", "option", ...).values
        np.testing.assert_array_equal(values[name], nominal_values, err_msg=name)
    peak = given["figure"].values.tolist().index("key_force_peak_n")
    force = given["reported_figure"].transpose("speed", "option", "figure").values[..., peak]
    assert np.all(values["reported_figure"][..., peak] != force)


@pytest.mark.long
def test_forces_by_sample_are_in_the_results_and_nominal_where_no_sample_moves(study):
    """Samples of the keys' friction leave the motion."""
    ranges = (Range(table="keys", field="friction_ratio", lowest=0.05, highest=0.15),)
    settings = study.uncertainty.model_copy(update={"random_samples": 4})
    quiet = study.model_copy(update={"ranges": ranges, "uncertainty": settings})
    results = run_made_up(quiet)
    for name, variable in (("force", "force_amplitude"), ("moment", "moment_amplitude"),
                           ("foot_force", "largest_foot_force")):  # fmt: skip
        given = results[f"{variable}_nominal"].sel(order=1)
        np.testing.assert_array_equal(results[variable].sel(order=1), given)
        sampled = results[f"{name}_1x_by_sample"]
        assert sampled.sizes["sample"] == results.sizes["sample"]
        np.testing.assert_array_equal(
            sampled, given.broadcast_like(sampled).transpose(*sampled.dims)
        )


def test_motion_that_a_sample_leaves_is_not_computed_anew(study, rigid):
    assert sampled_pressure(study, rigid, {("keys", "friction_ratio"): 0.05}) is None
    assert sampled_pressure(study, rigid, {("structure", "thickness_m"): 3e-3}) is None


def test_soft_mounts_and_heavy_rings_change_the_first_order(study, rigid):
    """Far above resonance velocity is force over mass: a lighter machine is louder by its mass;
    the ring alone makes the force, so its sound grows as its mass."""
    given = sampled_pressure(study, rigid, {("mounts", "pitch_m"): 0.19})["moving_parts"][:, 1]
    lossy = sampled_pressure(study, rigid, {("mounts", "loss_factor_ratio"): 0.2})
    assert np.abs(lossy["moving_parts"][:, 1] / given - 1.0).max() > 1e-4
    heavy = sampled_pressure(
        study, rigid, {("oldham", "mass_kg"): 2.0 * 0.0727, ("mounts", "pitch_m"): 0.19}
    )
    np.testing.assert_allclose(heavy["moving_parts"][:, 1], 2.0 * given, rtol=1e-9)


def test_counterweights_balance_every_sample(study, rigid):
    """They follow from the orbiting parts: a heavier scroll shakes no more than a light one."""
    sample = {("orbiting_scroll", "mass_kg"): 1.8, ("orbiting_scroll", "height_m"): 0.07}
    case = case_of(study)
    sampled = with_sample(study.machine, study.machine, sample)
    wrenches = sampled.revolution(2900.0, 256).wrenches
    force = sum(w.force_n for name, w in wrenches.items() if name != "oldham")
    assert np.abs(wrenches["orbiting_scroll"].force_n).max() > 500.0
    assert np.abs(force).max() < 1e-8  # rounding of some kN
    assert moves_otherwise(sampled, case.machine, study)


def test_options_are_built_for_every_sample(study, rigid):
    """Half the ring on the shaft: half of the sampled ring."""
    ring = {("oldham", "mass_kg"): 0.1}
    one, both = (
        sampled_pressure(study, rigid, ring, name) for name in ("none", "counterweight-half")
    )
    given = sampled_pressure(study, rigid, {("oldham", "height_m"): 0.11 + 1e-9}, "none")
    assert np.abs(one["moving_parts"][:, 1]).max() > np.abs(given["moving_parts"][:, 1]).max()
    assert not np.allclose(one["moving_parts"][:, 1], both["moving_parts"][:, 1], rtol=0.05)


# --- modes ---------------------------------------------------------------------------------------


def changed_structure(study, **values):
    return with_tables(study, structure=values).machine.structure


def test_projection_is_exact_for_modulus_and_density(study):
    path = path_of(study)
    stiff = path.with_structure(changed_structure(study, youngs_modulus_pa=4.0 * 206e9))
    np.testing.assert_allclose(stiff.natural_hz, 2.0 * path.natural_hz, rtol=1e-12)
    heavy = path.with_structure(changed_structure(study, density_kg_per_m3=4.0 * 7850.0))
    np.testing.assert_allclose(heavy.natural_hz, 0.5 * path.natural_hz, rtol=1e-12)
    np.testing.assert_allclose(heavy.modal_mass_kg, 4.0 * path.modal_mass_kg, rtol=1e-12)


def test_projection_of_a_thicker_wall_agrees_with_modes_anew(study):
    """To 2 % at 4.0 instead of 3.2 mm, where frequencies rise by up to 25 %."""
    shell, highest = study.machine.shell, study.radiation.maximum_frequency_hz
    thick = changed_structure(study, thickness_m=4e-3)
    path = path_of(study)
    projected = path.with_structure(thick)
    anew = computed_path(shell, thick, highest, 0.6)
    names = [mode.name for mode in path.modes]
    rows = [(names.index(m.name), number) for number, m in enumerate(anew.modes) if m.name in names]
    one = np.array([projected.natural_hz[row] for row, _ in rows])
    other = np.array([anew.natural_hz[row] for _, row in rows])
    assert len(rows) >= 5
    assert np.abs(one / other - 1.0).max() < 0.02
    assert np.abs(one / path.natural_hz[[row for row, _ in rows]] - 1.0).max() > 0.1


def test_projection_of_poissons_ratio_has_the_right_sign_by_mode(study):
    path = path_of(study)
    factor = path.with_structure(changed_structure(study, poisson_ratio=0.27)).natural_hz
    errors = projection_errors(study, path)
    assert set(errors) == {"structure.thickness_m", "structure.poisson_ratio"}
    assert errors["structure.poisson_ratio"] < 2e-3
    assert 1e-4 < errors["structure.thickness_m"] < 0.03
    assert np.abs(factor / path.natural_hz - 1.0).max() > 1e-3


def test_joints_of_a_sample_are_exact(study):
    stator = study.machine.structure.stator.model_copy(update={"welds": 4, "height_m": -0.03})
    changed = changed_structure(study, stator=stator)
    least = path_of(study)
    again = path_of(with_tables(study, structure={"stator": stator}))
    found = least.with_structure(changed)
    np.testing.assert_allclose(found.joint_forces, again.joint_forces, atol=1e-12)
    assert np.abs(found.joint_forces - least.joint_forces).max() > 0.1


def test_modes_reach_the_highest_frequency_with_the_thinnest_wall(study):
    """Every mode that any end of a range brings below the highest frequency is among the modes."""
    path, highest = path_of(study), study.radiation.maximum_frequency_hz
    thin = changed_structure(study, thickness_m=2.5e-3, poisson_ratio=0.27)
    anew = computed_path(study.machine.shell, thin, 0.8 / 1.1 * highest / 0.64, 1.0)
    names = {mode.name for mode in path.modes}
    audible = {m.name for m in anew.modes if 0.8 * m.frequency_hz <= highest}
    assert audible <= names


@pytest.mark.long
def test_results_say_the_error_of_the_projection(study):
    results = run_made_up(within(study, "structure.thickness_m", "mounts.pitch_m"))
    error = results["projection_error"]
    assert isinstance(error, xr.DataArray)
    assert 1e-4 < error.sel(uncertain_parameter="structure.thickness_m").item() < 0.03
    assert np.isnan(error.sel(uncertain_parameter="mounts.pitch_m").item())
    assert list(results["uncertain_parameter"].values) == [
        "mounts.pitch_m",
        "structure.thickness_m",
    ]
    values = results["sampled_value"].sel(uncertain_parameter="structure.thickness_m").values
    assert np.all((values >= 2.5e-3) & (values <= 4e-3))
    moving = results["source_level_by_sample"].sel(sound_source="moving_parts", option="none")
    assert np.ptp(moving.values[:, 0, 0]) > 1e-3


def test_a_sample_reads_back(study):
    for sample in samples_of(study).samples:
        sampled = with_sample(study.machine, study.machine, sample)
        for (table, field), value in sample.items():
            assert attrgetter(f"{table}.{field}")(sampled) == value
