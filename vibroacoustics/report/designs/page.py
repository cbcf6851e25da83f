"""The report of a search of designs as one page."""

import json
from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...results.stored_study import parameters
from ..blocks import Block, Bullets, Details, Pictures, Text
from ..html import html
from ..page import Page, Part
from ..sections.unknowns.tables import NOT_RESOLVED, share_words
from ..tables import Table, to_text
from .best import best_tables, limiting, no_best, shown
from .csv import designs_csv
from .evaluated import Column, Evaluated
from .figures import front_chart, main_effects_charts, parallel_chart
from .reading import evaluated, objectives_of, variable_label, variables_of

_ENDS: Final = ("_low", "", "_high")
ABOUT: Final = "Designs, what each objective costs the others, and what built pieces will keep."


def designs_page(search: xr.Dataset) -> Page:
    """The page of a search.

    Parameters
    ----------
    search : dataset of a search of designs, with the study's parameters as attribute
    """
    designs = evaluated(search)
    study = parameters(search)
    parts = (
        Part("best", "The best few", tuple(_best(search, designs))),
        Part("front", "Front", tuple(_front(designs))),
        Part("deciding", "What decides", tuple(_deciding(search))),
        Part("searched", "What was searched", tuple(_searched(search, designs))),
    )
    shown = tuple(part for part in parts if part.blocks)
    return Page(
        f"Designs: {study['title']}",
        study["machine"]["name"],
        search.attrs["created_utc"],
        shown,
        ABOUT,
    )


def render_designs(search: xr.Dataset) -> dict[str, bytes]:
    """Files of the report of a search, by name."""
    page = designs_page(search)
    return {
        "designs.html": html(page),
        "designs.csv": designs_csv(search),
        **{file: picture.content for file, picture in page.pictures().items()},
    }


def designs_text(search: xr.Dataset) -> str:
    """The best few for a terminal."""
    if no_best(search):
        return f"{no_best(search)}\n{search.attrs['method']}"
    designs = evaluated(search)
    tables = [to_text(table, 60) for table in best_tables(search, designs)]
    said = [search.attrs["no_change"]] if search.attrs["no_change"] else []
    return "\n".join([*tables, *limiting(search, designs), *said, search.attrs["method"]])


def designs_json(search: xr.Dataset) -> str:
    """The best few, or why there are none, as JSON."""
    said, designs = no_best(search), evaluated(search)
    best = [
        {
            "variables": {one.label: one.cell(row) for one in designs.variables},
            "wanted": {
                str(name): dict(zip(("low", "value", "high"), ends, strict=True))
                for name, *ends in zip(
                    search["wanted"].values,
                    *(search[f"wanted_promised{end}"].values[rank].tolist() for end in _ENDS),
                    strict=True,
                )
            },
        }
        for rank, row in enumerate(designs.best)
    ]
    return json.dumps({
        "no_change": search.attrs["no_change"],
        "best": [] if said else best,
        "method": search.attrs["method"],
    }, indent=1)  # fmt: skip


def _best(search: xr.Dataset, designs: Evaluated) -> list[Block]:
    allowed = int(designs.met.sum())
    if no_best(search):
        count = f"{designs.count} designs were evaluated, {allowed} meet every constraint."
        return [Text(_sentence(no_best(search)), "headline"), Text(count, "note")]
    said = [Text(_sentence(search.attrs["no_change"]), "note")] if search.attrs["no_change"] else []
    return [
        Text(_headline(search, designs), "headline"),
        *best_tables(search, designs),
        *said,
        Bullets(tuple(limiting(search, designs))),
        Text(
            f"{designs.count} designs were evaluated, {allowed} meet every constraint"
            f"{_failed(search)}. As meant: a piece without tolerances. {_promised(search)}",
            "note",
        ),
    ]


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
