"""Active search of noisy functions with known optimum, under constraints, and interrupted."""

from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from noisy_functions import FUNCTIONS, NOISE_DB, Figures, regrets, search_problem

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import SolverError, StorageError
from vibroacoustics.base.progress import no_progress
from vibroacoustics.design.active import _changes, promise_of_runs
from vibroacoustics.design.evaluation import Evaluate, Evaluation
from vibroacoustics.design.search.active import ActiveSearch, _Search, search_active
from vibroacoustics.design.search.gaussian_process import Process, Runs
from vibroacoustics.design.search.problem import SearchProblem
from vibroacoustics.design.store.pieces import opened_store, stored
from vibroacoustics.results.piece_files import PieceFiles


@pytest.mark.slow
@pytest.mark.parametrize("name", FUNCTIONS)
def test_regret_of_noisy_functions(name: str) -> None:
    """At most 60 runs of 0.24 dB: three seeds within 0.1 dB, random search worse on average."""
    each = [regrets(name, seed) for seed in range(3)]
    assert max(one.runs for one in each) <= 60
    assert max(one.true_db for one in each) <= 0.1
    # The mean of eight repeats is within 3.3 standard deviations of 0.24/√8 dB of the true one.
    assert all(abs(one.repeats_db - one.true_db) < 3.3 * NOISE_DB / np.sqrt(8) for one in each)
    assert np.mean([one.true_db for one in each]) < np.mean([one.random_db for one in each])


@pytest.mark.long
@pytest.mark.parametrize("name", FUNCTIONS)
def test_regret_on_eight_of_ten_seeds(name: str) -> None:
    """Of the mean over all starts. The mean of eight is uncertain by 0.24/√8 = 0.085 dB: at the
    optimum 12 % of them exceed 0.1 dB, so that it is shown and not asserted.
    """
    each = [regrets(name, seed) for seed in range(10)]
    for seed, one in enumerate(each):
        print(f"{name} {seed}: {one.runs} runs, regret {one.true_db:.3f} dB, by eight repeats "
              f"{one.repeats_db:.3f} dB, random search {one.random_db:.3f} dB")  # fmt: skip
    assert sum(one.true_db <= 0.1 for one in each) >= 8
    assert np.mean([one.true_db for one in each]) < np.mean([one.random_db for one in each])


def bowl(designs: Array) -> Evaluation:
    """Least of (x - 0.3)² + (n - 2)² with noise of 0.01 by the run; x above 0.9 fails.

    Constraint: x of 0.5 at least, so that 0.04 at (0.5, 2) is best.
    """
    x, n, run = designs.T
    noise = [0.01 * np.random.default_rng((5, int(one) + 1)).standard_normal() for one in run]
    failed = x > 0.9
    objective = np.where(failed, np.nan, (x - 0.3) ** 2 + (n - 2.0) ** 2 + noise)
    reasons = tuple("x is too large" if one else "" for one in failed)
    return Evaluation(objective[:, None], (0.5 - x)[:, None], reasons)


def bowl_search(evaluate: Evaluate, seed: int = 0, **settings: float) -> ActiveSearch:
    ends = np.array([0.0, 0.0]), np.array([1.0, 4.0])
    problem = SearchProblem(*ends, np.array([False, True]), evaluate)
    return search_active(
        problem, int(settings.get("runs", 40)), 4, settings.get("least_gain", 1e-4), seed
    )


def test_constraint_integer_and_failures() -> None:
    """Within five standard deviations of the noise, and the constraint is met."""
    search = bowl_search(bowl)
    x, n = search.best
    assert n == 2.0
    assert 0.5 <= x < 0.5 + 5.0 * 0.01 / 0.4  # the slope there is 0.4
    assert "x is too large" in search.searched.evaluation.failures
    late = search.searched.designs[20:, 0]
    assert np.mean(late > 0.9) < np.mean(search.searched.designs[:12, 0] > 0.9)


def test_last_runs_repeat_the_best_design() -> None:
    search = bowl_search(bowl)
    last = search.searched.designs[search.promised]
    assert (last[:, :2] == search.best).all()
    assert last[0, 2] == -1
    assert search.promised.stop == len(search.searched.designs) <= 40
    numbers = search.searched.designs[:, 2]
    assert len(np.unique(numbers)) == len(numbers)


def test_search_ends_when_no_gain_is_expected() -> None:
    short = bowl_search(bowl, least_gain=1e6)
    assert short.expected_gain < 1e6
    assert len(short.searched.designs) < len(bowl_search(bowl, least_gain=0.0).searched.designs)


def test_every_run_is_counted() -> None:
    """All 40 runs with no least gain, and the advance ends at its total."""
    steps: list[tuple[str, int, int]] = []
    problem = search_problem("branin", 0)
    search = search_active(problem, 40, 4, 0.0, 0, progress=lambda *step: steps.append(step))
    done = [number for _, number, _ in steps]
    assert len(search.searched.designs) == done[-1] == steps[-1][2] == 40
    assert done == sorted(done)
    assert {task for task, _, _ in steps} == {"runs"}


def test_seed_decides_the_runs() -> None:
    first, again, other = bowl_search(bowl), bowl_search(bowl), bowl_search(bowl, 1)
    assert first.searched.designs.tobytes() == again.searched.designs.tobytes()
    assert first.searched.designs.tobytes() != other.searched.designs.tobytes()


def kept(evaluate: Evaluate, store: PieceFiles) -> Evaluate:
    """Evaluate by a store, each call as one piece."""
    each = stored(partial(map, evaluate), store)
    return lambda designs: next(iter(each([designs])))


@pytest.mark.parametrize("interrupted_after", [1, 2, 7])
def test_interrupted_search_goes_on_with_the_same_bits(
    tmp_path: Path, interrupted_after: int
) -> None:
    """Only what the store lacks is run again."""
    undisturbed = bowl_search(bowl).searched
    with pytest.raises(StorageError, match="ended"), opened_store(tmp_path, {}) as store:
        bowl_search(kept(Figures(bowl, most=interrupted_after), store))
    rest = Figures(bowl)
    with opened_store(tmp_path, {}) as store:
        searched = bowl_search(kept(rest, store)).searched
    assert searched.designs.tobytes() == undisturbed.designs.tobytes()
    assert searched.evaluation.objectives.tobytes() == undisturbed.evaluation.objectives.tobytes()
    assert rest.batches == searched.generation.max() + 1 - interrupted_after


def test_longer_search_goes_on_where_a_shorter_ended(tmp_path: Path) -> None:
    with opened_store(tmp_path, {}) as store:
        short = bowl_search(kept(bowl, store), runs=30, least_gain=0.0).searched
    further = Figures(bowl)
    with opened_store(tmp_path, {}) as store:
        longer = bowl_search(kept(further, store), runs=36, least_gain=0.0).searched
    same = len(short.designs) - 5  # without those of the best design at the end
    assert longer.designs[:same].tobytes() == short.designs[:same].tobytes()
    assert further.batches == 6 + 1


def test_no_design_is_expected_to_meet_the_constraints() -> None:
    def evaluate(designs: Array) -> Evaluation:
        return Evaluation(designs[:, :1], 2.0 + designs[:, :1], ("",) * len(designs))

    with pytest.raises(SolverError, match="no design is expected to meet the constraints"):
        bowl_search(evaluate)


def test_all_runs_fail() -> None:
    def evaluate(designs: Array) -> Evaluation:
        nothing = np.full((len(designs), 1), np.nan)
        return Evaluation(nothing, np.empty((len(designs), 0)), ("no gas",) * len(designs))

    with pytest.raises(SolverError, match="16 of 16 runs failed: no gas"):
        bowl_search(evaluate)


def test_failed_repeats_count_for_nothing() -> None:
    values = np.array([[1.0], [2.0], [np.nan], [4.0]])
    promise = promise_of_runs(values)
    assert (promise.promised, promise.samples) == ([3.0], 2)
    with pytest.raises(SolverError, match="failed when they were repeated"):
        promise_of_runs(values[:3])


@pytest.mark.parametrize(("goal", "sign"), [("least", 1.0), ("greatest", -1.0)])
def test_changes_of_the_total_are_those_that_nine_of_ten_pieces_stay_below(
    goal: str, sign: float
) -> None:
    """At designs with many runs: the mean of these, and 1.28 standard deviations of one run."""
    shares = np.array([[0.1], [0.9]])
    runs = Runs(shares, sign * np.array([-5.0, 2.0]), np.full(2, 10_000), 100.0)
    process = Process(runs, 10.0, np.array([0.1]), 0.25)
    wanted = SimpleNamespace(figure="total_change_db", goal=goal)
    problem = SimpleNamespace(design=SimpleNamespace(objectives={"a": wanted}), is_sampled=False)
    changes = _changes(problem, process, shares)
    expected = np.array([-5.0, 2.0])[:, None] + [0.0, 1.2816 * 0.5]
    np.testing.assert_allclose(changes[0], expected, atol=0.01)  # 0.5 dB over a hundred
    problem.is_sampled = True
    assert _changes(problem, process, shares) is None


def test_where_nothing_is_allowed_the_least_excess_is_run_again() -> None:
    """The constraint falls along the only variable and is never met."""

    def evaluate(designs: Array) -> Evaluation:
        return Evaluation(designs[:, :1], 2.0 - designs[:, :1], ("",) * len(designs))

    problem = SearchProblem(np.zeros(1), np.ones(1), np.array([False]), evaluate)
    searching = _Search(problem, 0, no_progress, 30)
    searching.run(np.linspace(0.0, 1.0, 8)[:, None])
    assert searching.best_run(searching.models()).tolist() == [1.0]
