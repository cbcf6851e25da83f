"""An active search as a dataset: designs as numbers, all runs, the best design, its promise."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import xarray as xr
from scipy.stats import norm, qmc, t

from ..base.arrays import Array
from ..base.errors import ParameterError, SolverError
from ..base.progress import Progress
from .evaluation import Evaluate
from .explaining import SPREAD_DESIGNS
from .problem import Problem
from .search.active import ActiveSearch, search_active
from .search.gaussian_process import Process
from .search.problem import SearchProblem
from .search_dataset import searched_dataset, with_best, with_shares, with_total_change
from .total_change import Promise
from .variable import Variable
from .wanted import CHANGE_OF_TOTAL, CONFIDENCE


@dataclass(frozen=True)
class Coding:
    """Designs as numbers that a search may change freely.

    Attributes
    ----------
    variables : design variables in the order of the columns
    """

    variables: Sequence[Variable]

    def problem(self, evaluate: Evaluate) -> SearchProblem:
        """Return the problem of a search; `evaluate` takes designs in SI."""
        ends = [
            variable.limits if variable.values is None else (0.0, variable.values.size - 1.0)
            for variable in self.variables
        ]
        lower, upper = np.array(ends, dtype=float).T
        integer = np.array([variable.values is not None for variable in self.variables])
        return SearchProblem(lower, upper, integer, lambda codes: evaluate(self.designs(codes)))

    def designs(self, codes: Array) -> Array:
        """Designs in SI, shape (design, variable); a further column, of numbered runs, stays."""
        columns = [
            column if variable.values is None else variable.values[column.astype(int)]
            for variable, column in zip(self.variables, codes.T, strict=False)
        ]
        return np.column_stack([*columns, codes[:, len(columns) :]])


MEAN_CONFIDENCE: Final = 0.95
"""Confidence of the interval of the mean of the last runs."""


def actively_searched(problem: Problem, evaluate: Evaluate, progress: Progress) -> xr.Dataset:
    """Search the designs of a problem one run after another.

    Parameters
    ----------
    problem : problem with one objective
    evaluate : function that takes designs in SI with a further column, the number of the run
    progress : function called with the runs done
    """
    settings = problem.design.search
    _check_statistics(problem)
    coding = Coding(problem.space.variables)
    coded = coding.problem(evaluate)
    search = search_active(
        coded,
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
    changes = _changes(problem, search.models.objective, coded.shares(allowed))
    dataset = with_total_change(dataset, problem, coding.designs(allowed), changes)
    dataset = with_best(dataset, rows, [promised])
    dataset = with_shares(dataset, problem, coding.designs(spread), expected)
    return dataset.assign_attrs(dataset.attrs, method=_method(problem, search))


def _check_statistics(problem: Problem) -> None:
    """Refuse statistics over samples where a run has one: a nominal machine.

    Raises
    ------
    ParameterError
        An objective or constraint names one.
    """
    design = problem.design
    for table, some in (("objectives", design.objectives), ("constraints", design.constraints)):
        for name, wanted in some.items():
            if wanted.samples is not None and not problem.is_sampled:
                raise ParameterError(
                    f"{problem.study.source_file}: design.{table}.{name}.samples = "
                    f"{wanted.samples}: a run of an active search of a nominal machine is one "
                    "piece; remove it"
                )


def promise_of_runs(values: Array) -> Promise:
    """Compute mean and 95 % interval of repeated runs, by Student's t.

    Parameters
    ----------
    values : wanted values in their units, shape (run, wanted); the first run has no scatter;
        failed runs are not a number

    Raises
    ------
    SolverError
        Fewer than two runs have a solution.
    """
    nominal, repeated = values[0], values[1:]
    repeated = repeated[np.isfinite(repeated).all(axis=1)]
    if len(repeated) < 2:
        raise SolverError("design: runs of the best design failed when they were repeated")
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


def _changes(problem: Problem, process: Process, shares: Array) -> Array | None:
    """Estimate how designs change the total of a nominal piece, dB; see `total_changes`.

    A run of samples of the machine is a statistic of them: its scatter is not theirs.
    """
    (wanted,) = problem.design.objectives.values()
    if wanted.figure != CHANGE_OF_TOTAL or problem.is_sampled or not len(shares):
        return None
    mean, deviation = process.posterior(shares)
    mean = -mean if wanted.goal == "greatest" else mean
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
