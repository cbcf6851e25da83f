"""The best design of a study, or the front of several objectives."""

import xarray as xr

from ..base.progress import Progress, no_progress
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.study import Study
from .active import Coding, actively_searched
from .evaluation import Evaluate, evaluating
from .explaining import explained
from .problem import Problem
from .search.best import search_best
from .search.front import search_front
from .search.problem import Searched


def optimise(
    study: Study, *, progress: Progress = no_progress, radiation: Radiation = transfer_vectors
) -> xr.Dataset:
    """Search the design space of a study.

    With one objective the best design, by differential evolution and a polish; with several the
    front, by NSGA-II. The best few are then told by fresh pieces that the search has not seen.
    With `method = "active"` a Gaussian process chooses one run after another.

    Parameters
    ----------
    study : study with a table `design`
    progress : function called with the generations done
    radiation : function that gives the transfer vectors: the package's, measured ones or a second
        method's

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
    if settings.method == "active":
        return actively_searched(problem, evaluate, progress)
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
