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
from .. import Section
from . import conflict
from .tables import evidence_table


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "Simulation S beside data D, in the form of ASME V&V 20: the error E = S − D, and the "
            "standard uncertainties of the numerics, of the inputs (all values with a range, "
            "sampled evenly before any data are used) and of the data; u is the root of the sum of "
            f"their squares. S agrees with D within a tolerance T where |E| + {ONE_SIDED:g} u ≤ T, "
            f"with T = {LEVEL_TOLERANCE_DB:g} dB for levels and {percent(FORCE_TOLERANCE)} for "
            f"forces; it differs where |E| > {COVERAGE:g} u; else that is undecided. A force that "
            "is printed is no measurement.",
            "note",
        ),
        evidence_table(results),
        *_conflict(results),
    ]


def _conflict(results: xr.Dataset) -> list[Block]:
    if not conflict.applies(results):
        return []
    return [Text(conflict.conflict_sentence(results)), conflict.conflict_table(results)]


def _applies(results: xr.Dataset) -> bool:
    return bool(validations(results))


register(Section("evidence", "Evidence", _blocks, _applies, 95.0))
