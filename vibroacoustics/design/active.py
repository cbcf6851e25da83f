"""An active search as a dataset: all runs, the best design, what it promises, what decides."""

from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr
from scipy.stats import qmc, t

from ..base.arrays import Array
from ..base.progress import Progress
from .coding import Coding
from .evaluation import Evaluate, Evaluation
from .problem import CHANGE_OF_TOTAL, TOTALS, Problem
from .promise import Promise
from .search.active import ActiveSearch, search_active
from .search.problem import SearchProblem
from .search_dataset import searched_dataset, with_best, with_shares, with_total_change

SPREAD_DESIGNS: Final = 1024
"""Designs that fill the space, whose expected values show what decides."""
CONFIDENCE: Final = 0.95
"""Confidence of the interval of the mean of the last runs."""


def actively_searched(problem: Problem, evaluate: Evaluate, progress: Progress) -> xr.Dataset:
    """Search the designs of a problem one run after another.

    Parameters
    ----------
    problem : with one objective
    evaluate : takes designs in SI with a further column, the number of the run
    progress : called with the runs done

    Raises
    ------
    SolverError
        Fewer than two designs have a solution, or none is expected to meet the constraints.
    """
    settings = problem.design.search
    coding = Coding(problem.space.variables)
    coded = coding.problem(evaluate)

    def of_runs(codes: Array) -> Evaluation:
        return evaluate(np.column_stack([coding.designs(codes[:, :-1]), codes[:, -1]]))

    search = search_active(
        replace(coded, evaluate=of_runs),
        settings.runs,
        settings.repeats,
        settings.least_gain,
        settings.seed,
        progress=progress,
    )
    searched = replace(search.searched, designs=coding.designs(search.searched.designs[:, :-1]))
    dataset = searched_dataset(problem, searched)
    promised = promise_of_runs(dataset["wanted_value"].values[search.promised])
    rows = np.array([search.promised.start])
    spread = spread_designs(coded)
    expected = search.models.expected(coded.shares(spread), len(problem.design.constraints))
    dataset = with_total_change(dataset, problem, _largest_change(problem, dataset, search))
    dataset = with_best(dataset, rows, [promised])
    dataset = with_shares(dataset, problem, coding.designs(spread), expected)
    return dataset.assign_attrs(dataset.attrs, method=_method(problem, search))


def promise_of_runs(values: Array) -> Promise:
    """Compute mean and 95 % interval of repeated runs, by Student's t.

    Parameters
    ----------
    values : in their units, shape (run, wanted); the first run is the one without scatter
    """
    nominal, repeated = values[0], values[1:]
    count = len(repeated)
    mean = repeated.mean(axis=0)
    half = t.ppf(0.5 + 0.5 * CONFIDENCE, count - 1) * repeated.std(axis=0, ddof=1) / np.sqrt(count)
    return Promise(nominal, mean, mean - half, mean + half, count, False)


def spread_designs(coded: SearchProblem) -> Array:
    """Return coded designs that fill the space, shape (design, variable)."""
    share = qmc.Sobol(len(coded.lower), rng=0).random(SPREAD_DESIGNS)
    return coded.at_shares(share)


def _largest_change(problem: Problem, dataset: xr.Dataset, search: ActiveSearch) -> float | None:
    """Find the expected change of the total of any design that has run, largest in size, dB."""
    (wanted,) = problem.design.objectives.values()
    if wanted.figure not in TOTALS:
        return None
    runs = search.models.objective.runs
    sign = -1.0 if wanted.goal == "greatest" else 1.0
    change = sign * search.models.objective.posterior(runs.designs)[0]
    if wanted.figure != CHANGE_OF_TOTAL:
        change = change - dataset["wanted_reference"].values[0]
    return float(change[np.argmax(np.abs(change))])


def _method(problem: Problem, search: ActiveSearch) -> str:
    """Describe the search in sentences."""
    settings, process = problem.design.search, search.models.objective
    machines = len(problem.machines)
    machine = (
        f"A run is of {machines} samples of the machine, weighted by the published level"
        if problem.is_sampled
        else "A run is of the nominal machine"
    )
    return (
        f"Active search by a Gaussian process: {len(search.searched.designs)} runs of at most "
        f"{settings.runs}, seed {settings.seed}. The last {settings.repeats} repeat the best "
        "design. A run deviates from the mean of its design by "
        f"{np.sqrt(process.noise):.2g} (standard deviation). The expected gain of one run more "
        f"was {search.expected_gain:.2g}. {machine}, with tolerances and starts of its own."
    )
