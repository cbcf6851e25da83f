"""Tables of the best few designs, and what keeps each from being better."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.vocabulary import MEDIAN
from ...results.number import Number
from ..tables import Cell, DataTable, Table
from .evaluated import Evaluated

_AT_END = 1e-3
"""Share of a variable's range, or of a limit, that counts as at it."""


def best_tables(search: xr.Dataset, designs: Evaluated) -> Iterator[Table]:
    """Values of the best few, and what they reach as meant and as promised.

    Parameters
    ----------
    search : dataset of a search
    designs : the same as columns
    """
    head = ("Variable", *(f"{n}" for n in range(1, len(designs.best) + 1)))
    yield Table(
        "The best few designs",
        head,
        tuple(
            (column.heading, *(column.cell(row) for row in designs.best))
            for column in designs.variables
        ),
    )
    yield Table(
        "What they reach, as meant and as promised, beside the machine without an option",
        ("Wanted", "", "without", *head[1:]),
        tuple(row for number in range(search.sizes["wanted"]) for row in _reached(search, number)),
        frozenset({0, 1}),
    )


def best_designs(designs: Evaluated) -> DataTable:
    """Return the variables of the best few; `row` counts the rows of `designs.csv` from 0."""
    columns = {column.label: [column.cell(row) for row in designs.best] for column in
               designs.variables}  # fmt: skip
    rows = designs.best.tolist()
    return {"design": list(range(1, len(rows) + 1)), "row": rows, **columns}


def _reached(search: xr.Dataset, number: int) -> Iterator[tuple[Cell, ...]]:
    """A wanted value as meant and as promised."""
    unit = str(search["wanted_unit"].values[number])
    name = heading(str(search["wanted"].values[number]), unit)
    before = shown(float(search["wanted_reference"].values[number]), unit)
    as_meant = search["wanted_as_meant"].values[:, number]
    yield (name, "as meant", before, *(shown(float(value), unit) for value in as_meant))
    yield (name, "promised", before, *_promised(search, number, unit))
    if search.attrs["is_sampled"]:
        ends = (search[f"wanted_promised_{end}"].values[:, number] for end in ("low", "high"))
        each = (
            f"{shown(low, unit)} to {shown(high, unit)}" for low, high in zip(*ends, strict=True)
        )
        yield (name, "80 % interval", "", *each)


def _promised(search: xr.Dataset, number: int, unit: str) -> Iterator[Number]:
    ends = (search[f"wanted_promised{end}"].values[:, number] for end in ("", "_low", "_high"))
    for design, (value, low, high) in enumerate(zip(*ends, strict=True), 1):
        selection = {"design": design, "wanted": str(search["wanted"].values[number])}
        yield Number(
            float(value), unit, "wanted_promised", selection, MEDIAN, float(low), float(high),
            shown(float(value), unit),
        )  # fmt: skip


def no_best(search: xr.Dataset) -> str:
    """Return the sentence in place of the best designs; empty where they are listed.

    Every objective is a total level, and no design changes it by what could be measured.
    """
    return str(search.attrs["no_change"]) if search.attrs["only_totals"] else ""


def heading(name: str, unit: str) -> str:
    """A name with its unit."""
    return f"{name}, {unit}" if unit else name


def shown(value: float, unit: str) -> str:
    """A number with as many digits as it means: decibels with two decimals, others with four."""
    if not np.isfinite(value):
        return "–"
    return rounding.fixed(value, 2) if unit.startswith("dB") else f"{value:.4g}"


def limiting(search: xr.Dataset, designs: Evaluated) -> Iterator[str]:
    """What limits each of the best few: constraints that it just meets, ends of ranges."""
    low, high = search["design_low"].values, search["design_high"].values
    for rank, row in enumerate(designs.best, 1):
        reasons = []
        for number, column in enumerate(designs.variables):
            value, span = float(column.values[row]), high[number] - low[number]
            if column.words or np.isnan(value) or span <= 0.0:
                continue
            if value - low[number] < _AT_END * span:
                reasons.append(f"{column.label} is the least allowed")
            elif high[number] - value < _AT_END * span:
                reasons.append(f"{column.label} is the greatest allowed")
        reasons += _met_just(search, int(row))
        yield f"Design {rank}: " + ("; ".join(reasons) or "nothing limits it") + "."


def _met_just(search: xr.Dataset, row: int) -> Iterator[str]:
    for number, role in enumerate(search["wanted_role"].values):
        limit = float(search["wanted_limit"].values[number])
        if np.isnan(limit):
            continue
        value = float(search["wanted_value"].values[row, number])
        if abs(value - limit) <= 10.0 * _AT_END * max(abs(limit), 1e-12):
            unit = str(search["wanted_unit"].values[number])
            yield f"{search['wanted'].values[number]} is just {role} {limit:g} {unit}".rstrip()
