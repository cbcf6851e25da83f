"""Outcome of a command, and the envelope of JSON that it has for other programs."""

import csv
import io
import json
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from ..base.refusal import parts_of
from ..base.visible import visible

if TYPE_CHECKING:
    from ..report.analysis import Analysis

Table = Mapping[str, Sequence[Any]]
"""Values by column."""

_MAXIMUM_BYTES: Final = 500_000_000
_CELL: Final = {"type": ["number", "string", "boolean", "null"]}
_TEXT: Final = {"type": "string"}
_LEVEL: Final = {"type": ["number", "null"]}
_WORDS: Final = {"type": ["string", "null"]}


def _object(required: Mapping[str, Any], optional: Mapping[str, Any] | None = None) -> Any:
    return {
        "type": "object",
        "properties": {**required, **(optional or {})},
        "required": list(required),
        "additionalProperties": False,
    }


SCHEMA: Final[dict[str, Any]] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "Outcome of a command of vibroacoustics",
    **_object({
        "command": _TEXT,
        "version": _TEXT,
        "inputs": {"type": "object"},
        "tables": {
            "type": "object",
            "additionalProperties": {
                "type": "object",
                "additionalProperties": {"type": "array", "items": _CELL},
            },
        },
        "numbers": {
            "type": "array",
            "items": _object(
                {
                    "value": _LEVEL,
                    "unit": _TEXT,
                    "variable": _TEXT,
                    "selection": {"type": "object", "additionalProperties": _CELL},
                    "statistic": _TEXT,
                },
                {"low": _LEVEL, "high": _LEVEL, "text": _TEXT},
            ),
        },
        "charts": {"type": "array", "items": {"type": "object"}},
        "files": {"type": "object", "additionalProperties": _TEXT},
        "warnings": {"type": "array", "items": _TEXT},
        "errors": {
            "type": "array",
            "items": _object({
                "file": _WORDS,
                "field": _WORDS,
                "value": _CELL,
                "unit": _WORDS,
                "allowed": _WORDS,
                "message": _TEXT,
            }),
        },
    }),
}  # fmt: skip
"""JSON schema of the envelope."""
_ANSWERED: Final = ContextVar("_ANSWERED", default=False)
"""Whether this command has written its envelope."""


@dataclass(frozen=True)
class Outcome:
    """Outcome of a command: words for the terminal, files, and data for other programs.

    Attributes
    ----------
    text : for the terminal
    files : that were written, by label; the terminal shows both. Files that belong to them by
        `files.json` are added to the envelope, and every CSV file is a table of it
    tables : further tables, by name
    analyses : whose tables, numbers and charts belong to it, by prefix of the tables; the terminal
        shows them before the text
    broken : a line for each limit that is broken; the exit code is then 1
    """

    text: str = ""
    files: Mapping[str, Path] = field(default_factory=dict)
    tables: Mapping[str, Table] = field(default_factory=dict)
    analyses: Mapping[str, "Analysis"] = field(default_factory=dict)
    broken: Sequence[str] = ()

    def lines(self) -> Iterator[str]:
        """Lines for the terminal."""
        texts = (*(each.text() for each in self.analyses.values()), self.text)
        yield from (text.rstrip("\n") for text in texts if text.strip("\n"))
        yield from (f"broken: {line}" for line in self.broken)
        yield from (f"{label}: {path}" for label, path in self.files.items())

    def envelope(
        self,
        name: str,
        inputs: Mapping[str, Any],
        warnings: Sequence[str],
        errors: Iterable[str] = (),
    ) -> Any:
        """Return the outcome of a command as plain JSON values; see `SCHEMA`."""
        from importlib.metadata import version

        files = _with_further(self.files)
        parts = {prefix: each.json() for prefix, each in self.analyses.items()}
        tables = {
            f"{prefix}{table}": columns
            for prefix, each in parts.items()
            for table, columns in each["tables"].items()
        }
        for key, path in files.items():
            table = key.removesuffix(".csv")
            if table not in {key, *tables}:
                from ..base.regular_file import read_text

                tables[table] = _columns(read_text(path, _MAXIMUM_BYTES))
        return _plain({
            "command": name,
            "version": version("vibroacoustics"),
            "inputs": inputs,
            "tables": {**tables, **self.tables},
            "numbers": [number for each in parts.values() for number in each["numbers"]],
            "charts": [chart for each in parts.values() for chart in each["charts"]],
            "files": files,
            "warnings": warnings,
            "errors": [_error(line) for line in errors],
        })  # fmt: skip


def begin() -> None:
    """Begin a command, which has written no envelope."""
    _ANSWERED.set(False)


def write_envelope(envelope: Any) -> None:
    """Write the envelope of a command on stdout."""
    _ANSWERED.set(True)
    sys.stdout.write(json.dumps(envelope, indent=1) + "\n")
    sys.stdout.flush()


def write_errors(words: Sequence[str], errors: Iterable[str], warnings: Sequence[str] = ()) -> None:
    """Write the envelope of a command that fails, if it is asked for and not written yet.

    Parameters
    ----------
    words : words of the command line
    errors : a line of each error
    warnings : warnings of the command
    """
    options = words[: words.index("--")] if "--" in words else words
    if "--json" in options and not _ANSWERED.get():
        name = next((word for word in words if not word.startswith("-")), "")
        write_envelope(Outcome().envelope(name, {}, warnings, errors))


def _error(line: str) -> dict[str, Any]:
    """Return an error as plain JSON values."""
    return {**parts_of(line)._asdict(), "message": " ".join(visible(line).split())}


def columns(rows: Sequence[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Turn rows into columns; a value that a row lacks is null."""
    heads = dict.fromkeys(head for row in rows for head in row)
    return {head: [row.get(head) for row in rows] for head in heads}


def _with_further(files: Mapping[str, Path]) -> dict[str, Path]:
    """Files by label, then those that belong to them and CSV files, by name below the label."""
    further: dict[str, Path] = {}
    for label, path in files.items():
        from ..results import manifest

        prefix = label.rpartition("/")[0]
        for name in manifest.together(path.parent, path.name) | {path.name}:
            written = path.parent / name
            if written not in files.values() or name.endswith(".csv"):
                further[f"{prefix}/{name}".lstrip("/")] = written
    return {**files, **dict(sorted(further.items()))}


def _columns(text: str) -> dict[str, list[Any]]:
    """Columns of a CSV file by head; numbers as numbers, empty cells as null."""
    lines = csv.reader(io.StringIO(text))
    heads = next(lines, [])
    values: list[list[Any]] = [[] for _ in heads]
    for cells in lines:
        for column, cell in zip(values, cells, strict=False):
            column.append(_cell(cell))
    return dict(zip(heads, values, strict=True))


def _cell(text: str) -> str | float | None:
    try:
        return float(text)
    except ValueError:
        return text or None


def _plain(value: Any) -> Any:
    """Return a value as JSON has it: a number that is not finite is null."""
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, float):
        return value if isfinite(value) else None
    return value if isinstance(value, str | int | bool | None) else str(value)
