"""Tones and rating levels of two studies beside each other."""

from collections.abc import Sequence
from typing import Final

from ...base import rounding
from ...results.estimates import Estimate
from ...results.figure_limits import Compared
from ...results.rating_changes import RatingChange, rating_changes
from ..operating_points import shown_speeds
from ..tables import DataTable, Table, columns_of

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
