"""The best few designs as studies that run: files that extend the one that was searched."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

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
    options = {f"best-{rank}": _option(problem, row) for rank, row in enumerate(rows, 1)}
    content = {**head, "title": f"{title}: best designs", "options": options}
    return {"best.toml": toml_text(content)}


def _changes(problem: Problem, design: np.ndarray[Any, Any]) -> dict[str, Any]:
    """Tables of a study in which the option and the machine have a design's values."""
    option = problem.space.option_of(design)
    tables: dict[str, Any] = {}
    for key, value in problem.space.written(design).items():
        first, *rest = key.split(".")
        is_machine = first == "machine"
        given = {"value": value, "source": _SOURCE} if is_machine else value
        _put(tables, [first, *(["override"] if is_machine else []), *rest], given)
    named = tables.get("options", {}).get(option)
    return {**tables, "options": {"best": merge(_given(problem, option), named or {})}}


def _option(problem: Problem, design: np.ndarray[Any, Any]) -> Mapping[str, Any]:
    """Table of an option with a design's values."""
    option = problem.space.option_of(design)
    tables: dict[str, Any] = {}
    for key, value in problem.space.written(design).items():
        _put(tables, key.split(".")[2:], value)
    return merge(_given(problem, option), tables)


def _given(problem: Problem, option: str) -> Mapping[str, Any]:
    """Table of an option as the study's file gives it."""
    table: Mapping[str, Any] = problem.study.as_written()["options"][option]
    return table


def _put(table: dict[str, Any], keys: list[str], value: Any) -> None:
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    table[keys[-1]] = value
