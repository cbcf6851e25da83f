"""Cases of the open benchmark: their inputs, and what an answer is."""

import csv
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple


class Answer(NamedTuple):
    """A value that answers a row of a case, in the unit that the case expects.

    Attributes
    ----------
    key : key of the row
    unit : unit of the value
    value : a number
    """

    key: str
    unit: str
    value: float


Answers = Iterator[Answer]


@dataclass(frozen=True)
class Case:
    """Inputs of a case.

    Attributes
    ----------
    values : numbers by name, in the units of the file case.toml
    rows : rows of the file inputs.csv, by column; none where the case has no such file
    """

    values: Mapping[str, float]
    rows: tuple[Mapping[str, str], ...]


def read_case(folder: Path) -> Case:
    """Read the inputs of the case in a folder."""
    tables = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
    values = {entry["name"]: float(entry["value"]) for entry in tables["inputs"]}
    table = folder / "inputs.csv"
    rows = table.read_text(encoding="utf-8").splitlines() if table.exists() else []
    return Case(values, tuple(csv.DictReader(rows)))
