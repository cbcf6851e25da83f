"""Which values were sampled, which were not and why, and how exact the samples are."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ....base.units import split_key
from ....results import labels
from ....results.stored_study import parameters
from ...bands import percent

_TABLES: Final = {"variation": "path through the shell", "structure": "shell"}
"""Plain words for tables; others go by their name."""


def sampled_sentences(results: xr.Dataset) -> list[str]:
    """Number of values that are sampled and that are not, and the error of projected modes."""
    ranges = parameters(results)["ranges"]
    count = f"{len(ranges)} values are" if len(ranges) > 1 else "One value is"
    texts = [f"{count} sampled by Latin hypercube.", held_sentence(results), _projection(results)]
    return [*filter(None, texts)]


def held_sentence(results: xr.Dataset) -> str:
    """Number of values that have a range and are not sampled."""
    held = parameters(results).get("held_ranges", ())
    if not held:
        return ""
    count = f"{len(held)} values with a range are" if len(held) > 1 else "One value with a range is"
    return f"{count} not sampled; inputs.csv gives ranges and reasons."


def named(name: str) -> str:
    """Plain words for a sampled value by its dotted name, without its unit."""
    table, _, field = name.rpartition(".")
    first, *parts = table.split(".")
    where = " ".join([_TABLES.get(first, first), *parts]).replace("_", " ")
    return f"{where} {labels.name(field).lower()}"


def with_unit(words: str, symbol: str) -> str:
    """Words for a value with its unit, if it has one."""
    return f"{words}, {symbol}" if symbol else words


def in_si(field: str) -> str:
    """Return the dotted name of a value in SI by its name in a file."""
    table, _, key = field.rpartition(".")
    stem, unit = split_key(key)
    return field if unit is None else f"{table}.{stem}_{unit.si_suffix}"


def file_unit(results: xr.Dataset, name: str) -> tuple[str, float]:
    """Symbol and factor to SI of the unit in which a file gives a sampled value; else SI."""
    for record in parameters(results).get("records", ()):
        unit = split_key(str(record["field"]).rpartition(".")[2])[1]
        if unit is not None and in_si(str(record["field"])) == name:
            return unit.symbol, unit.factor
    return labels.unit(name.rpartition(".")[2]), 1.0


def dotted(item: Mapping[str, Any]) -> str:
    """Return the dotted name of a range."""
    return f"{item['table']}.{item['field']}"


def _projection(results: xr.Dataset) -> str:
    """How far natural frequencies by projection are off."""
    if "projection_error" not in results:
        return ""
    errors = results["projection_error"]
    texts = [
        f"{named(str(name))} {percent(float(error))}"
        for name, error in zip(errors["uncertain_parameter"].values, errors.values, strict=True)
        if np.isfinite(error)
    ]
    if not texts:
        return ""
    return (
        "Wall and material change the modes by projection; largest error of a natural frequency: "
        f"{', '.join(texts)}."
    )
