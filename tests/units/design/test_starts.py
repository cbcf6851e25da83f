"""Starts of key impacts as a tolerance of designs: each run of an active search has its own."""

import json

import numpy as np
import pytest
from design_studies import design_table, study_with
from sources_study import SOURCES_STUDY, made_up_modes

from vibroacoustics import report
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.evaluation import evaluating
from vibroacoustics.design.optimising import optimise
from vibroacoustics.design.problem import Problem
from vibroacoustics.sources.oldham_keys.rattle import start_rates
from vibroacoustics.study.study import Study

STROKE = {"options.twin-oldham.stroke_ratio": "range = [0.6, 1.4]"}
FIXED = {"options.twin-oldham.stroke_ratio": "range = [0.999999, 1.000001]"}
STARTS = '[design.tolerances]\n"sources.keys.start" = { range = [1, 1000000] }\n'
ACTIVE = '[design.search]\nmethod = "active"\nruns = 30\nrepeats = 4\n'
DRY = {
    "machine.keys.oil_layer_um": 0.5, "machine.keys.clearance_um": 40.0,
    "receivers.left_1m": None, "operation.stopping": False,
}  # fmt: skip
RING = np.array([1.0])


def radiation(study, *_):
    return made_up_modes(study), False


def nominal(variables=STROKE, more=STARTS + ACTIVE) -> Study:
    """The nominal machine with a twin ring, whose keys are nearly dry."""
    study = study_with(design_table('"twin-oldham"', variables) + more, SOURCES_STUDY)
    with pytest.warns(UserWarning, match="oil_layer_um"):
        return study.replace(DRY).model_copy(update={"ranges": ()})


def test_start_is_from_rest_or_with_random_rates() -> None:
    """Each rate moves a key at 0.05 m/s at most; 200 starts come near that."""
    assert not start_rates(0, 0.055).any()
    np.testing.assert_array_equal(start_rates(7, 0.055), start_rates(7, 0.055))
    radii = np.array([1.0, 1.0, 0.055, 0.055])
    speeds = np.abs([radii * start_rates(number, 0.055) for number in range(1, 201)])
    assert (speeds <= 0.05).all()
    assert (speeds.max(axis=0) > 0.045).all()  # 0.9^200 of missing it: 1e-9


@pytest.fixture(scope="module")
def problem() -> Problem:
    return Problem(nominal(), radiation)


def test_run_has_the_start_of_its_number(problem: Problem) -> None:
    """A run equals the study with that start; other runs scatter about it."""
    evaluate = evaluating(problem)
    values = evaluate(np.column_stack([np.ones(6), np.arange(6)])).objectives[:, 0]
    assert np.ptp(values) > 1e-3
    samples = problem.samples_of_run(2)
    start = problem.pieces.made(RING[None], samples)[0, 0, -1]
    assert start == round(start)
    key = problem.study.sources["keys"].model_copy(update={"start": int(start)})
    study = problem.study.model_copy(update={"sources": {**problem.study.sources, "keys": key}})
    plain = study.design.model_copy(update={"tolerances": {}})
    alone = Problem(study.model_copy(update={"design": plain}), radiation)
    assert alone.evaluate(RING[None]).objectives[0, 0] == values[2]


def test_starts_of_runs_are_independent_and_of_the_seed(problem: Problem) -> None:
    starts = [problem.samples_of_run(run).item() for run in range(40)]
    assert len(set(starts)) == 40
    assert starts[3] == problem.samples_of_run(3).item()
    meant = problem.pieces.made(RING[None], problem.samples_of_run(-1))[0, 0, -1]
    assert meant == problem.study.sources["keys"].start == 0
    search = problem.design.search.model_copy(update={"seed": 9})
    design = problem.design.model_copy(update={"search": search})
    other = Problem(problem.study.model_copy(update={"design": design}), radiation)
    assert other.samples_of_run(3).item() != starts[3]


def test_designs_of_an_active_search_take_no_probes(problem: Problem) -> None:
    assert not any(route.linear for route in problem.engine.routes("twin-oldham").values())
    assert not problem.is_linear


def test_mean_of_the_last_runs_is_promised() -> None:
    """With Student's 95 % interval; the best of a stroke that is given is that stroke."""
    study = nominal(FIXED)
    search = optimise(study, radiation=radiation)
    count = search.sizes["design"]
    assert count <= 30
    values = search["wanted_value"].values[count - 4 :, 0]
    promised = [search[f"wanted_promised{end}"].item() for end in ("_low", "", "_high")]
    half = 3.182 * values.std(ddof=1) / 2.0  # three degrees of freedom
    np.testing.assert_allclose(promised, values.mean() + half * np.array([-1, 0, 1]), rtol=1e-4)
    assert search["wanted_as_meant"].item() == search["wanted_value"].values[count - 5, 0]
    assert search["best_design"].item() == count - 5
    text = report.analysis_of_designs(search).text()
    assert f"{count} runs of at most 30" in text
    assert "without an option" in text
    assert json.loads(search.attrs["failures"]) == []


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ('[design.tolerances]\n"sources.key.start" = { range = [1, 9] }\n', "no such number"),
        ('[design.tolerances]\n"sources.keys.start" = { range = [-1, 9] }\n', "keys.start = -1"),
        ('[design.tolerances]\n"room.start" = { range = [1, 9] }\n', "allowed machine.…, sources."),
    ],
)
def test_tolerance_of_what_is_no_start_is_refused(more: str, message: str) -> None:
    study = study_with(design_table('"twin-oldham"', STROKE) + more, SOURCES_STUDY)
    with pytest.raises(ParameterError, match=message):
        Problem(study, radiation)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ("runs = 29", "design.search.runs = 29: out of range; allowed from 30 to 1000"),
        ("runs = 40\nrepeats = 16", "repeats = 16: must be 2 to 15 with runs = 40"),
        ("least_gain = -1.0", "design.search.least_gain = -1"),
        ('[design.objectives.feet]\nfigure = "foot_force_n"', "must have one objective"),
    ],
)
def test_settings_that_cannot_be_are_refused(more: str, message: str) -> None:
    table = design_table('"twin-oldham"', STROKE) + '[design.search]\nmethod = "active"\n'
    with pytest.raises(ParameterError, match=message):
        study_with(table + more, SOURCES_STUDY)
