"""Tables whose key `kind` names the class of their parameters, and names of data files in them."""

from collections.abc import Mapping
from typing import Any

from ..base.errors import ParameterError
from ..base.parameters import Kind, split_kind
from ..base.registry import Registry
from .reader import Reader
from .toml_files import beside
from .wording import checked


def resolve_file_names(table: dict[str, Any], reader: Reader, prefix: tuple[str, ...] = ()) -> None:
    """Make every `file` of a table and of its tables relative to the file that holds it.

    Parameters
    ----------
    table : in SI; changed in place
    reader : reader of the file
    prefix : keys of the table
    """
    for key, value in table.items():
        keys = (*prefix, key)
        if isinstance(value, dict):
            resolve_file_names(value, reader, keys)
        elif key == "file" and isinstance(value, str) and value:
            if reader.sources_required:
                _require_source(value, reader, keys)
            table[key] = str(beside(reader.file(keys), value))


def _require_source(name: str, reader: Reader, keys: tuple[str, ...]) -> None:
    """Add a missing source of a data file to the problems of the reader."""
    where = reader.file_and_key(keys)
    recorded = any(record.field == ".".join(keys) for record in reader.records)
    if not recorded and f"{where}: source is missing" not in reader.problems:
        reader.problems.append(
            f'{where} = {name}: needs a source: {{ value = "{name}", source = "…" }}'
        )


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
