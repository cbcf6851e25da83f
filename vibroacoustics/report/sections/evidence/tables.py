"""Results beside published values, in words and tables."""

from collections.abc import Iterable

import xarray as xr

from ....base import rounding
from ....results.validation import AGREES, DIFFERS, UNDECIDED, Validation, validations
from ...tables import Table


def agreement_sentence(results: xr.Dataset) -> str:
    """Whether the modelled level agrees with the published one; empty where none is published."""
    levels = [each for each in validations(results) if each.unit == "dB(A)"]
    if not levels:
        return ""
    level = levels[0]
    published, tolerance = f"{rounding.fixed(level.data)} dB(A)", f"{level.tolerance:g} dB"
    words = {
        AGREES: f"agrees with the published {published} within {tolerance}",
        DIFFERS: f"differs from the published {published}",
        UNDECIDED: f"is too uncertain to be compared with the published {published}",
    }[level.verdict]
    return (
        f"The modelled level before any published datum {words}: E = "
        f"{rounding.signed(level.error)} dB, u = {rounding.fixed(level.uncertainty)} dB."
    )


def evidence_table(results: xr.Dataset) -> Table:
    """All that is published of what the results hold."""
    return validation_table("Results beside published values", validations(results))


def validation_table(caption: str, shown: Iterable[Validation]) -> Table:
    """Return a table with a row for each validation."""
    head = (
        "Quantity", "Unit", "Simulation S", "Data D", "E = S − D", "u_num", "u_input", "u_D",
        "u", "Verdict", "Data from",
    )  # fmt: skip
    return Table(caption, head, tuple(map(_row, shown)), frozenset({0, 1, 9, 10}))


def _row(shown: Validation) -> tuple[str, ...]:
    numbers = (shown.simulation, shown.data)
    spreads = (shown.numerical, shown.inputs, shown.published, shown.uncertainty)
    is_level = shown.unit.startswith("dB")
    write = rounding.fixed if is_level else rounding.significant
    tolerance = f"{write(shown.tolerance)} {shown.unit.removesuffix('(A)')}"
    verdict = f"{AGREES} within {tolerance}" if shown.verdict == AGREES else shown.verdict
    return (
        shown.quantity,
        shown.unit,
        *map(write, numbers),
        rounding.signed(shown.error) if is_level else _with_sign(shown.error),
        *(rounding.significant(spread, 2) for spread in spreads),
        verdict,
        shown.source,
    )


def _with_sign(value: float) -> str:
    text = rounding.significant(value)
    return f"+{text}" if value > 0.0 else text
