"""A published table of scores beside the computed ones."""

import numpy as np
import xarray as xr

from ..base.vocabulary import check, stamp
from ..study.scoring import PublishedTable


def published_table(table: PublishedTable) -> xr.Dataset:
    """A published table of scores as printed, with its sums added up again."""
    options = {"published_option": list(table.options)}
    scores = np.array(table.scores, dtype=float)
    return check(
        xr.Dataset(
            {
                "published_score": stamp(
                    "published_score",
                    scores,
                    {**options, "published_criterion": list(table.criteria)},
                    source=table.source,
                ),
                "published_sum": stamp("published_sum", table.sums, options, source=table.source),
                "recomputed_sum": stamp("recomputed_sum", scores.sum(axis=1), options),
            }
        )
    )
