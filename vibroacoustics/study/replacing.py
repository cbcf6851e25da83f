"""Values of a study replaced in Python, and the study validated again as its file is."""

from collections.abc import Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError
from .reader import is_number
from .toml_files import Written, is_table, leaves, merge

FILE: Final = Path("study.replace")
"""Stands in refusals and records for a file; names of files count from the working folder."""
SOURCE: Final = "replaced in Python"
_MACHINE: Final = ("machine", "override")


def replaced(written: Written, values: Mapping[str, Any]) -> Written:
    """Return what a study's file would say with other values.

    Parameters
    ----------
    written : content of the study's file
    values : value or table by dotted key, with units as in a file; None takes a table or value out

    Raises
    ------
    ParameterError
        A key is no text, or what is to be taken out is not there.
    """
    changes: dict[str, Any] = {}
    content = deepcopy(written.content)
    for dotted, value in values.items():
        if not isinstance(dotted, str) or not all(dotted.split(".")):
            raise ParameterError(f"{FILE}: {dotted!r}: must be a dotted key")
        keys = _keys(dotted)
        if value is None:
            _take_out(content, keys)
            continue
        in_machine = keys[: len(_MACHINE)] == _MACHINE
        _put(changes, keys, _as_in_file(value, in_machine))
    origin = written.origin | dict.fromkeys(leaves(changes), FILE)
    return Written(written.path, merge(content, changes), origin)


def _keys(dotted: str) -> tuple[str, ...]:
    """Keys in the study's file; values of the machine are in its table `machine.override`."""
    first, *further = dotted.split(".")
    inner = first == "machine" and further[:1] not in (
        ["file"],
        ["title"],
        ["override"],
        ["without"],
    )
    return (*_MACHINE, *further) if inner else (first, *further)


def _put(changes: dict[str, Any], keys: tuple[str, ...], value: Any) -> None:
    table = changes
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    if is_table(table.get(keys[-1])) and is_table(value):
        value = merge(table[keys[-1]], value)
    table[keys[-1]] = value


def _take_out(content: dict[str, Any], keys: tuple[str, ...]) -> None:
    table: Any = content
    for key in keys[:-1]:
        table = table.get(key) if isinstance(table, dict) else None
    if not isinstance(table, dict) or keys[-1] not in table:
        raise ParameterError(f"{FILE}: {'.'.join(keys)} = None: there is none to take out")
    del table[keys[-1]]


def _as_in_file(value: Any, with_source: bool) -> Any:
    """A value as TOML would hold it; a number of the machine gets a source, which it needs."""
    if isinstance(value, Mapping):
        is_value = "value" in value
        return {str(key): _as_in_file(v, with_source and not is_value) for key, v in value.items()}
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_as_in_file(item, False) for item in value]
    if with_source and is_number(value):
        return {"value": value, "source": SOURCE}
    return str(value) if isinstance(value, Path) else value
