"""Claims of the software that apply to a study: computed values beside references."""

from typing import Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...results.claims import MISSED, Claim, claims, claims_of_study, closest
from ...results.stored_study import parameters
from ..blocks import Block, Text
from ..tables import DataTable, Table, columns_of
from . import Section

SHOWN: Final = 4
_COLUMNS: Final = (
    "what", "document", "passage", "reference", "computed", "unit", "tolerance", "share", "kind",
    "verdict", "reason", "test",
)  # fmt: skip


def _rows(results: xr.Dataset) -> tuple[Claim, ...]:
    return claims_of_study(parameters(results))


def _blocks(results: xr.Dataset) -> list[Block]:
    rows = _rows(results)
    missed = sum(row.verdict == MISSED for row in rows)
    cells = tuple(
        (
            row.what,
            f"{row.document}, {row.passage}",
            rounding.significant(row.reference, 5),
            rounding.significant(row.computed, 5),
            row.unit,
            rounding.fixed(row.share),
        )
        for row in closest(rows, SHOWN)
    )
    head = ("Claim", "Reference from", "Reference", "Computed", "Unit", "Share of tolerance")
    return [
        Text(
            f"{len(rows)} of {len(claims())} tested claims of the software apply to this study. "
            f"{missed} of them disagree with the printed value; claims.csv has the reasons."
        ),
        Table(f"The {SHOWN} closest to their tolerance", head, cells, frozenset({0, 1, 4})),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    rows = ([getattr(row, name) for name in _COLUMNS] for row in _rows(results))
    return {"claims.csv": columns_of(_COLUMNS, rows)}


register(Section("claims", "Checks of the software", _blocks, position=96.0, tables=_data))
