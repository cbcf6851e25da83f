"""Tables whose key `kind` names the class of their parameters."""

from collections.abc import Mapping
from typing import Any

from ..base.errors import ParameterError
from ..base.parameters import Kind, split_kind
from ..base.registry import Registry
from .reader import Reader
from .wording import checked


def of_kind(
    registry: Registry[type[Kind]], table: Mapping[str, Any], where: str
) -> tuple[type[Kind], dict[str, Any]]:
    """Class and values of a table, by its key `kind`."""
    try:
        return split_kind(registry, table)
    except ParameterError as error:
        text = str(error)
        raise ParameterError(f"{where}{'.' if text.startswith('kind =') else ': '}{text}") from None


def validate_kinds(
    content: dict[str, Any], name: str, registry: Registry[type[Kind]], reader: Reader
) -> None:
    """Turn each table of a table, such as that of the options, into parameters of its kind.

    What is refused is taken out and goes to the problems of the reader.
    """
    tables = content.get(name)
    if not isinstance(tables, dict):  # refused by the study
        return
    valid: dict[str, Any] = {}
    for key, table in tables.items():
        if isinstance(table, dict):
            try:
                kind, values = of_kind(registry, table, reader.file_and_key((name, key)))
                with registry.fenced(kind.kind, ParameterError):
                    valid[key] = checked(kind, values, reader, (name, key))
            except ParameterError as error:
                reader.problems += error.args
        else:  # refused by the study
            valid[key] = table
    content[name] = valid
