"""Sweeps: tables of designs, statistics, tolerances, and what is refused."""

import json

import numpy as np
import psutil
import pytest
from design_studies import WEIGHT, design_table, study_with
from support import TINY, assert_refused, command_here, made_up_radiation

from vibroacoustics import sweep
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.dataset import short_names, table_csv
from vibroacoustics.design.plan import Plan, planned
from vibroacoustics.design.problem import Problem
from vibroacoustics.design.space import Space
from vibroacoustics.design.statistics import statistic_of
from vibroacoustics.design.sweep import listing_of
from vibroacoustics.pipeline import run
from vibroacoustics.study.loading import load_study

VARIABLES = {
    "options.weight.mass_g": "list = [10, 50]",
    "options.weight.angle_deg": "range = [0, 180], points = 3",
}
MORE = """
[design.objectives.feet]
figure = "foot_force_n"

[design.constraints.light]
figure = "added_mass_kg"
at_most = 0.02
"""
SCATTER = """
[design.tolerances]
options.weight.mass_g = { ratio = 0.1 }
options.weight.radius_mm = { plus_minus = 2.0 }
"""


@pytest.fixture(scope="module")
def study():
    return study_with(WEIGHT + design_table('"weight"', VARIABLES) + MORE)


def test_grid_is_over_its_variables(study):
    swept = sweep(study, radiation=made_up_radiation)
    assert dict(swept.sizes) == {"mass_g": 2, "angle_deg": 3}
    assert swept["quiet"].attrs["units"] == "dB(A)"
    assert swept["angle_deg"].attrs == {"long_name": "options.weight.angle_deg", "units": "°"}
    at = swept.sel(mass_g=50, angle_deg=90.0)
    plain = run(
        study.replace({"options.weight.mass_g": 50, "options.weight.angle_deg": 90.0}),
        radiation=made_up_radiation,
    ).sel(option="weight")
    level = plain["level_modelled"].sel(weighting="A").values.max()
    assert float(at["quiet"]) == pytest.approx(level, abs=1e-9)
    foot = plain["foot_force_amplitude"].sel(order=1).max()
    assert float(at["feet"]) == pytest.approx(float(foot), rel=1e-10)
    np.testing.assert_array_equal(swept["feasible"], [[1, 1, 1], [0, 0, 0]])


def test_table_has_a_line_for_every_design(study):
    lines = b"".join(table_csv(sweep(study, radiation=made_up_radiation))).decode().splitlines()
    assert lines[0] == "mass_g,angle_deg,quiet,feet,light,feasible,failure"
    assert len(lines) == 7
    assert lines[6].startswith("50,180,")


def test_variables_in_python_for_a_study_without_a_table():
    swept = sweep(
        load_study(TINY),
        {"options.counterweight-half.share_ratio": [0.0, 0.5]},
        radiation=made_up_radiation,
    )
    assert swept["foot_force_n"].dims == ("share_ratio",)
    assert float(swept["level_change_db"][0]) == pytest.approx(0.0, abs=1e-9)


def test_designs_that_cannot_be_built_fail_with_their_reason():
    sprung = """
[options.sprung]
kind = "spring-mass"
stiffness_n_per_mm = 3.0
tuned_speed_rpm = 3500.0
damping_ratio = 0.01
height_below_ring_mm = 25.0
"""
    variables = {"options.sprung.stiffness_n_per_mm": "list = [1.0, 3.0, 50.0]"}
    swept = sweep(
        study_with(sprung + design_table('"sprung"', variables)), radiation=made_up_radiation
    )
    assert list(swept["failure"].values) == [0, 0, 1]
    assert np.isnan(swept["quiet"].values).tolist() == [False, False, True]
    assert swept["feasible"].values.tolist() == [1, 1, 0]
    (reason,) = json.loads(swept["failure"].attrs["reasons"])
    assert "no mass balances the ring" in reason


def test_quantile_of_pieces_is_kept_by_that_share_of_them(study):
    scattering = study_with(WEIGHT + design_table('"weight"', VARIABLES) + MORE + SCATTER)
    problem = Problem(scattering, made_up_radiation)
    design, samples = listing_of(problem).designs(np.arange(1)), problem.samples(50)
    pieces = problem.by_sample(design, samples)[0]
    value = problem.evaluate(design, samples).values[0]
    assert ((pieces <= value).mean(axis=0) == 0.9).all()
    mass = 0.01 * (1.0 + 0.1 * (2.0 * samples[:, 0] - 1.0))
    np.testing.assert_allclose(pieces[:, 2], mass, rtol=1e-12)
    heavier = scattering.replace(
        {"options.weight.mass_g": 1e3 * mass[0], "options.weight.angle_deg": 0.0,
         "options.weight.radius_mm": 20.0 + 2.0 * (2.0 * samples[0, 1] - 1.0)}
    )  # fmt: skip
    level = run(heavier, radiation=made_up_radiation)["level_modelled"]
    expected = float(level.sel(option="weight", weighting="A", receiver="front_1m")[0])
    assert pieces[0, 0] == pytest.approx(expected, abs=1e-9)


def test_criteria_and_residual_unbalance():
    unbalance = """
[sources.unbalance]
kind = "residual-unbalance"
"""
    scatter = """
[design.objectives.moment]
figure = "residual_moment_nm"

[design.tolerances]
machine.balance_quality.used_ratio = { range = [0, 1] }
machine.balance_quality.lower_angle_deg = { range = [0, 360] }
"""
    text = unbalance + WEIGHT + design_table('"weight"', VARIABLES)
    read = study_with(text + scatter)
    study = read.model_copy(update={"ranges": ()})  # nominal
    object.__setattr__(study, "_read", read._read)
    problem = Problem(study, made_up_radiation)
    samples = problem.samples(2)
    pieces = problem.by_sample(listing_of(problem).designs(np.array([1])), samples)[0]
    bare = run(problem.study.model_copy(update={"ranges": ()}), radiation=made_up_radiation)
    without = float(bare.sel(option="none")["moment_amplitude"].sel(order=1).max())
    assert problem.without_option()[1] == pytest.approx(without, rel=1e-9)
    for row, (used, angle) in enumerate(samples):
        study = problem.study.replace(
            {"options.weight.mass_g": 10, "options.weight.angle_deg": 90.0,
             "machine.balance_quality.used_ratio": used,
             "machine.balance_quality.lower_angle_deg": 360.0 * angle}
        )  # fmt: skip
        plain = run(study.model_copy(update={"ranges": ()}), radiation=made_up_radiation)
        plain = plain.sel(option="weight")
        level = float(plain["level_modelled"].sel(weighting="A").max())
        assert pieces[row, 0] == pytest.approx(level, abs=1e-9)
        moment = float(plain["moment_amplitude"].sel(order=1).max())
        assert pieces[row, 1] == pytest.approx(moment, rel=1e-9)


@pytest.mark.parametrize(
    ("statistic", "more", "expected"),
    [("worst", False, 4.0), ("worst", True, 1.0), ("mean", False, 2.5), (0.5, False, 2.0),
     (0.5, True, 3.0), (0.75, False, 3.0), (0.76, False, 4.0), (1.0, True, 1.0)],
)  # fmt: skip
def test_statistics(statistic, more, expected):
    values = np.array([[3.0, 1.0, 4.0, 2.0]])
    assert statistic_of(values, 1, statistic, more).tolist() == [expected]


def test_names_are_as_short_as_they_tell_apart():
    keys = ["options.a.mass_g", "options.b.mass_g", "machine.mounts.pitch_mm"]
    assert short_names(keys) == ["a.mass_g", "b.mass_g", "pitch_mm"]


def test_quick_studies_are_those_of_files():
    variables = {
        "options.weight.mass_g": "range = [1, 100]",
        "machine.mounts.pitch_mm": "range = [150, 250]",
        "machine.housing.mass_kg": "range = [30, 40]",
    }
    space = Space.of(study_with(WEIGHT + design_table('"weight"', variables)))
    for design in space.sample("latin-hypercube", 2):
        quick, slow = space.quick_study_of(design), space.study_of(design)
        assert (quick.machine, quick.options) == (slow.machine, slow.options)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ('"options.weight.mas_g" = { list = [1, 2] }', ["mas_g", "did you mean mass_g"]),
        ('"options.other.mass_g" = { list = [1, 2] }', ["no such value", "options.weight"]),
        ('"options.weight.mass_g" = { range = [0, 2] }', ["mass_g = 0.0 g", "above 0 to 100000 g"]),
        ('"options.weight.mass_g" = { range = [2, 1] }', ["range = [2, 1]", "must rise"]),
        ('"options.weight.mass_g" = { range = [1, 2], step = 9 }', ["step = 9 g", "allowed 2"]),
        ('"options.weight.mass_g" = { range = [1, 2] }', ["points, step or list"]),
        ('"options.weight.mass_g" = { list = [1, "a"] }', ["mixes words and numbers"]),
        ('"machine.mounts.pitsch_mm" = { list = [1, 2] }', ["machine has no such value"]),
    ],
)
def test_variables_are_refused_in_one_line(tmp_path, table, words):
    text = design_table('"weight"', {}).replace(
        "[design.variables]", f"[design.variables]\n{table}"
    )
    assert_refused(_sweep(tmp_path, text), "study.toml", "design.variables", *words)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ('[design.objectives.loud]\nfigure = "level_db"', ["figure = level_db", "did you mean"]),
        ('[design.objectives.own]\nfigure = "reported"', ["objectives.own.reported", "missing"]),
        ('[design.constraints.a]\nfigure = "force_n"', ["constraints.a", "at_most or at_least"]),
        ('[design.constraints.a]\nfigure = "force_n"\nspeeds = 1.5\nat_most = 1.0',
         ["constraints.a.speeds", "1.5"]),
        ('[design.tolerances]\noptions.weight.mass_g = { ratio = 0.1, plus_minus = 1.0 }',
         ["tolerances.options.weight.mass_g", "one of ratio"]),
        ('[design.tolerances]\noptions.weight.angle_deg = { plus_minus = 300.0 }',
         ["tolerances.options.weight.angle_deg", "480", "-360 to 360"]),
        ('[design.tolerances]\noptions.weight.angel_deg = { plus_minus = 3.0 }',
         ["tolerances.options.weight.angel_deg", "no such number"]),
    ],
)  # fmt: skip
def test_other_tables_are_refused_in_one_line(tmp_path, table, words):
    text = design_table('"weight"', VARIABLES)
    assert_refused(_sweep(tmp_path, f"{text}\n{table}"), "study.toml", "design.", *words)


def test_measured_sound_is_refused(tmp_path):
    table = """
[measured.sound]
frequency_responses = ["hammer.uff"]
points.down = { node = 1, direction = "+z", foot = "left_front" }
microphones.front_1m = { node = 101 }
"""
    text = design_table('"weight"', VARIABLES) + table
    assert_refused(_sweep(tmp_path, text), "study.toml: design: measured.sound")


def test_too_many_designs_are_refused_before_they_start(tmp_path):
    table = design_table('"weight"', VARIABLES).replace(
        "[design.variables]", 'sampling = "sobol"\nsamples = 90_000_000\n[design.variables]'
    )
    assert_refused(_sweep(tmp_path, table), "90000000 designs", "allowed 2 GiB")
    assert list(tmp_path.iterdir()) == [tmp_path / "study.toml"]


def test_memory_of_all_workers_counts(study, monkeypatch):
    """Memory for two processes is available: this one with one worker, not with two."""
    problem = Problem(study, made_up_radiation)
    plan = planned(problem, listing_of(problem))
    further = plan.memory_bytes - psutil.Process().memory_info().rss
    one_worker = further + psutil.Process().memory_info().rss

    class Memory:
        available = 1.5 * one_worker

    monkeypatch.setattr(psutil, "virtual_memory", Memory)
    planned(problem, listing_of(problem), workers=1)
    with pytest.raises(ParameterError, match=r"evaluation of 6 designs takes .* or workers"):
        planned(problem, listing_of(problem), workers=2)


def test_plan_tells_designs_time_and_size():
    plan = Plan(10, 640, 8, 7300.0, 2e8, 3e6, {"options.a.length_mm": "no"})
    assert plan.text == (
        "10 designs, 640 pieces at 8 speeds: about 2.0 h after the start, 200 MB of memory, "
        "3 MB on disk; by runs: options.a.length_mm"
    )


def _sweep(folder, text):
    file = folder / "study.toml"
    base = TINY.read_text().replace("../../data", str(TINY.parents[2] / "data"))
    file.write_text(f"{base}\n{WEIGHT}\n{text}")
    return command_here("sweep", file, "--out", folder / "out")
