"""Analysis of a search of designs."""

import json
from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.vocabulary import MEDIAN
from ...results.conditional import ConditionalClaim, stated
from ...results.number import Number
from ...results.stored_study import parameters
from ..analysis import Analysis, origin
from ..blocks import Block, Bullets, Details, Part, Pictures, Text
from ..conditions import promise_claim
from ..sections.unknowns import NOT_RESOLVED, share_words
from ..tables import Cell, DataTable, Table
from .evaluated import (
    Evaluated,
    designs_data,
    evaluated,
    heading,
    objectives_of,
    variable_label,
    variables_of,
)
from .figures import front_chart, main_effects_charts, parallel_chart

OF_TOTAL: Final = ("no_change", "lowering")
"""Attributes of a search with sentences on the total level."""
_AT_END = 1e-3
"""Share of a variable's range, or of a limit, that counts as at it."""


def analysis_of_designs(search: xr.Dataset) -> Analysis:
    """Return the analysis of a search.

    Parameters
    ----------
    search : dataset of a search of designs, with the study's parameters as attribute
    """
    designs, study = evaluated(search), parameters(search)
    reason = no_best(search)
    sentences = [search.attrs["lowering"]] if reason else [search.attrs[name] for name in OF_TOTAL]
    of_total = [Text(_sentence(words)) for words in sentences if words]
    evaluated_count, allowed = search.attrs["evaluated"], search.attrs["allowed"]
    counts = f"{evaluated_count} designs were evaluated, {allowed} meet every constraint"
    best: list[Block] = [Text(f"{counts}{_failed(search)}.", "note")]
    shown_best: list[Block] = [*of_total]
    tables = {"designs.csv": designs_data(search)}
    if not reason:
        first, limits = best_tables(search, designs), Bullets(tuple(limiting(search, designs)))
        shown_best = [*first, limits, *of_total]
        best = [*shown_best[:2], *of_total, limits, *best, Text(_promised(search), "note")]
        tables["best.csv"] = best_designs(designs)
    else:
        best = [*of_total, *best]
    parts = (
        Part("best", "The best few", tuple(best)),
        Part("front", "Front", tuple(_front(designs))),
        Part("deciding", "What decides", tuple(_deciding(search))),
        Part("searched", "What was searched", _searched(search, designs)),
    )
    return Analysis(
        "designs",
        title=f"Designs: {study['title']}",
        kind=study["machine"]["name"],
        created=search.attrs["created_utc"],
        about="Designs, what each objective costs the others, and what built pieces will keep.",
        parts=tuple(part for part in parts if part.blocks),
        summary=(_sentence(reason) if reason else _headline(search, designs),),
        claims=(_claim(search, designs, not reason),),
        shown=(*shown_best, Text(search.attrs["method"])),
        tables=tables,
        figures="figures/",
    )


def analysis_of_no_designs(swept: xr.Dataset) -> Analysis:
    """Return the analysis of a sweep in which no design meets the constraints."""
    words = "No design meets the constraints."
    part = Part("best", "The best few", (Text(words),))
    claims = (promise_claim((), False, True),)
    return Analysis(
        "designs", about=words, parts=(part,), claims=claims, **origin(swept, "Designs")
    )


def _promised(search: xr.Dataset) -> str:
    """Say which statistic the promised values are."""
    count = search.attrs["promise_samples"]
    if search.attrs["is_sampled"]:
        return (
            f"Promised: {count} samples of the machine with fresh pieces, not seen by the search; "
            "the interval holds 80 % of them."
        )
    return (
        f"Promised: {count} fresh pieces, not seen by the search; 95 % limits of the number of "
        f"pieces alone: {_precision(search) or 'none, nothing scatters'}."
    )


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


def _headline(search: xr.Dataset, designs: Evaluated) -> str:
    """Say what the first of the best few promises, beside the machine without an option."""
    return f"Design 1 promises {stated(_claim(search, designs, True))}."


def _claim(search: xr.Dataset, designs: Evaluated, is_allowed: bool) -> ConditionalClaim:
    """Promise of the first of the best few."""
    reached = _promised_values(search, designs) if is_allowed else []
    return promise_claim(reached, is_allowed, bool(search.attrs["is_sampled"]))


def _promised_values(search: xr.Dataset, designs: Evaluated) -> list[str]:
    """Value of each objective of the first of the best few, and without an option."""
    reached = []
    roles = search["wanted_role"].values
    aims = [number for number, role in enumerate(roles) if role in ("least", "greatest")]
    for number, column in zip(aims, designs.objectives, strict=True):
        promised = shown(float(search["wanted_promised"].values[0, number]), column.unit)
        before = shown(float(search["wanted_reference"].values[number]), column.unit)
        reached.append(f"{column.label} {promised} {column.unit} (without an option {before})")
    return reached


def _precision(search: xr.Dataset) -> str:
    """Say how far a promised value may be off for the number of samples, in decibels if it is
    one."""
    low, value, high = (search[f"wanted_promised{end}"].values for end in ("_low", "", "_high"))
    each = np.maximum(high - value, value - low).max(axis=0)
    units, names = search["wanted_unit"].values, search["wanted"].values
    return ", ".join(
        f"{name} ± {value:.2g} {unit}".rstrip()
        for name, unit, value in zip(names, units, each, strict=True)
        if value > 0.0
    )


def _failed(search: xr.Dataset) -> str:
    reasons = json.loads(search.attrs["failures"])
    count = sum(number for _, number in reasons)
    return f", {count} failed (most often: {reasons[0][0]})" if reasons else ""


def _front(designs: Evaluated) -> list[Block]:
    if len(designs.objectives) < 2:
        return []
    return [Pictures((front_chart(designs), parallel_chart(designs)))]


def _deciding(search: xr.Dataset) -> list[Block]:
    variables = variables_of(search, "spread_value")
    first, *others = [
        Pictures(tuple(main_effects_charts(variables, column, number)))
        for number, column in enumerate(objectives_of(search, "spread_wanted"), 1)
    ]
    more = [Details("Main effects of the other objectives", tuple(others))]
    return [_shares(search), first, *(more if others else [])]


def _shares(search: xr.Dataset) -> Table:
    """Share of each variable in the variance of each wanted value, where chance gives less."""
    keys = [variable_label(str(key)) for key in search["design_variable"].values]
    rows = [
        (
            str(name),
            *(
                share_words(search, "design_share", number, number_of_key)
                for number_of_key in range(len(keys))
            ),
        )
        for number, name in enumerate(search["wanted"].values)
    ]
    caption = (
        "Share of each variable alone in the variance over the design space; "
        f"{NOT_RESOLVED}: no more than chance gives"
    )
    return Table(caption, ("Wanted", *keys), tuple(rows))


def _searched(search: xr.Dataset, designs: Evaluated) -> tuple[Block, ...]:
    ends = zip(search["design_low"].values, search["design_high"].values, strict=True)
    allowed = [
        (column.label, column.unit, ", ".join(column.words) or f"{low:.4g} to {high:.4g}")
        for column, (low, high) in zip(designs.variables, ends, strict=True)
    ]
    head = ("Variable", "Unit", "Allowed")
    variables = Table("Variables", head, tuple(allowed), frozenset({0, 1, 2}))
    names = ("wanted", "wanted_label", "wanted_unit", "wanted_role", "wanted_limit")
    wanted = [
        (*map(str, words), "" if np.isnan(limit) else f"{limit:g}")
        for *words, limit in zip(*(search[name].values for name in names), strict=True)
    ]
    return (
        variables,
        Table("Objectives and constraints", ("Name", "What it is", "Unit", "Role", "Limit"),
              tuple(wanted), frozenset({0, 1, 2, 3})),
        Text(search.attrs["method"], "note"),
    )  # fmt: skip


def best_tables(search: xr.Dataset, designs: Evaluated) -> Iterator[Table]:
    """Values of the best few, and what they reach as meant and as promised."""
    numbers = [str(number) for number, _ in enumerate(designs.best, 1)]
    values = [(each.heading, *map(each.cell, designs.best)) for each in designs.variables]
    yield Table("The best few designs", ("Variable", *numbers), tuple(values))
    reached = [row for number in range(search.sizes["wanted"]) for row in _reached(search, number)]
    caption = "What they reach, as meant and as promised, beside the machine without an option"
    yield Table(caption, ("Wanted", "", "without", *numbers), tuple(reached), frozenset({0, 1}))


def best_designs(designs: Evaluated) -> DataTable:
    """Return the variables of the best few; `row` counts the rows of `designs.csv` from 0."""
    columns = {each.label: [*map(each.cell, designs.best)] for each in designs.variables}
    rows = designs.best.tolist()
    return {"design": list(range(1, len(rows) + 1)), "row": rows, **columns}


def _reached(search: xr.Dataset, number: int) -> Iterator[tuple[Cell, ...]]:
    """A wanted value as meant and as promised."""
    unit = str(search["wanted_unit"].values[number])
    name = heading(str(search["wanted"].values[number]), unit)
    before = shown(float(search["wanted_reference"].values[number]), unit)
    as_meant = search["wanted_as_meant"].values[:, number]
    yield (name, "as meant", before, *(shown(float(value), unit) for value in as_meant))
    yield (name, "promised", before, *_promised_numbers(search, number, unit))
    if search.attrs["is_sampled"]:
        ends = (search[f"wanted_promised_{end}"].values[:, number] for end in ("low", "high"))
        each = (
            f"{shown(low, unit)} to {shown(high, unit)}" for low, high in zip(*ends, strict=True)
        )
        yield (name, "80 % interval", "", *each)


def _promised_numbers(search: xr.Dataset, number: int, unit: str) -> Iterator[Number]:
    ends = (search[f"wanted_promised{end}"].values[:, number] for end in ("", "_low", "_high"))
    for design, (value, low, high) in enumerate(zip(*ends, strict=True), 1):
        selection = {"design": design, "wanted": str(search["wanted"].values[number])}
        yield Number(
            float(value), unit, "wanted_promised", selection, MEDIAN, float(low), float(high),
            shown(float(value), unit),
        )  # fmt: skip


def no_best(search: xr.Dataset) -> str:
    """Return the sentence in place of the best designs; empty where they are listed.

    Every objective is a total level, and no design changes it by what could be measured.
    """
    return str(search.attrs["no_change"]) if search.attrs["only_totals"] else ""


def shown(value: float, unit: str) -> str:
    """A number with as many digits as it means: decibels with two decimals, others with four."""
    if not np.isfinite(value):
        return "–"
    return rounding.fixed(value, 2) if unit.startswith("dB") else f"{value:.4g}"


def limiting(search: xr.Dataset, designs: Evaluated) -> Iterator[str]:
    """Yield the limits of each of the best few: constraints that it just meets, ends of ranges."""
    low, high = search["design_low"].values, search["design_high"].values
    for rank, row in enumerate(designs.best, 1):
        reasons = []
        for number, column in enumerate(designs.variables):
            value, span = float(column.values[row]), high[number] - low[number]
            if column.words or np.isnan(value) or span <= 0.0:
                continue
            if value - low[number] < _AT_END * span:
                reasons.append(f"{column.label} is the least allowed")
            elif high[number] - value < _AT_END * span:
                reasons.append(f"{column.label} is the greatest allowed")
        reasons += _met_just(search, int(row))
        yield f"Design {rank}: " + ("; ".join(reasons) or "nothing limits it") + "."


def _met_just(search: xr.Dataset, row: int) -> Iterator[str]:
    for number, role in enumerate(search["wanted_role"].values):
        limit = float(search["wanted_limit"].values[number])
        if np.isnan(limit):
            continue
        value = float(search["wanted_value"].values[row, number])
        if abs(value - limit) <= 10.0 * _AT_END * max(abs(limit), 1e-12):
            unit = str(search["wanted_unit"].values[number])
            yield f"{search['wanted'].values[number]} is just {role} {limit:g} {unit}".rstrip()
