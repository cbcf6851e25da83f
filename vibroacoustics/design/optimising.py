"""The best design of a study, or the front of several objectives."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.progress import Progress, no_progress
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.study import Study
from .evaluation import Evaluate, evaluating
from .explaining import explained
from .problem import Problem
from .search.best import search_best
from .search.front import search_front
from .search.problem import Searched, SearchProblem
from .variable import Variable


def optimise(
    study: Study, *, progress: Progress = no_progress, radiation: Radiation = transfer_vectors
) -> xr.Dataset:
    """Search the design space of a study.

    With one objective the best design, by differential evolution and a polish; with several the
    front, by NSGA-II. The best few are then told by fresh pieces that the search has not seen.

    Parameters
    ----------
    study : with a table `design`
    progress : called with the generations done
    radiation : gives the transfer vectors: the package's, measured ones or a second method's

    Returns
    -------
    all designs that were evaluated, the best few, what they promise, and what decides

    Raises
    ------
    ParameterError
        The table names what the study does not have, or pymoo is missing.
    SolverError
        No design meets the constraints.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml").replace({"design": {
    ...     "option": ["counterweight-half"],
    ...     "variables": {"options.counterweight-half.share_ratio": {"range": [0.0, 1.0]}},
    ...     "objectives": {"foot": {"figure": "foot_force_n", "order": 1}},
    ...     "search": {"population": 8, "generations": 10},
    ... }})
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up
    >>> search = va.optimise(study, radiation=va.given_radiation(vectors, frequency))
    >>> search["wanted_as_meant"].dims
    ('best_rank', 'wanted')
    """
    problem = Problem(study, radiation)
    return searched_designs(problem, evaluating(problem), progress)


def searched_designs(
    problem: Problem, evaluate: Evaluate, progress: Progress = no_progress
) -> xr.Dataset:
    """`optimise` with an evaluation of one's own, which takes designs in SI."""
    settings = problem.design.search
    coding = Coding(problem.space.variables)
    space = coding.problem(evaluate)
    sizes = settings.population, settings.generations, settings.seed
    if len(problem.design.objectives) == 1:
        here = coding.problem(evaluating(problem)).evaluate  # too many to keep one by one
        polish = here if problem.is_linear else None
        coded = search_best(space, *sizes, polish=polish, progress=progress)
    else:
        coded = search_front(space, *sizes, progress=progress)
    searched = Searched(coding.designs(coded.designs), coded.evaluation, coded.generation)
    return explained(problem, searched, evaluate)


@dataclass(frozen=True)
class Coding:
    """Designs as numbers that a search may change freely.

    Attributes
    ----------
    variables : of the designs, in the order of the columns
    """

    variables: Sequence[Variable]

    def problem(self, evaluate: Evaluate) -> SearchProblem:
        """What a search needs to know; `evaluate` takes designs in SI."""
        ends = [
            variable.limits if variable.values is None else (0.0, variable.values.size - 1.0)
            for variable in self.variables
        ]
        lower, upper = np.array(ends, dtype=float).T
        integer = np.array([variable.values is not None for variable in self.variables])
        return SearchProblem(lower, upper, integer, lambda codes: evaluate(self.designs(codes)))

    def designs(self, codes: Array) -> Array:
        """Designs in SI, shape (design, variable)."""
        columns = [
            column if variable.values is None else variable.values[column.astype(int)]
            for variable, column in zip(self.variables, codes.T, strict=True)
        ]
        return np.stack(columns, axis=1)
