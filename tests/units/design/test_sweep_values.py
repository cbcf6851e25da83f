"""Designs of sweeps by number, and the few of very many that a report shows."""

from dataclasses import replace

import numpy as np
import pytest
from design_studies import WEIGHT, design_table, study_with
from support import made_up_radiation

from vibroacoustics.base.arrays import Array
from vibroacoustics.design import sweep_values
from vibroacoustics.design.evaluation import Evaluation
from vibroacoustics.design.explaining import best_by_one
from vibroacoustics.design.plan import Plan
from vibroacoustics.design.problem import Problem
from vibroacoustics.design.search.front import nondominated
from vibroacoustics.design.statistics import Splitting
from vibroacoustics.design.sweep import Prepared, as_dataset, listing_of, swept
from vibroacoustics.design.sweep_values import listed_grid, listed_sample

TWO = """
[design.objectives.second]
figure = "foot_force_n"
"""
COUNT = 900


@pytest.mark.parametrize("slow", [[], [1], [2, 0]])
def test_grid_gives_all_combinations_and_slow_variables_first(slow: list[int]) -> None:
    axes = [np.array([3.0, 1.0]), np.array([5.0, 7.0, 6.0]), np.array([0.0, 9.0])]
    listed = listed_grid(axes, slow)
    every = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    np.testing.assert_array_equal(listed.designs(np.arange(12)), every)
    order = listed.ordered(np.arange(12))
    assert sorted(order.tolist()) == list(range(12))
    changes = (np.diff(listed.designs(order)[:, slow], axis=0) != 0.0).any(axis=1).sum()
    assert changes == np.prod([axes[n].size for n in slow], dtype=int) - 1


def test_sample_is_sorted_by_its_slow_variables() -> None:
    designs = np.array([[1.0, 5.0], [2.0, 4.0], [1.0, 4.0]])
    assert listed_sample(designs, [1, 0]).ordered(np.arange(3)).tolist() == [2, 1, 0]
    assert listed_sample(designs, []).ordered(np.arange(3)).tolist() == [0, 1, 2]


def problem_of(more: str = "") -> Problem:
    """Designs of a grid of 30 x 30."""
    variables = {
        "options.weight.mass_g": "range = [1, 100], points = 30",
        "options.weight.angle_deg": "range = [0, 180], points = 30",
    }
    return Problem(
        study_with(WEIGHT + design_table('"weight"', variables) + more), made_up_radiation
    )


@pytest.mark.parametrize("more", ["", TWO])
def test_report_of_many_designs_has_the_best_of_all(
    more: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The front and the best few are those of all designs, though few are shown."""
    monkeypatch.setattr(sweep_values, "MOST_SHOWN", 40)
    monkeypatch.setattr(sweep_values, "_FEW", 3)
    monkeypatch.setattr(sweep_values, "BLOCK", 64)
    problem = problem_of(more)
    prepared = Prepared(problem, listing_of(problem), Plan(COUNT, COUNT, 1, 0.0, 0.0, 0.0, {}))
    values = swept(prepared)
    searched = values.searched(5)
    assert len(searched.designs) < 100
    designs, evaluation = all_of(values, problem)
    if more:
        expected = designs[nondominated(evaluation.objectives)]
        shown = searched.designs[nondominated(searched.evaluation.objectives)]
    else:
        every = best_by_one(designs, problem.space.limits, evaluation.objectives[:, 0], 5)
        few = searched.evaluation.objectives[:, 0]
        expected = designs[every]
        shown = searched.designs[best_by_one(searched.designs, problem.space.limits, few, 5)]
    np.testing.assert_array_equal(shown, expected)
    attributes = values.attributes("Grid")
    assert (attributes["evaluated"], attributes["allowed"]) == (COUNT, COUNT)
    assert as_dataset(prepared, values)["quiet"].shape == (30, 30)


def all_of(values: sweep_values.SweepValues, problem: Problem) -> tuple[Array, Evaluation]:
    """All designs with their evaluation, in the order of their numbers."""
    numbers = np.arange(COUNT)
    return listing_of(problem).designs(numbers), values.evaluation(numbers)


def test_pieces_have_one_path_and_one_new_load() -> None:
    splitting = Splitting((1,), (0,), 2, 9)
    assert splitting.slow == [1, 0]
    designs = np.array([[1.0, 3.0], [2.0, 3.0], [1.0, 3.0], [1.0, 4.0], [2.0, 4.0], [5.0, 4.0]])
    assert [len(piece) for piece in splitting.pieces(designs)] == [1, 2, 2, 1]
    assert np.concatenate(list(splitting.pieces(designs))).tolist() == designs.tolist()
    small = replace(splitting, most=1)
    assert [len(piece) for piece in small.pieces(designs)] == [1] * 6
    numbered = np.column_stack([designs[[0, 0, 0]], [-1.0, 7.0, 8.0]])
    assert [len(piece) for piece in splitting.pieces(numbered)] == [1, 1, 1]


def test_values_that_scatter_alone_may_take_runs() -> None:
    """They belong to no design, but each run of a design takes them."""
    wall = '[design.tolerances]\n"machine.structure.thickness_mm" = { ratio = 0.1 }\n'
    problem = problem_of(wall)
    assert problem.run_columns == [2]
    assert problem.splitting.slow == []
    first = listing_of(problem).designs(np.arange(3))
    assert [len(piece) for piece in problem.splitting.pieces(first)] == [3]
