"""Tables whose key `kind` names the class of their parameters."""

from collections.abc import Mapping
from typing import Any

from ..base.errors import ParameterError
from ..base.parameters import Kind, split_kind
from ..base.registry import Registry
from .reader import Reader
from .wording import validated


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
    """Turn each table of a table, such as that of the options, into parameters of its kind."""
    tables = content.get(name)
    if not isinstance(tables, dict):  # refused by the study
        return
    for key, table in tables.items():
        if isinstance(table, dict):
            kind, values = of_kind(registry, table, reader.file_and_key((name, key)))
            tables[key] = validated(kind, values, reader, (name, key))
