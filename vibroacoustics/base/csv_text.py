"""CSV as bytes: the one place that writes it, with names that no spreadsheet takes for formulas."""

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from typing import Final

FORMULA_STARTS: Final = ("=", "+", "-", "@", "\t")
"""A spreadsheet runs a text cell that begins so."""


def csv_bytes(
    head: Sequence[str],
    rows: Iterable[Sequence[str | float]],
    write_number: Callable[[float], str] = repr,
) -> bytes:
    """A table with a head line; text that would be a formula gets a leading apostrophe.

    Numbers stay numbers, negative ones too; `repr` is the shortest text that is read back.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(_text, head))
    writer.writerows(
        [_text(cell) if isinstance(cell, str) else write_number(cell) for cell in row]
        for row in rows
    )
    return text.getvalue().encode()


def defused(text: str) -> str:
    """Text that a spreadsheet shows as it is."""
    return f"'{text}" if _is_formula(text) else text


def fused(text: str) -> str:
    """The text of which `defused` made this one."""
    return text[1:] if text.startswith("'") and _is_formula(text) else text


def _text(cell: str) -> str:
    """Replace carriage returns, which csv does not quote, though they end a row."""
    return defused(cell.replace("\r", " "))


def _is_formula(text: str) -> bool:
    """Apostrophes in front do not count, so that `fused` is the exact inverse."""
    return text.lstrip("' ").startswith(FORMULA_STARTS)
