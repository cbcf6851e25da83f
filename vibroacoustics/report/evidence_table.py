"""Results beside published values as a table."""

from collections.abc import Iterable

import xarray as xr

from ..base import rounding
from .evidence import COVERAGE, Rung, rungs
from .tables import Table


def evidence_table(results: xr.Dataset) -> Table:
    """All that is published of what the results hold."""
    return rungs_table("Results beside published values", rungs(results))


def rungs_table(caption: str, shown: Iterable[Rung]) -> Table:
    """A rung a row."""
    head = (
        "Quantity", "Unit", "Simulation S", "Data D", "E = S − D", "u_num", "u_input", "u_D",
        "u", "Verdict", "Data from",
    )  # fmt: skip
    return Table(caption, head, tuple(map(_row, shown)), frozenset({0, 1, 9, 10}))


def _row(rung: Rung) -> tuple[str, ...]:
    numbers = (rung.simulation, rung.data)
    spreads = (rung.numerical, rung.inputs, rung.published, rung.uncertainty)
    is_level = rung.unit.startswith("dB")
    write = rounding.fixed if is_level else rounding.significant
    reach = f"{write(COVERAGE * rung.uncertainty)} {rung.unit.removesuffix('(A)')}"
    verdict = (
        f"agrees: no error above {reach} is seen"
        if rung.agrees
        else f"differs by more than {reach}"
    )
    return (
        rung.quantity,
        rung.unit,
        *map(write, numbers),
        rounding.signed(rung.error) if is_level else _with_sign(rung.error),
        *(rounding.significant(spread, 2) for spread in spreads),
        verdict,
        rung.source,
    )


def _with_sign(value: float) -> str:
    text = rounding.significant(value)
    return f"+{text}" if value > 0.0 else text
