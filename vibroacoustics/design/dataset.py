"""Designs and what is seen of them as a labelled dataset, and as a table."""

import json
from typing import Any

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.csv_text import csv_bytes
from ..base.units import split_key
from ..results.provenance import attributes
from .problem import Judged, Problem
from .variable import Variable

DESIGN = "design"


def labelled(problem: Problem, designs: Array, judged: Judged) -> xr.Dataset:
    """Over the variables of a grid, else over `design`.

    Parameters
    ----------
    problem : of the study
    designs : shape (design, variable), SI
    judged : of them
    """
    variables = problem.space.variables
    names = short_names([variable.key for variable in variables])
    if problem.design.sampling == "grid":
        dims = tuple(names)
        values = problem.space.axes()
        coords = {n: _coordinate(n, v, x) for n, v, x in zip(names, variables, values, strict=True)}
        shape = tuple(one.size for one in values)
    else:
        dims, shape = (DESIGN,), (len(designs),)
        columns = zip(names, variables, designs.T, strict=True)
        coords = {name: _coordinate(DESIGN, *column) for name, *column in columns}
    arrays: dict[str, Any] = {
        name: (dims, judged.values[:, column].reshape(shape), _of_wanted(problem, name))
        for column, name in enumerate(problem.names)
    }
    kept = (judged.constraints <= 0.0).all(axis=1) & np.isfinite(judged.values).all(axis=1)
    words = {"long_name": "whether a design keeps to all constraints", "units": "1"}
    arrays["feasible"] = (dims, kept.astype(np.int8).reshape(shape), words)
    arrays["failure"] = (dims, *_failures(judged, shape))
    results = xr.Dataset(arrays, coords)
    results.attrs = {**attributes(problem.study), "title": f"Designs of {problem.study.title}"}
    return results


def short_names(keys: list[str]) -> list[str]:
    """Last parts of dotted keys, with as many before them as tell them apart."""
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
    written = [variable.written(value) for value in values.tolist()]
    return dim, np.array(written), attrs


def _of_wanted(problem: Problem, name: str) -> dict[str, Any]:
    """Unit and words of an objective or constraint."""
    wanted, figure = problem.wanted[name], problem.figures[problem.names.index(name)]
    named = wanted.reported if wanted.reported is not None else figure.name
    unit = split_key(named)[1]
    words = wanted.reported or figure.label or figure.name
    over = (
        f"speeds {wanted.speeds}, receivers {wanted.receivers}, samples {problem.statistic(wanted)}"
    )
    order = f", order {wanted.order}" if wanted.order is not None else ""
    return {
        "units": unit.symbol if unit and unit.symbol else "1",
        "long_name": f"{words}{order} ({over})",
        "figure": figure.name,
    }


def _failures(judged: Judged, shape: tuple[int, ...]) -> tuple[Any, dict[str, str]]:
    """Number of the reason by design, and the reasons."""
    reasons = list(dict.fromkeys(judged.failed.values()))
    number = np.zeros(len(judged.values), dtype=np.int32)
    for row, reason in judged.failed.items():
        number[row] = 1 + reasons.index(reason)
    words = {"long_name": "number of the reason why a design failed, 0 where it did not",
             "units": "1", "reasons": json.dumps(reasons)}  # fmt: skip
    return number.reshape(shape), words


def table_csv(results: xr.Dataset) -> bytes:
    """Every design, a line each: variables, objectives and constraints, why it failed."""
    names = [str(name) for name in results.data_vars if name != "failure"]
    dims = results["failure"].dims
    axes = [str(name) for name in results.coords]
    columns = [
        np.ravel(results[name].broadcast_like(results["failure"]).transpose(*dims)) for name in axes
    ]
    columns += [np.ravel(results[name]) for name in names]
    reasons = ["", *json.loads(results["failure"].attrs["reasons"])]
    columns.append(np.array(reasons)[np.ravel(results["failure"])])
    return csv_bytes([*axes, *names, "failure"], zip(*(c.tolist() for c in columns), strict=True))
