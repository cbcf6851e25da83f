"""Tables of `balance` with a study: changes at other speeds, and inputs that the runs narrow."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ...base import rounding
from ...base.arrays import Array
from ...design.bench.balanced_runs import BalancedRuns
from ...design.bench.elsewhere import (
    LEAST_SAMPLES,
    ChangeElsewhere,
    NarrowedInput,
    changes_elsewhere,
    effective,
    narrowed_inputs,
    sample_weights,
)
from ...report.blocks import Bullets, Part
from ...report.tables import DataTable, Table, columns_of
from .tables import band

_CHANGES: Final = (
    "where", "speed_rpm", "change_low_db", "change_db", "change_high_db",
    "total_low_db", "total_db", "total_high_db",
)  # fmt: skip
_INPUTS: Final = (
    "input", "before_low", "before_median", "before_high",
    "after_low", "after_median", "after_high",
)  # fmt: skip


def study_part(result: BalancedRuns) -> tuple[list[Part], dict[str, DataTable]]:
    """Return the part of the page and its tables for programs; empty without a study.

    Parameters
    ----------
    result : answer for runs
    """
    changes = changes_elsewhere(result)
    if not changes:
        return [], {}
    inputs = narrowed_inputs(result)
    below = _inputs_table(inputs) if inputs else Bullets((_nothing_narrowed(result),))
    blocks = (_changes_table(result, changes), below)
    changed: list[Sequence[str | float]] = [
        (each.observer, each.speed_rpm, *each.change_db.tolist(), *_cells(each.total_db))
        for each in changes
    ]
    narrowed: list[Sequence[str | float]] = [
        (each.name, *each.before.tolist(), *each.after.tolist()) for each in inputs
    ]
    tables = {
        "changes.csv": columns_of(_CHANGES, changed),
        "inputs.csv": columns_of(_INPUTS, narrowed),
    }
    return [Part("study", "With the study", blocks)], tables


def _changes_table(result: BalancedRuns, changes: Sequence[ChangeElsewhere]) -> Table:
    least = 0.0 if result.study is None else result.study.study.scoring.measurable.level_db
    rows = tuple(
        (each.observer, f"{each.speed_rpm:.0f}", _change(each.change_db, 0.0),
         rounding.NOTHING if each.total_db is None else _change(each.total_db, least))
        for each in changes
    )  # fmt: skip
    head = ("Where", "rpm", "1×, dB (80 %)", "Total, dB(A) (80 %)")
    return Table("Change by the weights", head, rows)


def _change(band_db: Array, least_db: float) -> str:
    """Median and ends of a change; words where it cannot be measured."""
    if np.abs(band_db).max() < least_db:
        return "no measurable change"
    low, middle, high = (f"{value:+.1f}" for value in band_db)
    return f"{middle} ({low} to {high})"


def _cells(band_db: Array | None) -> list[str | float]:
    return [""] * 3 if band_db is None else band_db.tolist()


def _inputs_table(inputs: Sequence[NarrowedInput]) -> Table:
    rows = tuple(
        (each.name, band(each.before[0], each.before[2]), band(each.after[0], each.after[2]))
        for each in inputs
    )
    head = ("Input, SI", "Before the runs, 80 %", "After, 80 %")
    return Table("What the runs say about the machine", head, rows)


def _nothing_narrowed(result: BalancedRuns) -> str:
    """Say why the runs narrow no input."""
    weight = sample_weights(result)
    if weight is None:
        return "Without known scatter the runs say nothing about the inputs of the study."
    count = effective(weight)
    if count >= LEAST_SAMPLES:
        return "The runs narrow no input of the study to less than 80 % of its interval."
    return (
        f"The readings fit {count:.0f} of {len(weight)} samples, and {LEAST_SAMPLES:.0f} are "
        "needed: nothing is said about inputs, and changes count all samples alike."
    )
