"""Where the inputs come from, and what is not modelled."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import overall_noise
from ...blocks import Block, Bullets, Heading, Text
from ...tables import DataTable
from .. import Section
from . import tables as assumptions


def _blocks(results: xr.Dataset) -> list[Block]:
    published = overall_noise(results)
    assumed, recorded = assumptions.assumed_count(results)
    return [
        Heading("What is not modelled"),
        Bullets(tuple(assumptions.not_modelled(results))),
        *([Text(assumptions.structure_borne_sentence(results))] if published else []),
        Heading("Unmodelled noise"),
        Text(assumptions.remainder_sentence(results)),
        *_of_discrepancy(results),
        Heading("Inputs"),
        Text(
            f"{assumed} of {recorded} recorded values are assumed; all are in inputs.csv. A range "
            "is expected to hold the true value."
        ),
        assumptions.records_table(results),
    ]


def _of_discrepancy(results: xr.Dataset) -> list[Block]:
    sentence = assumptions.discrepancy_sentence(results)
    return [Heading("Model discrepancy"), Text(sentence)] if sentence else []


def _inputs(results: xr.Dataset) -> dict[str, DataTable]:
    return {"inputs.csv": assumptions.inputs_data(results)}


register(Section("assumptions", "Assumptions", _blocks, position=100.0, tables=_inputs))


def _errata(results: xr.Dataset) -> list[Block]:
    table = assumptions.errata_table(results)
    return [table] if table else []


def _has_errata(results: xr.Dataset) -> bool:
    return assumptions.errata_table(results) is not None


register(Section("errata", "Errata of the source", _errata, _has_errata, 110.0))
