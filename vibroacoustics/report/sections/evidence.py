"""What speaks for the results: published values beside them."""

import xarray as xr

from ...base.registry import register
from ..blocks import Block, Text
from ..evidence import COVERAGE, evidence_table, rungs
from . import Section


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "Simulation S beside data D, in the form of ASME V&V 20: the error E = S − D, and the "
            "standard uncertainties of the numerics, of the inputs (all values with a range, drawn "
            "evenly before any data are used) and of the data; u is the root of the sum of their "
            f"squares. Where |E| is not above {COVERAGE:g} u the comparison shows no error of the "
            "model: the larger u is, the less that says. A force that is printed is no "
            "measurement.",
            "note",
        ),
        evidence_table(results),
    ]


def _applies(results: xr.Dataset) -> bool:
    return bool(rungs(results))


register(Section("evidence", "Evidence", _blocks, _applies, 95.0))
