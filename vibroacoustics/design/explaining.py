"""The best few of many designs, what they promise, and what decides."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from .evaluation import Evaluate, Evaluation
from .problem import Problem
from .search.front import Mask
from .search.problem import Searched
from .search_dataset import searched_dataset, with_best, with_shares, with_total_change
from .total_change import promise, total_changes

SPREAD_DESIGNS: Final = 1024
"""Designs spread evenly, which show what decides."""


def explained(
    problem: Problem,
    searched: Searched,
    evaluate: Evaluate,
    attributes: Mapping[str, Any] | None = None,
) -> xr.Dataset:
    """Label designs with the best few of them, estimated by fresh pieces, and what decides; in SI.

    Parameters
    ----------
    problem : problem that was searched
    searched : designs with their evaluation
    evaluate : function that takes further designs
    attributes : attributes of the dataset, in place of those of a search
    """
    _ = searched.best
    settings = problem.design.search
    search = searched_dataset(problem, searched).assign_attrs(attributes or {})
    rows = _best_rows(problem, searched, search, settings.best)
    promises = [promise(problem, searched.designs[row], settings.fresh_samples) for row in rows]
    spread, evaluation = _spread(problem, searched, evaluate)
    allowed = np.concatenate([searched.designs[rows], spread[evaluation.violation <= 0.0]])
    _, first = np.unique(allowed, axis=0, return_index=True)
    allowed = allowed[np.sort(first)]
    changes = total_changes(problem, allowed)
    search = with_total_change(search, problem, allowed, changes)
    return with_shares(with_best(search, rows, promises), problem, spread, evaluation)


def _best_rows(problem: Problem, searched: Searched, search: xr.Dataset, count: int) -> IndexArray:
    evaluation = searched.evaluation
    if evaluation.objectives.shape[1] == 1:
        allowed = search["meets_constraints"].values == 1
        objective = np.where(allowed, evaluation.objectives[:, 0], np.inf)
        return best_by_one(searched.designs, problem.space.limits, objective, count)
    front = np.flatnonzero(search["on_front"].values)
    return np.asarray(front[best_of_front(evaluation.objectives[front], count)])


def _spread(problem: Problem, searched: Searched, evaluate: Evaluate) -> tuple[Array, Evaluation]:
    """Designs that fill the space; where each takes a run, those of the first generation."""
    if problem.is_linear:
        designs = problem.space.sample("sobol", SPREAD_DESIGNS)
        return designs, evaluate(designs)
    rows = np.flatnonzero(searched.generation == 0)
    return searched.designs[rows], searched.evaluation.some(rows)


_APART: Final = 0.05
"""Share of the range of at least one variable by which designs of one objective differ."""


def best_by_one(designs: Array, limits: Array, objective: Array, count: int) -> IndexArray:
    """Rows of the best designs by one objective, each apart from those before it.

    Parameters
    ----------
    designs : shape (design, variable)
    limits : limits of the variables, shape (variable, 2)
    objective : objective of each design, less is better, shape (design,); infinite for designs
        that do not count
    count : largest number of designs
    """
    chosen: list[int] = []
    remaining = np.isfinite(objective)
    while remaining.any() and len(chosen) < count:
        row = int(np.argmin(np.where(remaining, objective, np.inf)))
        chosen.append(row)
        remaining &= apart(designs, designs[row], limits)
    return np.array(chosen, dtype=np.intp)


def apart(designs: Array, design: Array, limits: Array) -> Mask:
    """Return whether designs differ from one by a share of the range of a variable, (design,).

    Parameters
    ----------
    designs : shape (design, variable)
    design : shape (variable,) or (1, variable)
    limits : limits of the variables, shape (variable, 2)
    """
    span = np.maximum(np.ptp(limits, axis=1), np.finfo(float).tiny)
    return np.asarray((np.abs(designs - design) > _APART * span).any(axis=1))


def best_of_front(objectives: Array, count: int) -> IndexArray:
    """Rows of a front: its middle, then one after another that is farthest from those chosen.

    The middle is nearest to the least of each objective, each as a share of the front's range.

    Parameters
    ----------
    objectives : objectives of the front, shape (design, objective)
    count : largest number of designs
    """
    low = objectives.min(axis=0)
    span = np.maximum(np.ptp(objectives, axis=0), np.finfo(float).tiny)
    share = (objectives - low) / span
    chosen = [int(np.argmin((share**2).sum(axis=1)))]
    distance = np.linalg.norm(share - share[chosen[0]], axis=1)
    while len(chosen) < count and distance.max() > _APART:
        chosen.append(int(np.argmax(distance)))
        distance = np.minimum(distance, np.linalg.norm(share - share[chosen[-1]], axis=1))
    return np.array(chosen, dtype=np.intp)
