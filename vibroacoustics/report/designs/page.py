"""Analysis of a search of designs."""

import json
from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...results.stored_study import parameters
from ..analysis import Analysis, origin
from ..blocks import Block, Bullets, Details, Part, Pictures, Text
from ..sections.unknowns.tables import NOT_RESOLVED, share_words
from ..tables import Table
from .best import best_designs, best_tables, limiting, no_best, shown
from .csv import designs_data
from .evaluated import Column, Evaluated
from .figures import front_chart, main_effects_charts, parallel_chart
from .reading import evaluated, objectives_of, variable_label, variables_of


def analysis_of_designs(search: xr.Dataset) -> Analysis:
    """Return the analysis of a search.

    Parameters
    ----------
    search : dataset of a search of designs, with the study's parameters as attribute
    """
    designs, study = evaluated(search), parameters(search)
    reason = no_best(search)
    best: tuple[Block, ...] = () if reason else tuple(best_tables(search, designs))
    limits = () if reason else (Bullets(tuple(limiting(search, designs))),)
    best_data = {} if reason else {"best.csv": best_designs(designs)}
    unchanged = _sentence(search.attrs["no_change"]) if search.attrs["no_change"] else ""
    counts = Text(f"{designs.count} designs were evaluated, {designs.met.sum()} meet every "
                 f"constraint{_failed(search)}.", "note")  # fmt: skip
    promised = () if reason else (Text(_promised(search), "note"),)
    closing = (Text(unchanged),) if unchanged and not reason else ()
    parts = (
        Part("best", "The best few", (*best, *closing, *limits, counts, *promised)),
        Part("front", "Front", tuple(_front(designs))),
        Part("deciding", "What decides", tuple(_deciding(search))),
        Part("searched", "What was searched", tuple(_searched(search, designs))),
    )
    return Analysis(
        "designs",
        title=f"Designs: {study['title']}",
        kind=study["machine"]["name"],
        created=search.attrs["created_utc"],
        about="Designs, what each objective costs the others, and what built pieces will keep.",
        parts=tuple(part for part in parts if part.blocks),
        summary=(_sentence(reason) if reason else _headline(search, designs),),
        shown=(*best, *limits, *closing, Text(search.attrs["method"])),
        tables={"designs.csv": designs_data(search), **best_data},
        figures="figures/",
    )


def analysis_of_no_designs(swept: xr.Dataset) -> Analysis:
    """Return the analysis of a sweep in which no design meets the constraints."""
    words = "No design meets the constraints."
    part = Part("best", "The best few", (Text(words),))
    return Analysis("designs", about=words, parts=(part,), **origin(swept, "Designs"))


def _promised(search: xr.Dataset) -> str:
    """What the promised values are of."""
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
    """What the first of the best few promises, beside the machine without an option."""
    reached = []
    for number, column in _aims(search, designs):
        promised = shown(float(search["wanted_promised"].values[0, number]), column.unit)
        before = shown(float(search["wanted_reference"].values[number]), column.unit)
        reached.append(f"{column.label} {promised} {column.unit} (without an option {before})")
    return f"Design 1 promises {'; '.join(reached)}."


def _precision(search: xr.Dataset) -> str:
    """How far a promised value may be off for the number of samples, in decibels if it is one."""
    low, value, high = (search[f"wanted_promised{end}"].values for end in ("_low", "", "_high"))
    each = np.maximum(high - value, value - low).max(axis=0)
    units, names = search["wanted_unit"].values, search["wanted"].values
    return ", ".join(
        f"{name} ± {value:.2g} {unit}".rstrip()
        for name, unit, value in zip(names, units, each, strict=True)
        if value > 0.0
    )


def _aims(search: xr.Dataset, designs: Evaluated) -> list[tuple[int, Column]]:
    """Numbers of the objectives among what is wanted, with their columns."""
    roles = search["wanted_role"].values
    numbers = [n for n, role in enumerate(roles) if role in ("least", "greatest")]
    return list(zip(numbers, designs.objectives, strict=True))


def _failed(search: xr.Dataset) -> str:
    reasons = json.loads(search.attrs["failures"])
    if not reasons:
        return ""
    count = sum(number for _, number in reasons)
    return f", {count} failed (most often: {reasons[0][0]})"


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
        (str(name), *(share_words(search, "design_share", number, at) for at in range(len(keys))))
        for number, name in enumerate(search["wanted"].values)
    ]
    return Table(
        f"Share of each variable alone in the variance over the design space; "
        f"{NOT_RESOLVED}: no more than chance gives",
        ("Wanted", *keys),
        tuple(rows),
    )


def _searched(search: xr.Dataset, designs: Evaluated) -> Sequence[Block]:
    low, high = search["design_low"].values, search["design_high"].values
    rows = []
    for number, column in enumerate(designs.variables):
        allowed = ", ".join(column.words) or f"{low[number]:.4g} to {high[number]:.4g}"
        rows.append((column.label, column.unit, allowed))
    variables = Table(
        "Variables", ("Variable", "Unit", "Allowed"), tuple(rows), frozenset({0, 1, 2})
    )
    wanted = Table(
        "Objectives and constraints",
        ("Name", "What it is", "Unit", "Role", "Limit"),
        tuple(
            (str(name), str(label), str(unit), str(role), "" if np.isnan(limit) else f"{limit:g}")
            for name, label, unit, role, limit in zip(
                search["wanted"].values,
                *(search[f"wanted_{part}"].values for part in ("label", "unit", "role", "limit")),
                strict=True,
            )
        ),
        frozenset({0, 1, 2, 3}),
    )
    return [variables, wanted, Text(search.attrs["method"], "note")]
