"""The figures that the options report of themselves."""

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.vocabulary import REFERENCE_OPTION
from ....results import labels
from ....results.stored_study import balancers, speeds, words
from ...tables import Table


def facts_table(results: xr.Dataset) -> Table | None:
    """One row per figure of the machine or an option, one column per speed; None without any."""
    known = words(results)
    facts = results["reported_figure"].transpose("option", "figure", "speed")
    kept = [name not in known["source_figures"] for name in facts["figure"].values]
    facts = facts.isel(figure=kept)
    rows = tuple(
        (
            option,
            labels.name(str(fact), known),
            labels.unit(str(fact), known) or "1",
            *(rounding.significant(value) for value in values),
        )
        for option in [REFERENCE_OPTION, *balancers(results)]
        for fact, values in zip(
            facts["figure"].values, facts.sel(option=option).values, strict=True
        )
        if np.isfinite(values).any() and (option, fact) != (REFERENCE_OPTION, "added_mass_kg")
    )
    head = ("Option", "Figure", "Unit", *(f"At {speed:g} rpm" for speed in speeds(results)))
    return (
        Table("Figures of the machine (none) and of the options", head, rows, frozenset({0, 1, 2}))
        if rows
        else None
    )
