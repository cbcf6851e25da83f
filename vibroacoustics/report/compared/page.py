"""Analysis of two results beside each other."""

from collections.abc import Sequence
from typing import Final

import xarray as xr

from ...results.figure_limits import CheckedFigure, Compared
from ...results.mean_of_runs import runs_of
from ...results.validation import (
    AGREES,
    COVERAGE,
    DIFFERS,
    FORCE_TOLERANCE,
    LEVEL_TOLERANCE_DB,
    Validation,
)
from ..analysis import Analysis
from ..bands import percent
from ..blocks import Block, Bullets, Details, Part, Pictures, Text
from ..figures.channel_orders import compared_order_charts, order_differences
from ..limit_tables import limits_data, limits_words, order_limits_table
from ..sections.evidence.tables import validation_table
from ..tables import Table
from .levels import levels_tables
from .limits import figure_limits_data, limit_blocks, limits_sentence
from .order_rows import compared_data, compared_facts, matching_orders
from .orders import is_pressure, known_channels, orders_table, summary
from .over_speed import channel_charts, over_speed_parts
from .studies import inputs_table, key_figures
from .validation import is_study, validations_of

MOST_ROWS: Final = 40
"""Of a table that is not folded."""


def analysis_of_comparison(compared: Compared, figures: Sequence[CheckedFigure]) -> Analysis:
    """Return the comparison of two results.

    Parameters
    ----------
    compared : two results, with what limits of orders say
    figures : other figures that have a limit
    """
    orders = compared.orders
    parts = [
        Part("verdict", "What comes out", tuple(_verdict(compared, figures))),
        *_limits(compared, figures),
        *_figures_of_studies(compared),
        *over_speed_parts(compared),
        *_validation(compared),
        Part("orders", "Orders", tuple(_orders(orders))),
        *_levels(compared),
        *_runs(compared),
        *_inputs(compared),
        Part("results", "The two results", (_results(compared),)),
    ]
    shown: list[Block] = [Bullets(tuple(compared_facts(orders))), matching_orders(orders)]
    tables = {"compared_orders.csv": compared_data(orders)}
    if "order_limit" in orders:
        tables["compared_orders_limits.csv"] = limits_data(orders)
        shown += [order_limits_table(orders), *map(Text, limits_words(orders))]
    if figures:
        tables["compared_figures_limits.csv"] = figure_limits_data(figures)
    return Analysis(
        "compared",
        title="Comparison",
        kind=f"{orders.attrs['first']}; {orders.attrs['second']}",
        created=str(orders.attrs["created_utc"]),
        about="Two results beside each other: A is the reference, differences are B less A.",
        parts=tuple(parts),
        shown=tuple(shown),
        tables=tables,
    )


def _verdict(compared: Compared, figures: Sequence[CheckedFigure]) -> list[Block]:
    blocks: list[Block] = []
    if figures or "order_limit" in compared.orders:
        blocks.append(Text(limits_sentence(compared.orders, figures), "headline"))
    blocks.append(Text(summary(compared.orders), "strong"))
    validations = validations_of(compared)
    return [*blocks, Text(_agreement(validations))] if validations else blocks


def _agreement(validations: Sequence[Validation]) -> str:
    agree, differ = (
        sum(each.verdict == word for each in validations) for word in (AGREES, DIFFERS)
    )
    known = sum(each.uncertainty > 0.0 for each in validations)
    return (
        f"Of {len(validations)} figures of the study beside the recordings {agree} agree within "
        f"{LEVEL_TOLERANCE_DB:g} dB or {percent(FORCE_TOLERANCE)} and {differ} differ by more than "
        f"{COVERAGE:g} times the validation uncertainty; it is known, in part at least, of {known}."
    )


def _limits(compared: Compared, figures: Sequence[CheckedFigure]) -> list[Part]:
    if not figures and "order_limit" not in compared.orders:
        return []
    return [Part("limits", "Limits", tuple(limit_blocks(compared.orders, figures)))]


def _figures_of_studies(compared: Compared) -> list[Part]:
    if not (is_study(compared.first) and is_study(compared.second)):
        return []
    return [Part("figures", "Key figures", (key_figures(compared),))]


def _validation(compared: Compared) -> list[Part]:
    validations = validations_of(compared)
    if not validations:
        return []
    note = (
        "E = S − D; u is the root of the sum of squares of u_num (grids of the radiation), u_input "
        "(spread of the samples; of levels in all) and u_D (scatter of the runs and specimens), in "
        "the form of ASME V&V 20. What is not known counts as zero, so u is a lower limit."
    )
    table: Block = validation_table("The study beside the recordings", validations)
    if len(validations) > MOST_ROWS:
        table = Details(f"All {len(validations)} figures", (table,))
    return [Part("validation", "Validation", (Text(note, "note"), table))]


def _orders(orders: xr.Dataset) -> list[Block]:
    channels = known_channels(orders)
    if not channels:
        return [Text(summary(orders))]
    drawn = dict(zip(_drawn_channels(orders), compared_order_charts(orders), strict=True))
    loud = dict(zip(map(str, orders["channel"].values), is_pressure(orders), strict=True))
    first = [name for name in channels if loud[name]] or channels[:1]
    blocks: list[Block] = [Pictures((order_differences(orders),))]
    for name in channels:
        pictures_of = (*(channel_charts(orders, name) if name in first else ()), drawn[name])
        of_channel: tuple[Block, ...] = (orders_table(orders, name), Pictures(pictures_of))
        blocks += of_channel if name in first else [Details(name, of_channel)]
    return blocks


def _drawn_channels(orders: xr.Dataset) -> list[str]:
    """Channels that have a picture, in their order in the dataset."""
    known = orders["order_difference"].notnull().any(("speed", "order")).values
    return [str(name) for name in orders["channel"].values[known]]


def _levels(compared: Compared) -> list[Part]:
    tables = levels_tables(compared)
    return [Part("levels", "Levels", tuple(tables))] if tables else []


def _runs(compared: Compared) -> list[Part]:
    runs = runs_of(compared.orders)
    if not runs:
        return []
    rows = [(str(number), run["file"], run["specimen"]) for number, run in enumerate(runs, 1)]
    note = (
        "Means are energy means over the runs of each specimen and then over the specimens. "
        "Deviations are of levels: between runs of one specimen, and between specimens without "
        "what the runs scatter; where each specimen ran once, the two cannot be told apart. The "
        "uncertainty of the mean of one specimen holds for that specimen alone."
    )
    table = Table("Runs", ("Run", "Recording", "Specimen"), tuple(rows), frozenset({0, 1, 2}))
    return [Part("runs", "Runs and specimens", (Text(note, "note"), table))]


def _inputs(compared: Compared) -> list[Part]:
    if not (is_study(compared.first) and is_study(compared.second)):
        return []
    return [Part("inputs", "What differs in the inputs", (inputs_table(compared),))]


def _results(compared: Compared) -> Table:
    rows = [
        (
            letter,
            str(result.attrs.get("title", "")),
            option if is_study(result) else "",
            ", ".join(f"{speed:.0f}" for speed in result["speed"].values[:6]),
            str(result.attrs.get("created_utc", "")),
            str(result.attrs.get("software_version", "")),
        )
        for letter, result, option, _ in compared.sides()
    ]
    head = ("Result", "Title", "Option", "Speeds, rpm", "Computed (UTC)", "Version")
    return Table("Where they come from", head, tuple(rows), frozenset(range(6)))
