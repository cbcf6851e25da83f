"""Words of machine and options, kept with the results: a report needs neither to be there."""

from typing import Any

import numpy as np
import xarray as xr

from ..mechanics.rotation import Array
from ..parameters.study import Study


def words(study: Study, results: xr.Dataset) -> dict[str, Any]:
    """What machine and options say of themselves, as JSON values.

    Parameters
    ----------
    study : with machine and options
    results : with their reported figures
    """
    inner_sources = study.inside is not None
    options = study.options.items()
    left_out = [
        *study.machine.leaves_out(inner_sources),
        *(text for _, option in options for text in option.leaves_out(inner_sources)),
    ]
    labels = dict(study.machine.labels)
    for _, option in options:
        labels |= option.labels
    return {
        "axes": study.machine.axes,
        "orders": study.machine.orders,
        "leaves_out": list(dict.fromkeys(left_out)),
        "labels": labels,
        "sentences": {
            name: list(option.sentences(_figures(results, name))) for name, option in options
        },
    }


def _figures(results: xr.Dataset, option: str) -> dict[str, Array]:
    """Reported figures of an option, each over the speeds at which it has one."""
    table = results["option_fact"].sel(option=option).transpose("fact", "speed")
    return {
        str(name): row[np.isfinite(row)]
        for name, row in zip(table["fact"].values, table.values, strict=True)
        if np.isfinite(row).any()
    }
