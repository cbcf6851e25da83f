"""Tables of the best few designs, and what keeps each from being better."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from ..tables import Table
from .evaluated import Evaluated

_AT_END = 1e-3
"""Share of a variable's range, or of a limit, that counts as at it."""


def best_tables(found: xr.Dataset, designs: Evaluated) -> Iterator[Table]:
    """Values of the best few, and what they reach as meant and as promised.

    Parameters
    ----------
    found : dataset of a search
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
        ("Wanted", "without", *(part for n in head[1:] for part in (f"{n}: meant", "promised"))),
        tuple(_reached(found, number) for number in range(found.sizes["wanted"])),
    )


def _reached(found: xr.Dataset, number: int) -> tuple[str, ...]:
    unit = str(found["wanted_unit"].values[number])
    label = str(found["wanted_label"].values[number])
    before = float(found["wanted_reference"].values[number])
    cells = []
    for rank in range(found.sizes["best_rank"]):
        meant, value, low, high = (
            float(found[name].values[rank, number])
            for name in ("wanted_as_meant", "wanted_promised", "wanted_promised_low",
                         "wanted_promised_high")
        )  # fmt: skip
        half = max(high - value, value - low)
        band = f" ± {half:.2g}" if half > 0.0 else ""
        cells += [f"{meant:.4g}", f"{value:.4g}{band}"]
    return (f"{label}, {unit}" if unit else label, f"{before:.4g}", *cells)


def limiting(found: xr.Dataset, designs: Evaluated) -> Iterator[str]:
    """What limits each of the best few: constraints that it just meets, ends of ranges."""
    low, high = found["design_low"].values, found["design_high"].values
    for rank, row in enumerate(designs.best, 1):
        reasons = []
        for number, column in enumerate(designs.variables):
            value, span = float(column.values[row]), high[number] - low[number]
            if column.words or span <= 0.0:
                continue
            if value - low[number] < _AT_END * span:
                reasons.append(f"{column.label} is the least allowed")
            elif high[number] - value < _AT_END * span:
                reasons.append(f"{column.label} is the greatest allowed")
        reasons += _met_just(found, int(row))
        yield f"Design {rank}: " + ("; ".join(reasons) or "nothing limits it") + "."


def _met_just(found: xr.Dataset, row: int) -> Iterator[str]:
    for number, role in enumerate(found["wanted_role"].values):
        limit = float(found["wanted_limit"].values[number])
        if np.isnan(limit):
            continue
        value = float(found["wanted_value"].values[row, number])
        if abs(value - limit) <= 10.0 * _AT_END * max(abs(limit), 1e-12):
            unit = str(found["wanted_unit"].values[number])
            yield f"{found['wanted_label'].values[number]} is just {role} {limit:g} {unit}".rstrip()
