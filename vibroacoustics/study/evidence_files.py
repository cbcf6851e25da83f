"""Evidence on a machine: published and measured values, from CSV files."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from pydantic import Field

from ..base.column_file import read_layouts
from ..base.column_head import Layout
from ..base.csv_form import number_form
from ..base.csv_text import read_lines
from ..base.errors import ParameterError
from ..base.parameters import Parameters
from .kinds import resolve_file_names
from .measured_spectrum import MeasuredSpectrum
from .reader import Reader
from .toml_files import beside


class PublishedForce(Parameters):
    """Force of a moving part at once per revolution, peak."""

    part: str
    speed_rpm: float = Field(gt=0.0)
    force_1x_n: float
    deviation_n: float = Field(ge=0.0)
    """Standard uncertainty of what is published."""
    proportional_to: str = ""
    """Values of the machine's file, dotted, apart by blanks; their ranges make the force's."""
    source: str


class Evidence(Parameters):
    """Published values beside which a report sets its results, and a measured spectrum."""

    forces: tuple[PublishedForce, ...] = ()
    spectrum: MeasuredSpectrum | None = None
    """Spectrum that weights the samples together with the published level."""


MAXIMUM_BYTES: Final = 1_000_000
_SPECTRUM: Final = "spectrum"
FORCES: Final = Layout(
    ("speed_rpm", "force_1x_n", "deviation_n"),
    texts=("part", "source"),
    optional_texts=("proportional_to",),
)


def take_evidence(content: dict[str, Any], reader: Reader) -> dict[str, Any]:
    """Take the table `evidence` out of a study: names of CSV files become their rows.

    The table of a measured spectrum is in SI, its file relative to the study's.

    Raises
    ------
    ParameterError
        It is no table of file names, or a file cannot be read.
    """
    table = content.pop("evidence", {})
    if not isinstance(table, Mapping):
        raise ParameterError(f"{reader.path}: evidence = {table!r}: must be a table")
    rows: dict[str, Any] = {}
    for key, name in table.items():
        file = reader.file(("evidence", key))
        if key not in Evidence.model_fields:
            allowed = ", ".join(Evidence.model_fields)
            raise ParameterError(f"{file}: evidence.{key}: unknown key; allowed {allowed}")
        if key == _SPECTRUM:
            if not isinstance(name, Mapping):
                raise ParameterError(f"{file}: evidence.{key} = {name!r}: must be a table")
            rows[key] = reader.to_si(name, ("evidence", key))
            resolve_file_names(rows[key], reader, ("evidence", key))
            continue
        if not isinstance(name, str):
            raise ParameterError(f"{file}: evidence.{key} = {name!r}: must be a file name")
        rows[key] = _rows(beside(file, name))
    return rows


def _rows(path: Path) -> tuple[dict[str, Any], ...]:
    """Rows of a file of published forces."""
    columns = read_layouts(path, [FORCES], MAXIMUM_BYTES)
    values = columns.texts | {name: each.tolist() for name, each in columns.numbers.items()}
    return tuple(dict(zip(values, row, strict=True)) for row in zip(*values.values(), strict=True))


def read_published_table(path: Path) -> dict[str, Any]:
    """A published table of scores: `criterion,OPTION,…`, one line a criterion, last the sums."""
    lines = read_lines(path, MAXIMUM_BYTES)
    separator = max(lines.separators, key=lines.texts[0].count)
    rows = lines.rows(separator)
    cells = [cell for row in rows[1:] for cell in row[1:]]
    try:
        options, form = tuple(rows[0][1:]), number_form(cells, separator)
        numbers = [tuple(form.numbers(row[1:]).tolist()) for row in rows[1:]]
        if len(rows) < 3 or any(len(row) != len(options) for row in numbers):
            raise ValueError("rows of different length")
        for what, names in (("option", options), ("criterion", [row[0] for row in rows[1:-1]])):
            if not names or "" in names or len(set(names)) < len(names):
                raise ValueError(f"every {what} must have a name, each once")
    except (ValueError, IndexError) as error:
        raise ParameterError(f"{path}: is no table of scores: {error.args[0]}") from None
    return {
        "source": " ".join(lines.comments),
        "options": options,
        "criteria": tuple(row[0] for row in rows[1:-1]),
        "scores": tuple(zip(*numbers[:-1], strict=True)),
        "sums": numbers[-1],
    }
