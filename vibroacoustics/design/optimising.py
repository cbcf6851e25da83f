"""The best design of a study, or the front of several objectives: searched, proven, explained."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.progress import Progress, no_progress
from .evaluation import Evaluate
from .found import searched_dataset, with_best, with_shares
from .problem import Problem
from .promise import promise
from .search.best import search_best
from .search.chosen import best_by_one, best_of_front
from .search.coded import Coding, evaluating
from .search.front import search_front
from .search.problem import Searched
from .space import OPTION, acts_on

SPREAD_DESIGNS: Final = 1024
"""Spread evenly, from which it is told what decides."""


def optimise(problem: Problem, evaluate: Evaluate, progress: Progress = no_progress) -> xr.Dataset:
    """Search the design space of a study.

    With one objective the best design, by differential evolution and a polish; with several the
    front, by NSGA-II. The best few are then told by fresh pieces that the search has not seen.

    Parameters
    ----------
    problem : of the study
    evaluate : its designs in SI: here, from a store, or by workers
    progress : called with the generations done

    Returns
    -------
    dataset of all designs

    Raises
    ------
    SolverError
        No design meets the constraints.
    """
    settings = problem.design.search
    coding = Coding(problem.space.variables)
    space = coding.problem(evaluate)
    sizes = settings.population, settings.generations, settings.seed
    if len(problem.design.objectives) == 1:
        here = coding.problem(evaluating(problem)).evaluate  # too many to keep one by one
        polish = here if _is_quick(problem) else None
        coded = search_best(space, *sizes, polish=polish, progress=progress)
    else:
        coded = search_front(space, *sizes, progress=progress)
    searched = Searched(coding.designs(coded.designs), coded.evaluation, coded.generation)
    _ = searched.best  # refuses a search without a design that is allowed
    found = searched_dataset(problem, searched)
    rows = _best_rows(problem, searched, found, settings.best)
    promises = [promise(problem, searched.designs[row], settings.fresh_draws) for row in rows]
    spread = _spread(problem, searched)
    return with_shares(with_best(found, rows, promises), problem, spread, evaluate(spread))


def _is_quick(problem: Problem) -> bool:
    """Whether all goes by linear algebra, so that single designs cost next to nothing."""
    return all(
        route.linear
        for option in problem.space.options
        for key, route in problem.engine.routes(option).items()
        if key != OPTION and acts_on(key, option)
    )


def _best_rows(problem: Problem, searched: Searched, found: xr.Dataset, count: int) -> IndexArray:
    evaluation = searched.evaluation
    if evaluation.objectives.shape[1] == 1:
        allowed = found["meets_constraints"].values == 1
        objective = np.where(allowed, evaluation.objectives[:, 0], np.inf)
        return best_by_one(searched.designs, problem.space.limits, objective, count)
    front = np.flatnonzero(found["on_front"].values)
    return np.asarray(front[best_of_front(evaluation.objectives[front], count)])


def _spread(problem: Problem, searched: Searched) -> Array:
    """Designs that fill the space; where each takes a run, those of the first generation."""
    if _is_quick(problem):
        return problem.space.sample("sobol", SPREAD_DESIGNS)
    return np.asarray(searched.designs[searched.generation == 0])
