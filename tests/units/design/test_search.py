"""Searches against problems whose answers are known."""

import numpy as np
import pytest
from pymoo.indicators.hv import HV

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import SolverError
from vibroacoustics.design.evaluation import Evaluate, Evaluation
from vibroacoustics.design.search.best import search_best
from vibroacoustics.design.search.front import nondominated, search_front
from vibroacoustics.design.search.problem import SearchProblem


def evaluating(objectives: Array, constraints: Array | None = None) -> Evaluation:
    """Of designs that none fails."""
    none = np.empty((len(objectives), 0)) if constraints is None else constraints
    return Evaluation(objectives, none, ("",) * len(objectives))


def problem(
    lower: list[float], upper: list[float], evaluate: Evaluate, whole: list[bool] | None = None
) -> SearchProblem:
    """Of plain lists."""
    mask = np.zeros(len(lower), dtype=bool) if whole is None else np.array(whole)
    return SearchProblem(np.array(lower), np.array(upper), mask, evaluate)


def rosenbrock(designs: Array) -> Evaluation:
    x, y = designs.T
    return evaluating(((1.0 - x) ** 2 + 100.0 * (y - x**2) ** 2)[:, None])


def test_integers_have_equal_parts_of_the_shares() -> None:
    """Words and whole numbers at the ends are found as often as others."""
    none = Evaluation(np.empty((0, 1)), np.empty((0, 0)), ())
    lower, upper, integer = np.array([2.0, -1.0]), np.array([5.0, 1.0]), np.array([True, False])
    problem = SearchProblem(lower, upper, integer, lambda _: none)
    shares = np.column_stack([(np.arange(4000) + 0.5) / 4000.0] * 2)
    designs = problem.at_shares(shares)
    assert [np.sum(designs[:, 0] == whole) for whole in (2.0, 3.0, 4.0, 5.0)] == [1000] * 4
    np.testing.assert_array_equal(problem.at_shares(problem.shares(designs)), designs)
    assert problem.at_shares(np.ones((1, 2))).tolist() == [[5.0, 1.0]]


def test_best_of_rosenbrock_and_its_seed() -> None:
    """The polish ends within 1e-4 of (1, 1); the same seed asks for the same designs."""
    first = search_best(
        problem([-2.0, -2.0], [2.0, 2.0], rosenbrock), 40, 60, seed=1, polish=rosenbrock
    )
    again = search_best(
        problem([-2.0, -2.0], [2.0, 2.0], rosenbrock), 40, 60, seed=1, polish=rosenbrock
    )
    np.testing.assert_allclose(first.designs[first.best], 1.0, atol=1e-4)
    np.testing.assert_array_equal(first.designs, again.designs)


def test_best_under_a_constraint_with_a_whole_number() -> None:
    """Least x² + (n - 2.4)² with x + n ≥ 3.5: n = 3, x = 0.5 (n = 2: 2.25 + 0.16 is worse)."""

    def evaluate(designs: Array) -> Evaluation:
        x, n = designs.T
        assert np.array_equal(n, np.round(n))
        return evaluating((x**2 + (n - 2.4) ** 2)[:, None], (3.5 - x - n)[:, None])

    found = search_best(
        problem([-5.0, 0.0], [5.0, 10.0], evaluate, [False, True]), 30, 60, seed=3, polish=evaluate
    )
    np.testing.assert_allclose(found.designs[found.best], [0.5, 3.0], atol=1e-6)


def test_best_goes_round_designs_that_fail() -> None:
    """Failed ones are worse than all that exceed a constraint, and keep their reason."""

    def evaluate(designs: Array) -> Evaluation:
        failed = designs[:, 0] < 0.0
        objective = np.where(failed, np.nan, designs[:, 0])[:, None]
        reasons = tuple("no solution" if one else "" for one in failed)
        return Evaluation(objective, np.zeros((len(designs), 0)), reasons)

    searched = search_best(problem([-1.0], [1.0], evaluate), 20, 30, seed=0, polish=evaluate)
    assert 0.0 <= searched.designs[searched.best, 0] < 1e-6
    assert "no solution" in searched.evaluation.failures


def test_no_design_meets_the_constraints() -> None:
    def evaluate(designs: Array) -> Evaluation:
        return evaluating(designs, 2.0 - designs)

    searched = search_best(problem([0.0], [1.0], evaluate), 10, 5, seed=0)
    with pytest.raises(SolverError, match=r"none of \d+ designs meets the constraints"):
        _ = searched.best


@pytest.mark.long
def test_front_of_zdt1_is_covered() -> None:
    """ZDT1 of five variables: hypervolume up to (1.1, 1.1) at least 99 % of the exact 0.8767."""

    def evaluate(designs: Array) -> Evaluation:
        first = designs[:, 0]
        g = 1.0 + 9.0 * designs[:, 1:].mean(axis=1)
        return evaluating(np.column_stack([first, g * (1.0 - np.sqrt(first / g))]))

    searched = search_front(problem([0.0] * 5, [1.0] * 5, evaluate), 100, 120, seed=1)
    objectives = searched.evaluation.objectives
    front = objectives[nondominated(objectives)]
    exact = 1.1**2 - 1.0 / 3.0 - 0.0  # area above f2 = 1 - sqrt(f1), and the strips beside it
    assert HV(np.array([1.1, 1.1]))(front) >= 0.99 * exact


def test_front_under_constraints_is_covered() -> None:
    """Binh and Korn (1997): hypervolume of 99 % of that of a fine grid of designs."""

    def evaluate(designs: Array) -> Evaluation:
        x, y = designs.T
        objectives = np.column_stack([4 * x**2 + 4 * y**2, (x - 5) ** 2 + (y - 5) ** 2])
        disc = (x - 5) ** 2 + y**2 - 25.0
        outside = 7.7 - (x - 8) ** 2 - (y + 3) ** 2
        return evaluating(objectives, np.column_stack([disc, outside]))

    grid = np.stack(np.meshgrid(np.linspace(0, 5, 300), np.linspace(0, 3, 300)), -1).reshape(-1, 2)
    exact = evaluate(grid)
    reference = np.array([140.0, 50.0])
    best = HV(reference)(exact.objectives[exact.violation <= 0.0])
    searched = search_front(problem([0.0, 0.0], [5.0, 3.0], evaluate), 80, 40, seed=2)
    met = searched.evaluation.violation <= 0.0
    assert HV(reference)(searched.evaluation.objectives[met]) >= 0.99 * best


def test_front_with_a_whole_number() -> None:
    """Of (x², (x - n)²) with n of 1 to 3 the front has n = 1 alone, x from 0 to 1."""

    def evaluate(designs: Array) -> Evaluation:
        x, n = designs.T
        assert np.array_equal(n, np.round(n))
        return evaluating(np.column_stack([x**2, (x - n) ** 2]))

    searched = search_front(
        problem([-4.0, 1.0], [4.0, 3.0], evaluate, [False, True]), 40, 30, seed=0
    )
    front = searched.designs[nondominated(searched.evaluation.objectives)]
    near_zero = front[:, 0] < 1e-3  # there n does not decide the first objective
    assert (front[~near_zero, 1] == 1.0).all()
    assert front[:, 0].max() == pytest.approx(1.0, abs=0.05)


def test_nondominated_rows_against_all_pairs() -> None:
    """Random rows with ties and failed ones, against the definition."""
    rows = np.random.default_rng(5).integers(0, 12, (700, 3)).astype(float)
    rows[::50] = np.nan
    expected = [
        bool(np.isfinite(row).all())
        and not any((other <= row).all() and (other < row).any() for other in rows)
        for row in rows
    ]
    np.testing.assert_array_equal(nondominated(rows), expected)


def test_a_front_of_failed_designs_is_that_of_the_finite_ones() -> None:
    """Nine of ten designs fail, in three ways; the front has the best of the others alone."""

    def evaluate(designs: Array) -> Evaluation:
        x = designs[:, 0]
        objectives = np.column_stack([x**2, (x - 2.0) ** 2])
        failed = np.floor(10.0 * (x + 5.0)) % 10 != 0
        objectives[failed] = np.array([np.nan, np.inf, -np.inf])[np.arange(failed.sum()) % 3, None]
        return evaluating(objectives)

    searched = search_front(problem([-5.0], [5.0], evaluate), 40, 10, seed=3)
    objectives = searched.evaluation.objectives
    finite = np.isfinite(objectives).all(axis=1)
    front = nondominated(objectives)
    assert front.sum() > 1
    assert finite[front].all()
    assert not finite.all()
    np.testing.assert_array_equal(front[finite], nondominated(objectives[finite]))
    assert finite[searched.best]
    np.testing.assert_array_equal(np.isfinite(searched.evaluation.violation), finite)
