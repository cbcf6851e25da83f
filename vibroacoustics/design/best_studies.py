"""The best few designs as studies that run: files that extend the one that was searched."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..machine.combination import SEPARATOR, Combination, joined_names
from ..study.toml_files import merge
from ..study.toml_text import toml_text
from .problem import Problem

_SOURCE = "found by a search of designs"


def best_studies(
    problem: Problem, search: xr.Dataset, study_file: Path, folder: Path
) -> dict[str, str]:
    """Texts of study files by name: one with the best few as options, or one for each of them.

    One for each where designs change the machine.
    """
    base = os.path.relpath(study_file.resolve(), folder.resolve())
    factors = np.array([variable.factor for variable in problem.space.variables])
    rows = search["design_value"].values[search["best_design"].values] * factors
    head = {"extends": Path(base).as_posix()}
    title = problem.study.title
    if any(key.startswith("machine.") for key in problem.space.names):
        return {
            f"best_{rank}.toml": toml_text(
                {**head, "title": f"{title}: best design {rank}", **_changes(problem, row)}
            )
            for rank, row in enumerate(rows, 1)
        }
    options: dict[str, Any] = {}
    for rank, row in enumerate(rows, 1):
        options |= _options(problem, row, f"best-{rank}")
    content = {**head, "title": f"{title}: best designs", "options": options}
    return {"best.toml": toml_text(content)}


def _changes(problem: Problem, design: np.ndarray[Any, Any]) -> dict[str, Any]:
    """Tables of a study in which the option and the machine have a design's values."""
    tables: dict[str, Any] = {}
    for key, value in problem.space.written(design).items():
        first, *inner = key.split(".")
        if first == "machine":
            _put(tables, [first, "override", *inner], {"value": value, "source": _SOURCE})
    return {**tables, "options": _options(problem, design, "best")}


def _options(problem: Problem, design: np.ndarray[Any, Any], name: str) -> dict[str, Any]:
    """Tables of an option with a design's values; of a combination, of all that it joins."""
    option = problem.space.option_of(design)
    tables: dict[str, Any] = {}
    for key, value in problem.space.written(design).items():
        first, *inner = key.split(".")
        if first == "options":
            _put(tables, inner, value)
    if not isinstance(problem.study.options[option], Combination):
        return {name: merge(_given(problem, option), tables.get(option, {}))}
    copies = {part: f"{name}-{part}" for part in joined_names(option)}
    parts = {
        copy: merge(_given(problem, part), tables.get(part, {})) for part, copy in copies.items()
    }
    joined = {**_given(problem, option), "title": name}
    return {**parts, SEPARATOR.join(copies.values()): joined}


def _given(problem: Problem, option: str) -> Mapping[str, Any]:
    """Table of an option as the study's file gives it."""
    table: Mapping[str, Any] = problem.study.as_written()["options"][option]
    return table


def _put(table: dict[str, Any], keys: list[str], value: Any) -> None:
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    table[keys[-1]] = value
