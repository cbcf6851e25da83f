"""An active search as a dataset: all runs, the best design, what it promises, what decides."""

from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr
from scipy.stats import norm, qmc, t

from ..base.arrays import Array
from ..base.progress import Progress
from .coding import Coding
from .evaluation import Evaluate, Evaluation
from .problem import CHANGE_OF_TOTAL, CONFIDENCE, TOTALS, Problem
from .promise import Promise
from .search.active import ActiveSearch, Models, search_active
from .search.problem import SearchProblem
from .search_dataset import searched_dataset, with_best, with_shares, with_total_change

SPREAD_DESIGNS: Final = 1024
"""Designs that fill the space, whose expected values show what decides."""
MEAN_CONFIDENCE: Final = 0.95
"""Confidence of the interval of the mean of the last runs."""


def actively_searched(problem: Problem, evaluate: Evaluate, progress: Progress) -> xr.Dataset:
    """Search the designs of a problem one run after another.

    Parameters
    ----------
    problem : problem with one objective
    evaluate : function that takes designs in SI with a further column, the number of the run
    progress : function called with the runs done

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
    allowed = search.searched.designs[dataset["meets_constraints"].values == 1, :-1]
    changes = _changes(problem, dataset, search.models, coded.shares(allowed))
    dataset = with_total_change(dataset, problem, coding.designs(allowed), changes)
    dataset = with_best(dataset, rows, [promised])
    dataset = with_shares(dataset, problem, coding.designs(spread), expected)
    return dataset.assign_attrs(dataset.attrs, method=_method(problem, search))


def promise_of_runs(values: Array) -> Promise:
    """Compute mean and 95 % interval of repeated runs, by Student's t.

    Parameters
    ----------
    values : wanted values in their units, shape (run, wanted); the first run has no scatter
    """
    nominal, repeated = values[0], values[1:]
    count = len(repeated)
    mean = repeated.mean(axis=0)
    half = (
        t.ppf(0.5 + 0.5 * MEAN_CONFIDENCE, count - 1)
        * repeated.std(axis=0, ddof=1)
        / np.sqrt(count)
    )
    return Promise(nominal, mean, mean - half, mean + half, count, False)


def spread_designs(coded: SearchProblem) -> Array:
    """Return coded designs that fill the space, shape (design, variable)."""
    share = qmc.Sobol(len(coded.lower), rng=0).random(SPREAD_DESIGNS)
    return coded.at_shares(share)


def _changes(problem: Problem, dataset: xr.Dataset, models: Models, shares: Array) -> Array | None:
    """Estimate how designs change the total, dB; see `total_changes`."""
    (wanted,) = problem.design.objectives.values()
    if wanted.figure not in TOTALS or not len(shares):
        return None
    process = models.objective
    mean, deviation = process.posterior(shares)
    mean = -mean if wanted.goal == "greatest" else mean
    if wanted.figure != CHANGE_OF_TOTAL:
        mean = mean - dataset["wanted_reference"].values[0]
    scatter = norm.ppf(CONFIDENCE) * np.sqrt(process.noise + deviation**2)
    return np.stack([mean, mean + scatter], axis=-1)[None]


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
