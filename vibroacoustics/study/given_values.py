"""Values of criteria that a study judges instead of computing."""

from collections.abc import Mapping
from typing import Any

from ..base.errors import ParameterError
from .reader import Reader, is_number
from .toml_files import is_table


def take_given(content: Mapping[str, Any], reader: Reader) -> dict[str, dict[str, float]]:
    """Take the table `given` out of each option: its values as written, by criterion."""
    options = content.get("options")
    return {
        name: _given_values(table.pop("given"), name, content, reader)
        for name, table in (options if isinstance(options, dict) else {}).items()
        if isinstance(table, dict) and "given" in table
    }


def _given_values(
    table: Any, option: str, content: Mapping[str, Any], reader: Reader
) -> dict[str, float]:
    """Numbers of one option's table; those with a source are recorded in the scale's unit."""
    keys = ("options", option, "given")
    if not is_table(table):
        raise ParameterError(f"{reader.file_and_key(keys)}: must be a table")
    values = {}
    for name, written in table.items():
        unit = _at(content, ("scoring", "criteria", name, "unit"))
        try:
            number = reader.number((*keys, name), written, unit if isinstance(unit, str) else "")
        except ParameterError as error:
            reader.problems += error.args
            continue
        if is_number(number):
            values[name] = float(number)
        else:
            where = reader.file_and_key((*keys, name))
            reader.problems.append(f"{where} = {number}: must be a number")
    return values


def _at(content: Any, keys: tuple[str, ...]) -> Any:
    """Value under nested keys; None where one is missing."""
    for key in keys:
        content = content.get(key) if isinstance(content, dict) else None
    return content
