"""Result of a search as a dataset: all designs, the best few, what decides."""

import json
from collections import Counter
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.plain_bytes import canonical_json
from ..base.units import split_key
from ..base.vocabulary import check, stamp
from ..results.provenance import software_attributes
from ..study.design import Constraint, Objective, Wanted
from ..uncertainty.share_variables import labelled_shares
from ..uncertainty.shares import shares_of
from .evaluation import Evaluation
from .figure import DesignFigure
from .keys import acts_on
from .problem import Problem
from .search.front import nondominated
from .search.problem import Searched
from .space import OPTION
from .total_change import Promise, lowering_words, no_change_words
from .wanted import MEDIAN, TOTALS

_MOST_REASONS: Final = 20


def searched_dataset(problem: Problem, searched: Searched) -> xr.Dataset:
    """All designs of a search, in SI, with what is wanted of them."""
    evaluation = searched.evaluation
    met = evaluation.violation <= 0.0
    front = np.zeros(len(met), dtype=bool)
    front[met] = nondominated(evaluation.objectives[met])
    values = problem.in_units(evaluation.objectives, evaluation.constraints)
    coords = {**_design_coords(problem, len(met)), **_wanted_coords(problem)}
    data = {
        "design_value": _as_in_files(problem, searched.designs),
        "wanted_value": values,
        "meets_constraints": met.astype(np.int8),
        "on_front": front.astype(np.int8),
        "search_generation": searched.generation,
        "wanted_reference": problem.without_option(),
    }
    dataset = xr.Dataset({name: stamp(name, array) for name, array in data.items()})
    reasons = Counter(reason for reason in evaluation.failures if reason).most_common(_MOST_REASONS)
    counts = {"evaluated": len(met), "allowed": int(met.sum())}
    words = {v.key: v.choices for v in problem.space.variables if v.takes_words}
    return dataset.assign_coords(coords).assign_attrs(
        software_attributes("optimise"),
        parameters=canonical_json(problem.study.parameters()),
        failures=json.dumps(reasons),
        **counts,
        choices=json.dumps(words),
        method=_method(problem, len(met)),
    )


def _method(problem: Problem, count: int) -> str:
    """Return the method of the search, in a sentence."""
    search = problem.design.search
    single = len(problem.design.objectives) == 1
    name = "Differential evolution with a simplex at the end" if single else "NSGA-II (pymoo)"
    return (
        f"{name}: {search.population} designs a generation, at most {search.generations} "
        f"generations, seed {search.seed}, {count} designs in all. "
        f"{machine_words(problem)}"
    )


def machine_words(problem: Problem) -> str:
    """Return for which machine designs were computed, in sentences."""
    samples, machines = problem.samples(), problem.machines
    if not problem.is_sampled:
        return (
            f"{len(samples)} samples of the tolerances, the same for all designs. Values are those "
            "of the nominal machine: the study has no uncertainty, or too few samples agree with "
            "the published level."
        )
    return (
        f"Values are medians over {len(machines)} samples of the machine, weighted by the "
        f"published level, each with {machines[0].machine.weight.size} pairs of a discrepancy and "
        f"an unmodelled level; {len(samples)} pieces of the tolerances. They are the same for all "
        "designs and for the machine without an option."
    )


def with_total_change(
    dataset: xr.Dataset, problem: Problem, designs: Array, changes: Array | None
) -> xr.Dataset:
    """Return the dataset with what is said of changes of the total.

    The attribute `no_change` is empty where a design changes it measurably, `lowering` where no
    objective is a total.

    Parameters
    ----------
    dataset : dataset of the search
    problem : problem that was searched
    designs : designs that meet the constraints, shape (design, variable), SI
    changes : changes of each total by these designs, dB, see `total_changes`
    """
    totals = all(wanted.figure in TOTALS for wanted in problem.design.objectives.values())
    return dataset.assign_attrs(
        {
            **dataset.attrs,
            "no_change": no_change_words(problem, changes),
            "lowering": lowering_words(problem, designs, changes),
            "only_totals": int(totals),
        }
    )


def with_best(dataset: xr.Dataset, rows: IndexArray, promises: list[Promise]) -> xr.Dataset:
    """The dataset with the best few designs and what they promise."""
    data = {
        "best_design": rows,
        "wanted_as_meant": np.array([promise.meant for promise in promises]),
        "wanted_promised": np.array([promise.promised for promise in promises]),
        "wanted_promised_low": np.array([promise.low for promise in promises]),
        "wanted_promised_high": np.array([promise.high for promise in promises]),
    }
    best = xr.Dataset({name: stamp(name, array) for name, array in data.items()})
    ranks = {"best_rank": np.arange(1, len(rows) + 1)}
    samples = promises[0].samples if promises else 0
    return check(
        dataset.merge(best.assign_coords(ranks)).assign_attrs(
            {
                **dataset.attrs,
                "promise_samples": samples,
                "is_sampled": int(bool(promises) and promises[0].is_sampled),
            }
        )
    )


def with_shares(
    dataset: xr.Dataset, problem: Problem, designs: Array, evaluation: Evaluation
) -> xr.Dataset:
    """The dataset with designs that fill the space, and what decides each wanted value over them.

    Parameters
    ----------
    dataset : dataset of the search
    problem : problem that was searched
    designs : shape (design, variable), SI
    evaluation : evaluation of these designs
    """
    values = problem.in_units(evaluation.objectives, evaluation.constraints)
    shares = [shares_of(designs, column, np.ones(len(designs))) for column in values.T]
    data = {
        "spread_value": _as_in_files(problem, designs),
        "spread_wanted": values,
        **labelled_shares("design_share", shares),
    }
    spread = xr.Dataset({name: stamp(name, np.array(array)) for name, array in data.items()})
    numbers = {"spread_design": np.arange(len(designs))}
    return dataset.merge(spread.assign_coords(numbers)).assign_attrs(dataset.attrs)


def _as_in_files(problem: Problem, designs: Array) -> Array:
    """Values in the units of files; those of other options than a design's are not numbers."""
    space = problem.space
    values = designs / np.array([variable.factor for variable in space.variables])
    chosen = np.array([space.option_of(design) for design in designs])
    for option in space.options:
        idle = [not acts_on(name, option) and name != OPTION for name in space.names]
        values[np.ix_(chosen == option, idle)] = np.nan
    return np.asarray(values)


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
    each = list(zip(problem.wanted.values(), problem.figures, strict=True))
    return {
        "wanted": problem.names,
        "wanted_unit": ("wanted", [_unit(figure.name) for _, figure in each]),
        "wanted_label": ("wanted", [_label(problem, figure, wanted) for wanted, figure in each]),
        "wanted_role": ("wanted", [_role(wanted) for wanted, _ in each]),
        "wanted_limit": ("wanted", np.array([_limit(wanted) for wanted, _ in each])),
    }


def _unit(key: str) -> str:
    unit = split_key(key)[1]
    return unit.symbol if unit else ""


def _label(problem: Problem, figure: DesignFigure, wanted: Wanted) -> str:
    """Return figure and statistics: `Level of an order, 1×, worst speed, 90 % of pieces`."""
    parts = [figure.label if wanted.reported is None else wanted.reported]
    parts += [f"{wanted.order}×"] if wanted.order is not None else []
    parts += [_over(wanted.speeds, "speed")] if figure.of_speeds else []
    parts += [_over(wanted.receivers, "microphone")] if figure.is_level else []
    noun = "sample" if problem.is_sampled else "piece"
    return ", ".join([*parts, _over(problem.statistic(wanted), noun)])


def _over(statistic: str | float, noun: str) -> str:
    if isinstance(statistic, str):
        return f"{statistic} {noun}" if statistic == "worst" else f"mean over {noun}s"
    if statistic == MEDIAN:
        return f"median of {noun}s"
    return f"{100.0 * statistic:g} % of {noun}s"


def _role(wanted: Wanted) -> str:
    if isinstance(wanted, Objective):
        return wanted.goal
    return (
        "at most" if isinstance(wanted, Constraint) and wanted.at_most is not None else "at least"
    )


def _limit(wanted: Wanted) -> float:
    if not isinstance(wanted, Constraint):
        return float("nan")
    limit = wanted.at_most if wanted.at_most is not None else wanted.at_least
    return float("nan") if limit is None else limit
