"""What a search has found, as a dataset: all designs, the best few, what decides."""

import json
from collections import Counter
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.units import split_key
from ..base.vocabulary import check, stamp
from ..study.design import Constraint, Objective, Wanted
from ..uncertainty.shares import Shares
from .problem import Problem
from .promise import Promise
from .search.nondominated import nondominated
from .search.problem import Searched

_MOST_REASONS: Final = 20


def searched_dataset(problem: Problem, searched: Searched) -> xr.Dataset:
    """All designs of a search with what is wanted of them.

    Parameters
    ----------
    problem : of the study
    searched : its designs are in SI
    """
    evaluation = searched.evaluation
    met = evaluation.violation <= 0.0
    front = np.zeros(len(met), dtype=bool)
    front[met] = nondominated(evaluation.objectives[met])
    values = problem.in_units(evaluation.objectives, evaluation.constraints)
    coords = {**_design_coords(problem, len(met)), **_wanted_coords(problem)}
    factors = np.array([variable.factor for variable in problem.space.variables])
    data = {
        "design_value": searched.designs / factors,
        "wanted_value": values,
        "meets_constraints": met.astype(np.int8),
        "on_front": front.astype(np.int8),
        "search_generation": searched.generation,
        "wanted_reference": problem.without_option(),
    }
    dataset = xr.Dataset({name: stamp(name, one) for name, one in data.items()})
    reasons = Counter(reason for reason in evaluation.failures if reason).most_common(_MOST_REASONS)
    words = {v.key: v.choices for v in problem.space.variables if v.takes_words}
    return dataset.assign_coords(coords).assign_attrs(
        failures=json.dumps(reasons), choices=json.dumps(words)
    )


def with_best(dataset: xr.Dataset, rows: IndexArray, promises: list[Promise]) -> xr.Dataset:
    """The dataset with the best few designs and what they promise."""
    data = {
        "best_design": rows,
        "wanted_as_meant": np.array([one.meant for one in promises]),
        "wanted_promised": np.array([one.promised for one in promises]),
        "wanted_promised_low": np.array([one.low for one in promises]),
        "wanted_promised_high": np.array([one.high for one in promises]),
    }
    best = xr.Dataset({name: stamp(name, one) for name, one in data.items()})
    ranks = {"best_rank": np.arange(1, len(rows) + 1)}
    draws = promises[0].draws if promises else 0
    return check(dataset.merge(best.assign_coords(ranks)).assign_attrs(
        {**dataset.attrs, "promise_draws": draws}
    ))


def with_shares(dataset: xr.Dataset, shares: list[Shares]) -> xr.Dataset:
    """The dataset with what decides each objective and constraint."""
    data = {
        "design_share": np.array([one.share for one in shares]),
        "design_share_quality": np.array([one.quality for one in shares]),
    }
    return dataset.assign({name: stamp(name, one) for name, one in data.items()})


def _design_coords(problem: Problem, count: int) -> dict[str, Any]:
    variables = problem.space.variables
    limits = np.array([variable.limits for variable in variables])
    factors = np.array([variable.factor for variable in variables])[:, None]
    low, high = (limits / factors).T
    return {
        "design": np.arange(count),
        "design_variable": [variable.key for variable in variables],
        "design_unit": ("design_variable", [variable.unit for variable in variables]),
        "design_low": ("design_variable", low),
        "design_high": ("design_variable", high),
    }


def _wanted_coords(problem: Problem) -> dict[str, Any]:
    each = list(zip(problem.wanted.items(), problem.figures, strict=True))
    return {
        "wanted": problem.names,
        "wanted_unit": ("wanted", [_unit(figure.name) for _, figure in each]),
        "wanted_label": ("wanted", [_label(figure.label, one) for (_, one), figure in each]),
        "wanted_role": ("wanted", [_role(one) for (_, one), _ in each]),
        "wanted_limit": ("wanted", np.array([_limit(one) for (_, one), _ in each])),
    }


def _unit(key: str) -> str:
    unit = split_key(key)[1]
    return unit.symbol if unit else ""


def _label(label: str, wanted: Wanted) -> str:
    """What a figure is, over what: `Level of a line, 1x, worst speed, 90 % of pieces`."""
    parts = [label if wanted.reported is None else wanted.reported]
    parts += [f"{wanted.order}×"] if wanted.order is not None else []
    parts.append(_over(wanted.speeds, "speed"))
    parts.append(_over(wanted.receivers, "microphone"))
    parts += [_over(wanted.draws, "piece")]
    return ", ".join(parts)


def _over(statistic: str | float, noun: str) -> str:
    if isinstance(statistic, str):
        return f"{statistic} {noun}" if statistic == "worst" else f"mean over {noun}s"
    return f"{statistic:.0%} of {noun}s"


def _role(wanted: Wanted) -> str:
    if isinstance(wanted, Objective):
        return wanted.goal
    return "at most" if isinstance(wanted, Constraint) and wanted.at_most is not None else "at least"


def _limit(wanted: Wanted) -> float:
    if not isinstance(wanted, Constraint):
        return float("nan")
    limit = wanted.at_most if wanted.at_most is not None else wanted.at_least
    return float("nan") if limit is None else limit


def unit_shares(designs: Array, limits: Array) -> Array:
    """Designs from -1 to 1 of their ranges, shape (design, variable)."""
    low, high = limits.T
    return np.asarray(2.0 * (designs - low) / np.maximum(high - low, 1e-300) - 1.0)
