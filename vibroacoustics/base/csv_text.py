"""CSV as bytes, with names that no spreadsheet takes for formulas, and a user's lines and cells."""

import csv
import io
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from .csv_form import COMMENT, SEPARATORS, cells_of, decoded
from .errors import ParameterError
from .regular_file import read_bytes

MAXIMUM_BYTES: Final = 200_000_000
STATED: Final = re.compile(r'"?sep=(.)"?')
"""First line by which a spreadsheet states the separator."""
_BLANK: Final = " \t,;|"


@dataclass(frozen=True)
class Lines:
    """Lines of a file that are neither blank nor comments.

    Attributes
    ----------
    path : path of the file
    numbers : numbers of the lines, from 1
    texts : texts of the lines
    separators : that the file may have; one where it states it
    comments : without their mark
    """

    path: Path
    numbers: tuple[int, ...]
    texts: tuple[str, ...]
    separators: tuple[str, ...]
    comments: tuple[str, ...]

    def rows(self, separator: str, count: int | None = None) -> list[list[str]]:
        """Cells of the first lines, or of all.

        Raises
        ------
        ParameterError
            A line cannot be split.
        """
        rows = []
        for number, line in zip(self.numbers[:count], self.texts, strict=False):
            try:
                rows.append(cells_of(line, separator))
            except csv.Error as error:
                problem = f"{self.path}: line {number}: cannot be split: {error}"
                raise ParameterError(problem) from None
        return rows


def read_lines(path: Path, maximum_bytes: int = MAXIMUM_BYTES) -> Lines:
    """Read a text file in any encoding of `csv_form.decoded`.

    Raises
    ------
    ParameterError
        It cannot be read, or has no lines beside comments.
    """
    try:
        lines = decoded(read_bytes(path, maximum_bytes)).splitlines()
    except FileNotFoundError:
        raise ParameterError(f"{path}: no such file") from None
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError:
        raise ParameterError(f"{path}: cannot be read: is no text") from None
    stated = STATED.fullmatch(lines[0].strip()) if lines else None
    texts = [(number, line) for number, line in enumerate(lines, 1) if line.strip(_BLANK)]
    kept = [
        (number, line)
        for number, line in texts[1 if stated else 0 :]
        if not line.lstrip().startswith(COMMENT)
    ]
    if not kept:
        raise ParameterError(f"{path}: is empty")
    return Lines(
        path,
        tuple(number for number, _ in kept),
        tuple(line for _, line in kept),
        (stated[1],) if stated else SEPARATORS,
        tuple(line.strip(f"{_BLANK}{COMMENT}") for _, line in texts if line.startswith(COMMENT)),
    )


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
