"""Designs and what is seen of them as a labelled dataset, and as a table."""

import json
from collections.abc import Iterator
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.csv_text import csv_bytes
from ..base.units import split_key
from ..results.provenance import attributes
from .problem import Problem
from .sweep_values import BLOCK, Listing, SweepValues
from .variable import Variable

DESIGN = "design"
DIGITS: Final = "{:.10g}"
"""Format of a number in the table of a sweep; the dataset has all digits."""


def labelled(problem: Problem, listing: Listing, values: SweepValues) -> xr.Dataset:
    """Label the values of a sweep over the variables of a grid, else over `design`.

    Parameters
    ----------
    problem : problem of the study
    listing : its designs
    values : evaluated values of the designs
    """
    variables = problem.space.variables
    names = short_names([variable.key for variable in variables])
    if problem.design.sampling == "grid":
        dims = tuple(names)
        axes = problem.space.axes()
        coords = {n: _coordinate(n, v, x) for n, v, x in zip(names, variables, axes, strict=True)}
        shape = tuple(axis.size for axis in axes)
    else:
        dims, shape = (DESIGN,), (listing.count,)
        columns = zip(names, variables, listing.designs(np.arange(listing.count)).T, strict=True)
        coords = {name: _coordinate(DESIGN, *column) for name, *column in columns}
    arrays: dict[str, Any] = {
        name: (dims, row.reshape(shape), _of_wanted(problem, name))
        for name, row in zip(problem.names, values.values, strict=True)
    }
    words = {"long_name": "whether a design keeps to all constraints", "units": "1"}
    arrays["feasible"] = (dims, values.feasible.reshape(shape), words)
    words = {"long_name": "number of the reason why a design failed, 0 where it did not",
             "units": "1", "reasons": json.dumps(values.reasons)}  # fmt: skip
    arrays["failure"] = (dims, values.failure.reshape(shape), words)
    results = xr.Dataset(arrays, coords)
    results.attrs = {**attributes(problem.study), "title": f"Designs of {problem.study.title}"}
    return results


def short_names(keys: list[str]) -> list[str]:
    """Last parts of dotted keys, with as many before them as make them distinct."""
    short = []
    for key in keys:
        parts = key.split(".")
        ends = (".".join(parts[-count:]) for count in range(1, len(parts) + 1))
        alike = (end for end in ends if sum(f".{k}".endswith(f".{end}") for k in keys) == 1)
        short.append(next(alike, key))
    return short


def _coordinate(dim: str, variable: Variable, values: Array) -> tuple[str, Array, dict[str, str]]:
    """Values in the unit of the file."""
    attrs = {"long_name": variable.key, "units": variable.unit or "1"}
    return dim, variable.in_file(values), attrs


def _of_wanted(problem: Problem, name: str) -> dict[str, Any]:
    """Unit and words of an objective or constraint."""
    wanted, figure = problem.wanted[name], problem.figures[problem.names.index(name)]
    named = wanted.reported if wanted.reported is not None else figure.name
    unit = split_key(named)[1]
    words = wanted.reported or figure.label or figure.name
    statistics = (
        f"speeds {wanted.speeds}, receivers {wanted.receivers}, samples {problem.statistic(wanted)}"
    )
    order = f", order {wanted.order}" if wanted.order is not None else ""
    return {
        "units": unit.symbol if unit and unit.symbol else "1",
        "long_name": f"{words}{order} ({statistics})",
        "figure": figure.name,
    }


def table_csv(results: xr.Dataset) -> Iterator[bytes]:
    """Give a table of all designs block by block: variables, wanted values, why a design failed."""
    failure = results["failure"]
    names = [str(name) for name in results.data_vars if name != "failure"]
    axes = [str(name) for name in results.coords]
    yield csv_bytes([*axes, *names, "failure"], [])
    reasons = np.array(list(map(_cell, ["", *json.loads(failure.attrs["reasons"])])), dtype=object)
    is_grid = all(name in failure.dims for name in axes)
    flat = {name: results[name].values.reshape(-1) for name in (*names, "failure")}
    for first in range(0, failure.size, BLOCK):
        numbers = np.arange(first, min(first + BLOCK, failure.size))
        if is_grid:
            indices = dict(zip(failure.dims, np.unravel_index(numbers, failure.shape), strict=True))
        else:
            indices = dict.fromkeys(failure.dims, numbers)
        columns = [cells(results[name].values[indices[results[name].dims[0]]]) for name in axes]
        columns += [cells(flat[name][numbers]) for name in names]
        columns.append(reasons[flat["failure"][numbers]].tolist())
        yield ("\n".join(map(",".join, zip(*columns, strict=True))) + "\n").encode()


def cells(values: Array) -> list[str]:
    """Return the cells of a column of the table, shape (design,); words are made once each."""
    if values.dtype.kind != "U":
        return list(map(DIGITS.format, values.tolist()))
    words = {word: _cell(word) for word in np.unique(values).tolist()}
    return [words[word] for word in values.tolist()]


def _cell(value: str | float) -> str:
    """A cell of a table as text."""
    return csv_bytes([], [[value, ""]]).decode()[1:-2]
