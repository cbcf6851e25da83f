"""Rows of expected values, and the inputs of a case."""

import csv
import tomllib
from pathlib import Path
from typing import NamedTuple

CASES = Path(__file__).resolve().parents[1] / "cases"


class Row(NamedTuple):
    """An expected value with its tolerance, both in `unit`, and where both come from."""

    key: str
    unit: str
    value: float
    tolerance: float
    derivation: str


def inputs(folder: Path) -> dict[str, float]:
    """Return the numbers of the file case.toml by name, in its units."""
    case = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
    return {entry["name"]: float(entry["value"]) for entry in case["inputs"]}


def table(folder: Path) -> list[dict[str, str]]:
    """Return the rows of the file inputs.csv."""
    return list(csv.DictReader((folder / "inputs.csv").read_text(encoding="utf-8").splitlines()))


def order(values: list[float], number: int) -> complex:
    """Return the complex peak c of an order; equally spaced values are Re sum of c exp(jna)."""
    from cmath import exp, pi

    turns = (exp(-2j * pi * number * row / len(values)) for row in range(len(values)))
    total = sum(value * turn for value, turn in zip(values, turns, strict=True))
    return total / len(values) * (2.0 if number else 1.0)
