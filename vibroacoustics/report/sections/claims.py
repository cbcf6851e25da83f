"""Claims of the software that a study leans on: computed values beside references."""

from collections import Counter
from typing import Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...results.claims import MISSED, Claim, claims, claims_of_study, closest
from ...results.stored_study import parameters
from ..blocks import Block, Text
from ..tables import DataTable, Table, columns_of
from . import Section

SHOWN: Final = 10
_COLUMNS: Final = (
    "what", "document", "passage", "reference", "computed", "unit", "tolerance", "share", "kind",
    "verdict", "reason", "test",
)  # fmt: skip


def _rows(results: xr.Dataset) -> tuple[Claim, ...]:
    return claims_of_study(parameters(results))


def _blocks(results: xr.Dataset) -> list[Block]:
    rows = _rows(results)
    kinds = Counter(row.kind for row in rows)
    counts = ", ".join(f"{number} {kind}" for kind, number in kinds.most_common())
    missed = sum(row.verdict == MISSED for row in rows)
    cells = tuple(
        (
            row.what,
            f"{row.document}, {row.passage}",
            rounding.significant(row.reference, 4),
            rounding.significant(row.computed, 4),
            row.unit,
            rounding.fixed(row.share),
        )
        for row in closest(rows, SHOWN)
    )
    head = ("Claim", "Reference from", "Reference", "Computed", "Unit", "Share")
    return [
        Text(
            f"This study depends on {len(rows)} of {len(claims())} claims of the software that its "
            f"tests check ({counts}); {missed} are known misses."
        ),
        Table(f"The {SHOWN} closest to their tolerance", head, cells, frozenset({0, 1, 4})),
        Text("Share: distance in tolerances. All are in claims.csv, with their tests.", "note"),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    rows = ([getattr(row, name) for name in _COLUMNS] for row in _rows(results))
    return {"claims.csv": columns_of(_COLUMNS, rows)}


register(Section("claims", "Checks of the software", _blocks, position=96.0, tables=_data))
