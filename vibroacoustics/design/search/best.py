"""The best design by one objective: differential evolution, then a local polish.

Storn and Price (1997), Journal of Global Optimization 11, 341-359, as in scipy; constraints by the
rule of Deb (2000), Computer Methods in Applied Mechanics and Engineering 186, 311-338: who meets
them is better than who does not, of two who do not the one who exceeds them less.
"""

from typing import Any, Final

import numpy as np
from scipy.optimize import Bounds, differential_evolution, minimize

from ...base.arrays import Array
from ...base.progress import Progress, no_progress
from ..evaluation import Evaluate, Evaluation
from .problem import History, Searched, SearchProblem

_INFEASIBLE: Final = 1e9
"""Value above every objective that can be met."""
_FAILED: Final = 1e30
_SPREAD: Final = 1e-6
"""Spread of a population's objectives, in their unit, at which it has converged."""
_POLISHED: Final = 1e-9
"""Change of the objective at which the polish ends."""


def search_best(
    problem: SearchProblem,
    population: int,
    generations: int,
    seed: int,
    *,
    polish: Evaluate | None = None,
    progress: Progress = no_progress,
) -> Searched:
    """Look for the design with the least first objective.

    Parameters
    ----------
    problem : search problem with one objective or more, of which the first counts
    population : designs a generation
    generations : largest number, the first included; the search ends before, once a population
        agrees within 1e-6
    seed : seed of the random numbers; the same seed asks for the same designs
    polish : function that evaluates single designs for a search by simplex (Nelder and Mead)
        from the best one at the end; none for no such end
    progress : function called with the generations done
    """
    history = History(problem.evaluate)
    begin = _latin_hypercube(problem, population, seed)
    done = 0

    def advance(intermediate_result: Any) -> None:
        nonlocal done
        done += 1
        progress("generations", done, generations)

    differential_evolution(
        lambda designs: comparable(history(_rounded(problem, designs.T))),
        Bounds(problem.lower, problem.upper),
        init=begin,
        maxiter=max(generations - 1, 0),
        tol=0.0,
        atol=_SPREAD,
        rng=np.random.default_rng(seed),
        polish=False,
        vectorized=True,
        updating="deferred",
        integrality=problem.integer,
        callback=advance,
    )
    if polish is not None and not problem.integer.all():
        history.ask(polish)
        _polish(problem, history)
    return history.searched()


def comparable(evaluation: Evaluation) -> Array:
    """One number a design that orders them: objective, or by how much constraints are exceeded."""
    violation = evaluation.violation
    excess = np.minimum(_INFEASIBLE * (1.0 + violation), _FAILED)
    return np.where(violation > 0.0, excess, evaluation.objectives[:, 0])


def _polish(problem: SearchProblem, history: History) -> None:
    """Add what a simplex from the best design asks for, the whole numbers held."""
    searched = history.searched()
    start = searched.designs[int(np.argmin(comparable(searched.evaluation)))]
    free = np.flatnonzero(~problem.integer)
    span = (problem.upper - problem.lower)[free]

    def objective(share: Array) -> float:
        design = start.copy()
        design[free] = problem.lower[free] + share * span
        return float(comparable(history(design[None]))[0])

    begin = (start[free] - problem.lower[free]) / span
    minimize(
        objective,
        begin,
        method="Nelder-Mead",
        bounds=[(0.0, 1.0)] * len(free),
        options={
            "xatol": 1e-9,
            "fatol": _POLISHED,
            "maxfev": 400 * len(free),
            "adaptive": len(free) > 4,
            "initial_simplex": _simplex(begin),
        },
    )


def _simplex(begin: Array, size: float = 1e-2) -> Array:
    """Begin and a step along each variable, inwards at its upper bound."""
    steps = np.where(begin + size > 1.0, -size, size)
    return np.vstack([begin, begin + np.diag(steps)])


def _rounded(problem: SearchProblem, designs: Array) -> Array:
    return np.where(problem.integer, np.round(designs), designs)


def _latin_hypercube(problem: SearchProblem, population: int, seed: int) -> Array:
    from scipy.stats.qmc import LatinHypercube

    share = LatinHypercube(len(problem.lower), rng=np.random.default_rng(seed)).random(population)
    return np.asarray(problem.lower + share * (problem.upper - problem.lower))
