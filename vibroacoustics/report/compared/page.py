"""Analysis of two results beside each other, with their tones and rating levels."""

from collections.abc import Iterator, Sequence
from typing import Final

import xarray as xr

from ...base import rounding
from ...results.bands import percent
from ...results.estimates import Estimate
from ...results.figure_limits import CheckedFigure, Compared
from ...results.mean_of_runs import runs_of
from ...results.rating_changes import RatingChange, rating_changes
from ...results.validation import (
    AGREES,
    COVERAGE,
    DIFFERS,
    FORCE_TOLERANCE,
    LEVEL_TOLERANCE_DB,
    Validation,
)
from ..analysis import Analysis
from ..blocks import Block, Bullets, Details, Part, Pictures, Text
from ..charts.marks import Chart
from ..conditions import coherence_claim
from ..figures.campbell import campbell
from ..figures.channel_orders import compared_order_charts, order_differences
from ..figures.levels_over_speed import levels_over_speed
from ..figures.orders_over_speed import orders_over_speed
from ..limit_tables import (
    figure_limits_data,
    limit_blocks,
    limits_data,
    limits_sentence,
    limits_words,
    order_limits_table,
)
from ..operating_points import shown_speeds
from ..sections.evidence import validation_table
from ..shown_speeds import FEWEST_OVER_SPEED, over_speed
from ..tables import DataTable, Table, columns_of
from .orders import (
    compared_data,
    compared_facts,
    is_pressure,
    known_channels,
    matching_orders,
    orders_table,
    summary,
)
from .studies import inputs_table, key_figures
from .validation import is_study, levels_tables, validations_of

_WORDS: Final = {
    "decisive_audibility": ("Audibility of tones at {}", "dB", 1.0),
    "tonal_adjustment": ("K_T (ISO 1996-2) at {}", "dB", 1.0),
    "rating_level": ("Rating level at {}", "dB(A)", 1.0),
    "rating_adjustment": ("K_T in the rating level at {}", "dB", 1.0),
    "rating_limit": ("Limit at {}", "dB(A)", 1.0),
    "limit_probability": ("Limit met at {}", "%", 100.0),
}
"""Words of each variable, its unit and its factor."""
_IN_STEPS: Final = ("tonal_adjustment", "rating_adjustment")


def shown_changes(compared: Compared) -> list[RatingChange]:
    """Return tones and rating levels of two studies at the speeds that the page shows."""
    return rating_changes(compared, sorted(shown_speeds(compared.orders)))


def ratings_table(changes: Sequence[RatingChange]) -> Table | None:
    """Return tones and rating levels of both; None without them."""
    rows = tuple(
        (
            words.format(change.label),
            f"{change.speed_rpm:.0f}",
            _text(change, change.first, factor),
            _text(change, change.second, factor),
            _text(change, change.change, factor, signed=True),
            unit,
        )
        for change in changes
        for words, unit, factor in [_WORDS[change.variable]]
    )
    head = ("Figure", "rpm", "A", "B", "B − A", "Unit")
    return Table("Tones and rating level of both", head, rows, frozenset({0, 5})) if rows else None


def ratings_data(changes: Sequence[RatingChange]) -> DataTable:
    """Return all values with their 80 % intervals."""
    parts = ("first", "second", "change")
    head = [f"{part}{end}" for part in parts for end in ("_10_percent", "", "_90_percent")]
    rows = [
        (change.variable, change.label, change.speed_rpm, *change.first, *change.second,
         *change.change)
        for change in changes
    ]  # fmt: skip
    return columns_of(("quantity", "microphone_or_window", "speed_rpm", *head), rows)


def ratings_sentences(changes: Sequence[RatingChange]) -> tuple[str, ...]:
    """Say how the rating level at each window changes, and how likely both meet the limit."""
    by_case = {(change.variable, change.label, change.speed_rpm): change for change in changes}
    return tuple(
        f"The rating level at {level.label}, {level.speed_rpm:.0f} rpm, changes by "
        f"{_text(level, level.change, signed=True)} dB from A to B; "
        f"{_limit(by_case['rating_limit', *level[1:3]])} met with "
        f"{_percent(chance.first)} probability in A, {_percent(chance.second)} in B."
        for level in changes
        if level.variable == "rating_level"
        for chance in [by_case["limit_probability", *level[1:3]]]
    )


def _limit(limit: RatingChange) -> str:
    a, b = (f"{value.value:g} dB(A)" for value in (limit.first, limit.second))
    return f"limit {a}" if a == b else f"limits {a} and {b}"


def _percent(share: Estimate) -> str:
    return f"{rounding.fixed(100.0 * share.value, 0)}\u00a0%"


def _text(change: RatingChange, value: Estimate, factor: float = 1.0, signed: bool = False) -> str:
    """`44.2 (40.1 to 47.0)`, or the value alone where it has no interval."""
    decimals = 0 if change.variable in (*_IN_STEPS, "limit_probability") else 1
    write = rounding.signed if signed else rounding.fixed
    low, middle, high = (write(factor * part, decimals) for part in value)
    return middle if low == high else f"{middle} ({low} to {high})"


MOST_ROWS: Final = 40
"""Most rows of a table that is not folded."""


def analysis_of_comparison(compared: Compared, figures: Sequence[CheckedFigure]) -> Analysis:
    """Return the comparison of two results.

    Parameters
    ----------
    compared : two results, with what limits of orders say
    figures : other figures that have a limit
    """
    orders, validations = compared.orders, validations_of(compared)
    of_studies = is_study(compared.first) and is_study(compared.second)
    inputs, key = (inputs_table(compared), key_figures(compared)) if of_studies else (None, None)
    rated = shown_changes(compared)
    ratings, sentences = ratings_table(rated), list(map(Text, ratings_sentences(rated)))
    parts = (
        _part(
            "verdict", "What comes out", *_verdict(compared, figures, validations), *sentences[:1]
        ),
        _part("limits", "Limits", *limit_blocks(orders, figures)),
        _part("figures", "Key figures", key),
        _part("rating", "Tones and rating level", *sentences, ratings),
        *over_speed_parts(compared),
        _part("validation", "Validation", *_validation(validations)),
        _part("orders", "Orders", *_orders(orders)),
        _part("levels", "Levels", *levels_tables(compared)),
        _part("runs", "Runs and specimens", *_runs(orders)),
        _part("inputs", "What differs in the inputs", inputs),
        _part("results", "The two results", _results(compared)),
    )
    shown: list[Block] = [Bullets(tuple(compared_facts(orders))), matching_orders(orders)]
    tables = {"compared_orders.csv": compared_data(orders)}
    if "order_limit" in orders:
        tables["compared_orders_limits.csv"] = limits_data(orders)
        shown += [order_limits_table(orders), *map(Text, limits_words(orders))]
    if ratings is not None:
        tables["compared_rating.csv"] = ratings_data(rated)
        shown += [ratings, *sentences]
    if figures:
        tables["compared_figures_limits.csv"] = figure_limits_data(figures)
    return Analysis(
        "compared",
        title="Comparison",
        kind=f"{orders.attrs['first']}; {orders.attrs['second']}",
        created=str(orders.attrs["created_utc"]),
        about="Two results beside each other: A is the reference, differences are B less A.",
        parts=tuple(part for part in parts if part.blocks),
        shown=tuple(shown),
        tables=tables,
        claims=(coherence_claim(orders["channel_order_coherence"]),),
    )


def _part(name: str, title: str, *blocks: Block | None) -> Part:
    return Part(name, title, tuple(block for block in blocks if block is not None))


def over_speed_parts(compared: Compared) -> list[Part]:
    """Return a section of two studies that both have several speeds; none of others."""
    first, second = compared.first, compared.second
    if not all(is_study(results) and over_speed(results) for results in (first, second)):
        return []
    option, other = (option for _, _, option, _ in compared.sides())
    charts = (
        levels_over_speed(first, None, [option], second, [other]),
        campbell(first, None, option, second),
    )
    return [Part("speeds", "Over the speed", (Pictures(charts),))]


def _verdict(
    compared: Compared, figures: Sequence[CheckedFigure], validations: Sequence[Validation]
) -> Iterator[Text]:
    if figures or "order_limit" in compared.orders:
        yield Text(limits_sentence(compared.orders, figures), "headline")
    yield Text(summary(compared.orders), "strong")
    if validations:
        yield Text(_agreement(validations))


def _agreement(validations: Sequence[Validation]) -> str:
    agree, differ = (
        sum(each.verdict == word for each in validations) for word in (AGREES, DIFFERS)
    )
    count = sum(each.uncertainty > 0.0 for each in validations)
    return (
        f"{agree} of {len(validations)} figures of the study agree with the recordings: within "
        f"the 80 % interval, {LEVEL_TOLERANCE_DB:g} dB or {percent(FORCE_TOLERANCE)}. {differ} "
        "differ by more than "
        f"{COVERAGE:g} times the validation uncertainty, which is known, at least in part, for "
        f"{count}."
    )


def _validation(validations: Sequence[Validation]) -> tuple[Block, ...]:
    if not validations:
        return ()
    note = (
        "E = S − D; u is the root of the sum of squares of u_num (grids of the radiation), u_input "
        "(samples, on the side of the data) and u_D (scatter of the runs and specimens), in "
        "the form of ASME V&V 20. What is not known counts as zero, so u is a lower limit."
    )
    table: Block = validation_table("The study beside the recordings", validations)
    if len(validations) > MOST_ROWS:
        table = Details(f"All {len(validations)} figures", (table,))
    return Text(note, "note"), table


def _orders(orders: xr.Dataset) -> list[Block]:
    channels = known_channels(orders)
    if not channels:
        return [Text(summary(orders))]
    have_pictures = orders["order_difference"].notnull().any(("speed", "order")).values
    with_pictures = map(str, orders["channel"].values[have_pictures])
    charts_of = dict(zip(with_pictures, compared_order_charts(orders), strict=True))
    loud = dict(zip(map(str, orders["channel"].values), is_pressure(orders), strict=True))
    first = [name for name in channels if loud[name]] or channels[:1]
    blocks: list[Block] = [Pictures((order_differences(orders),))]
    for name in channels:
        pictures_of = (*(channel_charts(orders, name) if name in first else ()), charts_of[name])
        of_channel: tuple[Block, ...] = (orders_table(orders, name), Pictures(pictures_of))
        blocks += of_channel if name in first else [Details(name, of_channel)]
    return blocks


def channel_charts(orders: xr.Dataset, channel: str) -> list[Chart]:
    """Return orders of a channel in both results over the speeds, where these are several."""
    several = orders.sizes["speed"] >= FEWEST_OVER_SPEED
    return [orders_over_speed(orders, channel)] if several else []


def _runs(orders: xr.Dataset) -> tuple[Block, ...]:
    runs = runs_of(orders)
    if not runs:
        return ()
    rows = [(str(number), run["file"], run["specimen"]) for number, run in enumerate(runs, 1)]
    note = (
        "Means are energy means over the runs of each specimen and then over the specimens. "
        "Deviations are of levels: between runs of one specimen, and between specimens without "
        "what the runs scatter; where each specimen ran once, the two cannot be separated. The "
        "uncertainty of the mean of one specimen holds for that specimen alone."
    )
    table = Table("Runs", ("Run", "Recording", "Specimen"), tuple(rows), frozenset({0, 1, 2}))
    return Text(note, "note"), table


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
