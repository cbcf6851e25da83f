"""What speaks for the results: published values beside them."""

import xarray as xr

from ....base.registry import register
from ....results.validation import (
    COVERAGE,
    FORCE_TOLERANCE,
    LEVEL_TOLERANCE_DB,
    ONE_SIDED,
    validations,
)
from ...bands import percent
from ...blocks import Block, Text
from ...tables import DataTable, long_table
from .. import Section, text
from .tables import agreement_sentence, conflict_table, evidence_table


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        *text(agreement_sentence(results), "strong"),
        evidence_table(results),
        Text(
            "E is simulation minus data, u the root of the sum of squared standard uncertainties "
            "of numerics, inputs and data (ASME V&V 20). They agree within a tolerance T where "
            f"|E| + {ONE_SIDED:g} u ≤ T ({LEVEL_TOLERANCE_DB:g} dB, {percent(FORCE_TOLERANCE)} of "
            f"a force) and differ where |E| > {COVERAGE:g} u.",
            "note",
        ),
        *([conflict_table(results)] if "datum_tail" in results else []),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Every validation, and published data beside what the model expects before them."""
    shown = validations(results)
    names = ("quantity", "unit", "simulation", "data", "error", "numerical", "inputs",
             "published", "uncertainty", "tolerance", "verdict", "source")  # fmt: skip
    conflicts = ("datum_value", "datum_deviation", "datum_expected", "datum_tail", "conflict_tail")
    return {
        "evidence.csv": {name: [getattr(each, name) for each in shown] for name in names},
        "conflict.csv": long_table(results, conflicts),
    }


def _applies(results: xr.Dataset) -> bool:
    return bool(validations(results))


register(Section("evidence", "Evidence", _blocks, _applies, 95.0, tables=_data))
