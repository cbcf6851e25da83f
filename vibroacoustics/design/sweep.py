"""All designs of a grid or a sample, as one dataset."""

import json
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.study import Study
from .dataset import labelled
from .evaluation import Evaluate, Evaluation, evaluating
from .plan import LONGEST_S, Plan, check_size, planned
from .problem import Judged, Problem
from .search.problem import Searched

BATCH: Final = 20_000
"""Pieces between two reports of the advance."""
OBJECTIVES: Final = {
    "level_change_db": {"figure": "level_change_db"},
    "foot_force_n": {"figure": "foot_force_n"},
    "added_mass_kg": {"figure": "added_mass_kg"},
}
"""Of a study that names none."""


def sweep(
    study: Study,
    variables: Mapping[str, Any] | None = None,
    *,
    progress: Progress = no_progress,
    radiation: Radiation = transfer_vectors,
    longest_s: float = LONGEST_S,
) -> xr.Dataset:
    """Compute every design of a grid or a sample.

    Parameters
    ----------
    study : with a table `design`, or any with `variables`
    variables : in place of those of the table: by dotted key with its unit, a list of values, or a
        table as in a file
    progress : called with the advance
    radiation : gives the transfer vectors: the package's, measured ones or a second method's
    longest_s : a sweep that takes longer is refused before it starts

    Returns
    -------
    objectives and constraints in their units; over the variables of a grid, else over `design`.
    `feasible` is 1 where a design keeps to all constraints; `failure` is 0, or the number of the
    reason among those of its attribute `reasons`

    Raises
    ------
    ParameterError
        The table names what the study does not have, or the sweep is too large.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up
    >>> swept = va.sweep(
    ...     study,
    ...     {"options.counterweight-half.share_ratio": [0.0, 0.25, 0.5]},
    ...     radiation=va.given_radiation(vectors, frequency))
    >>> swept["foot_force_n"].dims
    ('share_ratio',)
    """
    if variables is not None:
        study = with_variables(study, variables)
    return swept(prepare(Problem(study, radiation), longest_s), progress)


class Prepared(NamedTuple):
    """A sweep that can begin.

    Attributes
    ----------
    problem : of the study
    designs : shape (design, variable), SI
    plan : what it will take
    """

    problem: Problem
    designs: Array
    plan: Plan


def prepare(problem: Problem, longest_s: float = LONGEST_S) -> Prepared:
    """Designs that the study asks for and what they will take, refused above `longest_s`.

    Raises
    ------
    ParameterError
        They take too much memory or too long.
    """
    check_size(problem, design_count(problem))
    designs = designs_of(problem)
    return Prepared(problem, designs, planned(problem, designs, longest_s))


def swept(
    prepared: Prepared, progress: Progress = no_progress, evaluate: Evaluate | None = None
) -> xr.Dataset:
    """What is seen of the designs, labelled.

    Parameters
    ----------
    prepared : from `prepare`
    progress : called with the advance
    evaluate : takes designs in SI: from a store, or by workers; here where none is given
    """
    problem, designs, plan = prepared
    judged = judged_all(problem, designs, progress, evaluate or evaluating(problem))
    results = labelled(problem, designs, judged)
    results.attrs["plan"] = plan.text
    results.attrs["routes"] = json.dumps(_routes(problem), ensure_ascii=True)
    return results


def as_searched(prepared: Prepared, results: xr.Dataset) -> Searched:
    """The designs of a sweep as those of a search that has one generation."""
    problem, designs, _ = prepared
    values = np.stack([np.ravel(results[name]) for name in problem.names], axis=1)
    number = np.ravel(results["failure"])
    reasons = ["", *json.loads(results["failure"].attrs["reasons"])]
    judged = problem.judged(values, {})
    failures = tuple(reasons[one] for one in number.tolist())
    evaluation = Evaluation(judged.objectives, judged.constraints, failures)
    return Searched(designs, evaluation, np.zeros(len(designs), dtype=np.intp))


def design_count(problem: Problem) -> int:
    """Number of designs that the study asks for."""
    if problem.design.sampling != "grid":
        return problem.design.samples
    return int(np.prod([float(axis.size) for axis in problem.space.axes()]))


def designs_of(problem: Problem) -> Array:
    """Designs that the study asks for, shape (design, variable), SI."""
    if problem.design.sampling == "grid":
        return problem.space.grid()
    return problem.space.sample(problem.design.sampling, problem.design.samples)


def judged_all(problem: Problem, designs: Array, progress: Progress, evaluate: Evaluate) -> Judged:
    """All designs judged, those of the same runs one after another.

    Parameters
    ----------
    problem : of the study
    designs : shape (design, variable), SI
    progress : called with the advance
    evaluate : takes some of them
    """
    order = np.lexsort(designs[:, ::-1].T)
    size = max(BATCH // len(problem.samples()), 1)
    values = np.full((len(designs), len(problem.wanted)), np.nan)
    failed: dict[int, str] = {}
    for first in range(0, len(designs), size):
        rows = order[first : first + size]
        part = evaluate(designs[rows])
        values[rows] = problem.in_units(part.objectives, part.constraints)
        reasons = zip(rows.tolist(), part.failures, strict=True)
        failed |= {row: reason for row, reason in reasons if reason}
        progress("designs", min(first + size, len(designs)), len(designs))
    return problem.judged(values, failed)


def with_variables(study: Study, variables: Mapping[str, Any]) -> Study:
    """The study with other variables in its table `design`, or with such a table.

    Raises
    ------
    ParameterError
        No variable is of an option, and the study has no table that names one.
    """
    tables = {key: given if isinstance(given, Mapping) else {"list": list(given)}
              for key, given in variables.items()}  # fmt: skip
    if study.design is not None:
        return study.replace({"design.variables": None}).replace({"design.variables": tables})
    option = _options_of(list(tables), study)
    return study.replace(
        {"design": {"option": option, "variables": tables, "objectives": OBJECTIVES}}
    )


def _options_of(keys: Sequence[str], study: Study) -> list[str]:
    named = [name for name in study.options if any(k.startswith(f"options.{name}.") for k in keys)]
    if named or not keys:
        return named
    if all(key.startswith("machine.") for key in keys):
        return [REFERENCE_OPTION]
    raise ParameterError(f"{keys[0]}: no such value; allowed machine.… and options.NAME.…")


def _routes(problem: Problem) -> dict[str, dict[str, str]]:
    """How each variable was computed, by option."""
    return {
        option: {
            key: ("linear: " if route.linear else "runs: ") + route.reason
            for key, route in problem.engine.routes(option).items()
        }
        for option in problem.space.options
    }
