"""Options joined by their names: changes in order, loads and masses added, pairs refused."""

import re

import numpy as np
import pytest
from support import PIPELINES, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.best_studies import best_studies
from vibroacoustics.design.engine.engine import _closed_forms
from vibroacoustics.design.optimising import optimise
from vibroacoustics.machine.combination import Combination, joined_names
from vibroacoustics.study.loading import load_study

JOINED = "twin-oldham + spring + weight"
CHANGED = "soft + hood + wide + weight"
SOURCED = {"value": 30.0, "source": "test"}
VARIABLE = {"options.weight.mass_g": {"range": [1, 100]}}


@pytest.fixture(scope="module")
def study():
    read = load_study(PIPELINES / "copeland_thesis.toml")
    kept = {"none", "twin-oldham"}
    return read.replace({
        **{f"options.{name}": None for name in read.options if name not in kept},
        "scoring.published_table": None,
        "evidence": None,
        "operation.speed_rpm": [2900.0],
        "operation.maximum_order": 6,
        "options.spring": {"kind": "bias-spring", "preload_n": 20.0, "stiffness_n_per_mm": 1.0},
        "options.weight": {
            "kind": "counterweight", "mass_g": 50.0, "radius_mm": 20.0, "angle_deg": 30.0,
            "height_mm": 10.0,
        },
        "options.hood": {"kind": "hood", "band_hz": [500.0], "insertion_loss_db": [5.0]},
        "options.soft": {
            "kind": "redesign", "change": {"mounts": {"vertical_stiffness_n_per_mm": SOURCED}},
        },
        "options.wide": {
            "kind": "redesign", "change": {"mounts": {"lateral_stiffness_n_per_mm": SOURCED}},
        },
        f"options.{JOINED}": {"title": "All of it"},
        f"options.{CHANGED}": {},
    })  # fmt: skip


@pytest.fixture(scope="module")
def results(study):
    return va.run(study, radiation=made_up_radiation)


def test_names_are_those_of_options():
    assert joined_names(JOINED) == ("twin-oldham", "spring", "weight")
    assert joined_names("twin-oldham") == ("twin-oldham",)


def test_forces_and_masses_add_up(results):
    """Changes of the complex force of each option sum to that of the combination."""
    force = results["force_order"].sel(order=1)
    change = force - force.sel(option="none")
    parts = change.sel(option=list(joined_names(JOINED))).sum("option")
    size = float(np.abs(force).max())
    np.testing.assert_allclose(change.sel(option=JOINED), parts, atol=1e-12 * size)
    assert np.abs(parts).max() > 50.0  # N
    mass_kg = results["reported_figure"].sel(figure="added_mass_kg").squeeze("speed")
    of_parts = mass_kg.sel(option=list(joined_names(JOINED))).sum("option").item()
    assert mass_kg.sel(option=JOINED).item() == pytest.approx(of_parts, rel=1e-12)
    assert of_parts == pytest.approx(0.05 + 0.0727, abs=1e-4)


def test_changes_of_the_machine_are_all_applied(study):
    option = study.options[CHANGED]
    mounts = option.built_into(study.machine).mounts
    assert (mounts.vertical_stiffness_n_per_m, mounts.lateral_stiffness_n_per_m) == (3e4, 3e4)
    assert study.machine.mounts.vertical_stiffness_n_per_m != 3e4
    assert option.insertion_loss().at(np.array([500.0])) == [5.0]
    assert option.changes_machine
    assert option.to_be_built


def test_scores_and_title(study, results):
    assert study.titles.options[JOINED] == "All of it"
    assert np.isfinite(results["score"].sel(option=JOINED)).all()


def test_a_changed_option_changes_the_combination(study):
    heavier = study.replace({"options.weight.mass_g": 70.0}).options[JOINED]
    assert isinstance(heavier, Combination)
    assert [part.kind for part in heavier.parts] == ["twin-oldham", "bias-spring", "counterweight"]
    assert heavier.parts[2].mass_kg == 0.07


@pytest.mark.parametrize(
    ("further", "words"),
    [
        ({"options.weight + nothing": {}}, "joins nothing, which is no option; allowed twin-"),
        ({"options.weight + weight": {}}, "options.weight + weight: joins an option twice"),
        ({"options.weight + hood": {"mass_kg": 3.0}}, "options.weight + hood.mass_kg: unknown key"),
        (
            {
                "options.jacket": {"kind": "hood", "band_hz": [1e3], "insertion_loss_db": [5.0]},
                "options.hood + jacket": {},
            },
            "hood and jacket both have an insertion loss; give that of both together as one hood",
        ),
        (
            {
                "options.softer": {
                    "kind": "redesign",
                    "change": {"mounts": {"vertical_stiffness_n_per_mm": SOURCED}},
                },
                "options.soft + softer": {},
            },
            "soft and softer both change machine.mounts.vertical_stiffness_n_per_mm",
        ),
        (
            {"options.second": {"kind": "twin-oldham"}, "options.twin-oldham + second": {}},
            "twin-oldham and second both add a second Oldham ring; join one of them only",
        ),
        (
            {
                "options.sprung": {
                    "kind": "spring-mass", "stiffness_n_per_mm": 1.0, "tuned_speed_rpm": 2900.0,
                    "damping_ratio": 0.05, "height_below_ring_mm": 0.0,
                },
                "options.sprung + spring": {},
            },
            "sprung and spring both act on the Oldham ring, one from the housing",
        ),
    ],
)  # fmt: skip
def test_pairs_that_exclude_each_other_are_refused_in_one_line(study, further, words):
    with pytest.raises(ParameterError, match=re.escape(words)) as refused:
        va.run(study.replace(further), radiation=made_up_radiation)
    assert len(refused.value.args) == 1
    assert "\n" not in str(refused.value)


def test_designs_choose_between_an_option_and_its_combination(study, tmp_path):
    design = {
        "option": ["weight", JOINED],
        "variables": VARIABLE,
        "objectives": {"foot": {"figure": "foot_force_n"}},
        "search": {"population": 8, "generations": 2, "best": 1},
    }
    asked = study.replace({"design": design})
    problem = va.Problem(asked, made_up_radiation)
    assert problem.is_linear
    foot = problem.evaluate(np.array([[0.0, 0.08], [1.0, 0.08]])).values[:, 0]
    run = va.run(study.replace({"options.weight.mass_g": 80.0}), radiation=made_up_radiation)
    largest = run["foot_force_amplitude"].sel(order=1).max("foot").squeeze("speed")
    np.testing.assert_allclose(foot, largest.sel(option=["weight", JOINED]), rtol=1e-9)
    search = optimise(asked, radiation=made_up_radiation)
    best = tmp_path / "best.toml"
    (text,) = best_studies(problem, search, PIPELINES / "copeland_thesis.toml", tmp_path).values()
    assert best_name(search, asked) in text
    assert not best.exists()


def best_name(search, asked):
    """Name of the first option of the file of best designs."""
    chosen = int(search["design_value"].values[search["best_design"].values[0]][0])
    return ["best-1", "best-1-twin-oldham + best-1-spring + best-1-weight"][chosen]


def test_closed_form_of_an_option_in_a_combination(study):
    sprung = {
        "options.sprung": {
            "kind": "spring-mass", "stiffness_n_per_mm": 1.0, "tuned_speed_rpm": 2900.0,
            "damping_ratio": 0.05, "height_below_ring_mm": 0.0,
        },
        "options.sprung + weight": {},
        "design": {
            "option": "sprung + weight",
            "variables": {
                "options.sprung.stiffness_n_per_mm": {"range": [0.5, 1.5]},
                "options.weight.mass_g": {"range": [1, 100]},
            },
            "objectives": {"force": {"figure": "force_n"}},
        },
    }  # fmt: skip
    problem = va.Problem(study.replace(sprung), made_up_radiation)
    (form,) = _closed_forms(problem.space, "sprung + weight")
    assert form.variables == (0,)
    assert problem.is_linear
