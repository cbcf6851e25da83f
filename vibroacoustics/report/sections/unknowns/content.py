"""Unknowns that the level depends on, and what to measure next."""

import xarray as xr

from ....base.registry import register
from ...blocks import Block, Text
from ...tables import DataTable, long_table
from .. import Section, hold, text
from . import tables as unknowns


def _blocks(results: xr.Dataset) -> list[Block]:
    table = unknowns.unknowns_table(results)
    return [
        *text(unknowns.measure_next_sentence(results), "strong"),
        Text(unknowns.resolved_sentence(results)),
        *([table] if table else []),
        Text(
            "A share is the expected loss of variance once the parameter is known, with its 80 % "
            "bootstrap interval. It is resolved where this interval is above what chance gives. "
            "All shares are in uncertainty.csv.",
            "note",
        ),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Shares of all parameters, values of measurements, levels with less evidence."""
    stems = ("level_share", "parameter_information", "perfect_information", "alternative_",
             "projection_error")  # fmt: skip
    names = [name for name in map(str, results.data_vars) if name.startswith(stems)]
    return {"uncertainty.csv": long_table(results, names)}


register(Section("unknowns", "Sensitivity", _blocks, hold("level_share"), 35.0, tables=_data))
