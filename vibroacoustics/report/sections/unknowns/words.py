"""Which values were sampled, which were not and why, and how exact the samples are."""

from collections.abc import Iterable
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
    """Values sampled, those sampled apart from what they follow from, projection, values held."""
    ranges = parameters(results)["ranges"]
    count = f"{len(ranges)} values are" if len(ranges) > 1 else "One value is"
    texts = [
        f"{count} sampled from their ranges by Latin hypercube: {_listed(ranges)}.",
        _independent(ranges),
        _projection(results),
        held_sentence(results),
    ]
    return [*filter(None, texts)]


def held_sentence(results: xr.Dataset) -> str:
    """Values that have a range and are not sampled, with their ranges and the reasons."""
    by_reason: dict[str, list[str]] = {}
    for item in parameters(results).get("held_ranges", ()):
        by_reason.setdefault(item["reason"], []).append(_with_range(item))
    if not by_reason:
        return ""
    texts = [f"{', '.join(items)}, which {reason}" for reason, items in by_reason.items()]
    return f"Not sampled, though they have a range: {'; '.join(texts)}."


def _listed(ranges: Iterable[dict[str, Any]]) -> str:
    tables: dict[str, list[str]] = {}
    for item in ranges:
        tables.setdefault(item["table"], []).append(labels.name(item["field"]).lower())
    return "; ".join(f"{_table(name)}: {', '.join(fields)}" for name, fields in tables.items())


def _table(dotted: str) -> str:
    first, *rest = dotted.split(".")
    return " ".join([_TABLES.get(first, first), *rest]).replace("_", " ")


def named(dotted: str) -> str:
    """Plain words for a sampled value by its dotted name, without its unit."""
    table, _, field = dotted.rpartition(".")
    return f"{_table(table)} {labels.name(field).lower()}"


def file_unit(results: xr.Dataset, dotted: str) -> tuple[str, float]:
    """Symbol and factor to SI of the unit in which a file gives a sampled value; else SI."""
    for record in parameters(results).get("records", ()):
        table, _, key = str(record["field"]).rpartition(".")
        stem, unit = split_key(key)
        if unit is not None and f"{table}.{stem}_{unit.si_suffix}" == dotted:
            return unit.symbol, unit.factor
    return labels.unit(dotted.rpartition(".")[2]), 1.0


def _with_range(item: dict[str, Any]) -> str:
    unit = labels.unit(item["field"])
    limits = f"{item['lowest']:.4g} to {item['highest']:.4g}"
    return f"{named(_dotted(item))} ({limits}{f' {unit}' if unit else ''})"


def _dotted(item: dict[str, Any]) -> str:
    return f"{item['table']}.{item['field']}"


def _independent(ranges: Iterable[dict[str, Any]]) -> str:
    texts = [
        f"{named(_dotted(item))} ({', '.join(map(named, sources))})"
        for item in ranges
        if (sources := item.get("independent_of"))
    ]
    if not texts:
        return ""
    return (
        "Sampled apart from what it follows from, in brackets, because the machine's file gives "
        f"both a range: {'; '.join(texts)}."
    )


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
        "Wall and material change the modes by projection on the shapes as given. Against modes "
        "computed anew at the ends of the range a natural frequency is off by at most: "
        f"{', '.join(texts)}; modulus and density are exact."
    )
