"""The report of a search of designs as one page."""

import json
from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...base import rounding
from ..blocks import Block, Bullets, Details, Pictures, Text
from ..figures.designs import front_figure, main_effects_figure, parallel_figure
from ..figures.style import Picture, png
from ..page import Page, Part
from ..study import parameters
from ..tables import Table
from .best import best_tables, limiting
from .evaluated import Column, Evaluated
from .reading import evaluated, variable_label

ABOUT = "Designs of the machine, what each objective costs the others, and what pieces will keep."


def designs_page(found: xr.Dataset) -> Page:
    """The page of a search.

    Parameters
    ----------
    found : dataset of a search of designs, with the study's parameters as attribute
    """
    designs = evaluated(found)
    study = parameters(found)
    parts = (
        Part("best", "The best few", tuple(_best(found, designs))),
        Part("front", "Front", tuple(_front(designs))),
        Part("deciding", "What decides", tuple(_deciding(found, designs))),
        Part("searched", "What was searched", tuple(_searched(found, designs))),
    )
    shown = tuple(part for part in parts if part.blocks)
    return Page(
        f"Designs: {study['title']}", study["machine"]["name"], found.attrs["created_utc"], shown, ABOUT
    )


def _best(found: xr.Dataset, designs: Evaluated) -> list[Block]:
    allowed = int(designs.met.sum())
    return [
        Text(_headline(found, designs), "headline"),
        *best_tables(found, designs),
        Bullets(tuple(limiting(found, designs))),
        Text(
            f"{designs.count} designs were evaluated, {allowed} meet every constraint"
            f"{_failed(found)}. As meant: a piece without tolerances. Promised: "
            f"{found.attrs['promise_draws']} fresh pieces, drawn after the search, with the 95 % "
            "limits that the number of draws alone leaves.",
            "note",
        ),
    ]


def _headline(found: xr.Dataset, designs: Evaluated) -> str:
    """What the first of the best few reaches, beside the machine without an option."""
    row = designs.best[0]
    values = ", ".join(
        f"{column.label} {column.cell(row)}{' ' + column.unit if column.unit else ''}"
        for column in designs.variables
    )
    reached = []
    for number, column in _aims(found, designs):
        promised = float(found["wanted_promised"].values[0, number])
        before = float(found["wanted_reference"].values[number])
        without = f" (without an option {rounding.fixed(before)})" if np.isfinite(before) else ""
        reached.append(f"{column.label}: {rounding.fixed(promised)} {column.unit}{without}")
    return f"Best design: {values}. It reaches {'; '.join(reached)}."


def _aims(found: xr.Dataset, designs: Evaluated) -> list[tuple[int, Column]]:
    """Numbers of the objectives among what is wanted, with their columns."""
    roles = found["wanted_role"].values
    numbers = [n for n, role in enumerate(roles) if role in ("least", "greatest")]
    return list(zip(numbers, designs.objectives, strict=True))


def _failed(found: xr.Dataset) -> str:
    reasons = json.loads(found.attrs["failures"])
    if not reasons:
        return ""
    count = sum(number for _, number in reasons)
    return f", {count} failed (most often: {reasons[0][0]})"


def _front(designs: Evaluated) -> list[Block]:
    if len(designs.objectives) < 2:
        return []
    pictures = (
        Picture(
            "front",
            "Objectives of all allowed designs and of the front; the best few are in the table.",
            f"Front of {int(designs.front.sum())} designs of which none is better in every "
            "objective than another; the numbers are those of the table.",
            png(front_figure(designs)),
        ),
        Picture(
            "parallel_coordinates",
            "A line for each design of the front over all variables and objectives.",
            "Parallel coordinates of the front: each scale goes from the least to the greatest "
            "value of the allowed designs.",
            png(parallel_figure(designs)),
        ),
    )
    return [Pictures(pictures)]


def _deciding(found: xr.Dataset, designs: Evaluated) -> list[Block]:
    effects = [_effect(designs, column, number) for number, (_, column) in
               enumerate(_aims(found, designs), 1)]  # fmt: skip
    first, *others = effects
    more = [Details("Main effects of the other objectives", (Pictures(tuple(others)),))]
    return [_shares(found), Pictures((first,)), *(more if others else [])]


def _effect(designs: Evaluated, column: Column, number: int) -> Picture:
    return Picture(
        f"main_effects_{number}",
        f"Median and middle 80 % of {column.label} over each variable.",
        f"{column.label} over each variable: median and middle 80 % of all designs that the search "
        "evaluated, which crowd where it is good.",
        png(main_effects_figure(designs, column)),
    )


def _shares(found: xr.Dataset) -> Table:
    """Share of each variable in the variance of each wanted value, and how good the fit is."""
    keys = [variable_label(str(key)) for key in found["design_variable"].values]
    rows = [
        (
            str(found["wanted_label"].values[number]),
            _ratio(float(found["design_share_quality"].values[number])),
            *(_ratio(float(share)) for share in found["design_share"].values[number]),
        )
        for number in range(found.sizes["wanted"])
    ]
    return Table(
        "Share of each variable alone in the variance over the design space; below Q² = 0.5 the "
        "shares are not to be trusted",
        ("Wanted", "Q²", *keys),
        tuple(rows),
    )


def _ratio(share: float) -> str:
    return f"{share:.2f}" if np.isfinite(share) else "–"


def _searched(found: xr.Dataset, designs: Evaluated) -> Sequence[Block]:
    low, high = found["design_low"].values, found["design_high"].values
    rows = []
    for number, column in enumerate(designs.variables):
        allowed = ", ".join(column.words) or f"{low[number]:.4g} to {high[number]:.4g}"
        rows.append((column.label, column.unit, allowed))
    variables = Table("Variables", ("Variable", "Unit", "Allowed"), tuple(rows), frozenset({0, 1, 2}))
    wanted = Table(
        "Objectives and constraints",
        ("Wanted", "Unit", "Role", "Limit"),
        tuple(
            (str(label), str(unit), str(role), "" if np.isnan(limit) else f"{limit:g}")
            for label, unit, role, limit in zip(
                *(found[f"wanted_{name}"].values for name in ("label", "unit", "role", "limit")),
                strict=True,
            )
        ),
        frozenset({0, 1, 2}),
    )
    return [variables, wanted, Text(found.attrs["method"], "note")]
