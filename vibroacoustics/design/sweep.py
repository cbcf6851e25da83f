"""All designs of a grid or a sample, as one dataset."""

import json
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.study import Study
from .dataset import labelled
from .evaluation import Stream, one_by_one
from .plan import LONGEST_S, Plan, check_size, planned
from .problem import Problem
from .sweep_values import Listing, SweepValues, listed_grid, listed_sample

OBJECTIVES: Final = {
    "level_change_db": {"figure": "level_change_db"},
    "foot_force_n": {"figure": "foot_force_n"},
    "added_mass_kg": {"figure": "added_mass_kg"},
}
"""Objectives of a study that names none."""


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
    study : study with a table `design`, or any with `variables`
    variables : variables in place of those of the table: by dotted key with its unit, a list of
        values, or a table as in a file
    progress : function called with the advance
    radiation : function that gives the transfer vectors: the package's, measured ones or a second
        method's
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
    prepared = prepare(Problem(study, radiation), longest_s)
    return as_dataset(prepared, swept(prepared, progress))


class Prepared(NamedTuple):
    """A sweep that can begin.

    Attributes
    ----------
    problem : problem of the study
    listing : its designs
    plan : expected time, memory and disk space
    """

    problem: Problem
    listing: Listing
    plan: Plan


def prepare(problem: Problem, longest_s: float = LONGEST_S, workers: int = 0) -> Prepared:
    """List the designs that the study asks for and plan their evaluation.

    Parameters
    ----------
    problem : problem of the study
    longest_s : longest time that the sweep may take
    workers : further processes that evaluate; with none this one does
    """
    check_size(problem, design_count(problem))
    listing = listing_of(problem)
    return Prepared(problem, listing, planned(problem, listing, longest_s, workers))


def swept(
    prepared: Prepared, progress: Progress = no_progress, stream: Stream | None = None
) -> SweepValues:
    """Evaluate all designs.

    Parameters
    ----------
    prepared : prepared sweep from `prepare`
    progress : function called with the advance
    stream : function that evaluates pieces: from a store, or by workers; default: this process
    """
    problem, listing, _ = prepared
    values, waiting = SweepValues(problem, listing), deque[IndexArray]()
    evaluated = (stream or one_by_one(problem))(_pieces(problem, listing, waiting))
    done = 0
    progress("designs", done, listing.count)
    for evaluation in evaluated:
        numbers = waiting.popleft()
        values.take(numbers, evaluation)
        done += len(numbers)
        progress("designs", done, listing.count)
    return values


def _pieces(problem: Problem, listing: Listing, waiting: deque[IndexArray]) -> Iterator[Array]:
    """Give all designs piece by piece; `waiting` gets the numbers of each."""
    for positions in listing.blocks():
        numbers = listing.ordered(positions)
        first = 0
        for piece in problem.splitting.pieces(listing.designs(numbers)):
            waiting.append(numbers[first : first + len(piece)])
            first += len(piece)
            yield piece


def as_dataset(prepared: Prepared, values: SweepValues) -> xr.Dataset:
    """Label the values of all designs."""
    problem, listing, plan = prepared
    results = labelled(problem, listing, values)
    results.attrs["plan"] = plan.text
    results.attrs["routes"] = json.dumps(_routes(problem), ensure_ascii=True)
    return results


def design_count(problem: Problem) -> int:
    """Number of designs that the study asks for."""
    if problem.design.sampling != "grid":
        return problem.design.samples
    return int(np.prod([float(axis.size) for axis in problem.space.axes()]))


def sampling_words(problem: Problem) -> str:
    """Return how designs are chosen, in words."""
    design = problem.design
    return "Grid" if design.sampling == "grid" else f"{design.sampling.capitalize()} sample"


def listing_of(problem: Problem) -> Listing:
    """List the designs that the study asks for; what takes runs varies slowest."""
    design, slow = problem.design, problem.splitting.slow
    if design.sampling == "grid":
        return listed_grid(problem.space.axes(), slow)
    return listed_sample(problem.space.sample(design.sampling, design.samples), slow)


def with_variables(study: Study, variables: Mapping[str, Any]) -> Study:
    """The study with other variables in its table `design`, or with such a table."""
    tables = {key: entry if isinstance(entry, Mapping) else {"list": list(entry)}
              for key, entry in variables.items()}  # fmt: skip
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
    """Return the route of each variable, by option."""
    return {
        option: {
            key: ("linear: " if route.linear else "runs: ") + route.reason
            for key, route in problem.engine.routes(option).items()
        }
        for option in problem.space.options
    }
