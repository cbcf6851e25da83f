"""Names of data files in tables, relative to the TOML file that holds them."""

from typing import Any

from .reader import Reader
from .toml_files import beside


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
