"""The front of several objectives: NSGA-II of pymoo, generation by generation.

Deb, Pratap, Agarwal, Meyarivan (2002), IEEE Transactions on Evolutionary Computation 6, 182-197.
"""

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...base.progress import Progress, no_progress
from ..evaluation import Evaluation
from .problem import History, Searched, SearchProblem

_FAILED: Final = 1e30


def search_front(
    problem: SearchProblem,
    population: int,
    generations: int,
    seed: int,
    *,
    progress: Progress = no_progress,
) -> Searched:
    """Look for designs of which none is better in every objective than another.

    Parameters
    ----------
    problem : search problem with two objectives or more
    population : designs a generation
    generations : number of generations, the first included
    seed : seed of the random numbers; the same seed asks for the same designs
    progress : function called with the generations done
    """
    history = History(problem.evaluate)
    algorithm, outline = _algorithm(problem, population, generations, seed)
    done = 0
    while algorithm.has_next():
        infills = algorithm.ask()
        designs = np.array(infills.get("X"), dtype=float)
        designs = np.where(problem.integer, np.round(designs), designs)
        infills.set("X", designs)
        evaluation = history(designs)
        _advance(algorithm, infills, evaluation, outline)
        done += 1
        progress("generations", done, generations)
    return history.searched()


def _algorithm(
    problem: SearchProblem, population: int, generations: int, seed: int
) -> tuple[Any, Any]:
    """NSGA-II, set up, and the outline of the problem."""
    core = _pymoo()
    from pymoo.algorithms.moo.nsga2 import NSGA2

    outline = core.Problem(n_var=len(problem.integer), xl=problem.lower, xu=problem.upper)
    algorithm = NSGA2(pop_size=population)
    algorithm.setup(outline, termination=("n_gen", generations), seed=seed, verbose=False)
    return algorithm, outline


def _advance(algorithm: Any, infills: Any, evaluation: Evaluation, outline: Any) -> None:
    """Hand the evaluation of a generation to the algorithm."""
    from pymoo.core.evaluator import Evaluator
    from pymoo.problems.static import StaticProblem

    failed = ~np.all(np.isfinite(evaluation.objectives), axis=1)
    objectives = np.where(failed[:, None], _FAILED, evaluation.objectives)
    constraints = np.column_stack([evaluation.constraints, failed])
    outline.n_obj, outline.n_ieq_constr = objectives.shape[1], constraints.shape[1]
    Evaluator().eval(StaticProblem(outline, F=objectives, G=constraints), infills)
    algorithm.tell(infills=infills)


def _pymoo() -> Any:
    try:
        from pymoo.core import problem
    except ImportError:
        raise ParameterError(
            "design: fronts of several objectives need pymoo: pip install 'vibroacoustics[design]'"
        ) from None
    return problem


Mask = npt.NDArray[np.bool_]
_BLOCK: Final = 256


def nondominated(objectives: Array) -> Mask:
    """Rows that no other row is at most equal to everywhere and below somewhere.

    Equal rows stay together. In the order of the first objective, then the second and so on, a row
    can only be dominated by one before it.

    Parameters
    ----------
    objectives : each the better the less, shape (design, objective); rows with a value that is not
        a number are dominated
    """
    sound = np.flatnonzero(np.isfinite(objectives).all(axis=1))
    order = sound[np.lexsort(objectives[sound].T[::-1])]
    front = np.empty((0, objectives.shape[1]))
    mask = np.zeros(len(objectives), dtype=bool)
    for start in range(0, len(order), _BLOCK):
        rows = order[start : start + _BLOCK]
        rows = rows[~_dominated(objectives[rows], front)]
        rows = rows[~_dominated(objectives[rows], objectives[rows])]
        mask[rows] = True
        front = np.concatenate([front, objectives[rows]])
    return mask


def _dominated(rows: Array, by: Array) -> Mask:
    """Whether each row is dominated by one of the others, shape (row,)."""
    difference = rows[:, None] - by[None]
    at_most, below = np.all(difference >= 0.0, axis=2), np.any(difference > 0.0, axis=2)
    return np.asarray(np.any(at_most & below, axis=1))
