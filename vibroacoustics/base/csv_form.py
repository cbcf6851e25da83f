"""Form of a CSV text: its encoding, cells, heads with units, and the signs in its numbers."""

import codecs
import csv
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from .arrays import Array

SEPARATORS: Final = ("\t", ";", "|", ",")
"""Separators of cells. A comma counts only where no other one splits the head."""
COMMENT: Final = "#"
_UTF_16: Final = {codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}
_BLANK_GROUPS: Final = re.compile(
    "([+-]?[1-9]\\d{0,2}(?:([ \u00a0\u2009\u202f'\u2019])\\d{3})(?:\\2\\d{3})*)((?:[.,]\\d*)?)"
)
_HEAD: Final = re.compile(
    r"(?P<name>.*?)\s*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>(?:[^()]|\([^()]*\))*)\)"
    r"|\s/\s+(?P<quotient>\S.*))"
)


def wide_encoding(begin: bytes) -> str | None:
    """UTF-16 by its mark, or by the zeros in every second byte of what is in ASCII."""
    if begin[:2] in _UTF_16:
        return _UTF_16[begin[:2]]
    if len(begin) >= 4 and not any(begin[1::2]) and all(begin[::2]):
        return "utf-16-le"
    if len(begin) >= 4 and not any(begin[::2]) and all(begin[1::2]):
        return "utf-16-be"
    return None


def decoded(content: bytes) -> str:
    """Text in UTF-8 or UTF-16, with or without a mark, else in Latin-1.

    Raises
    ------
    ValueError
        It holds characters that no text has.
    """
    encoding = wide_encoding(content[:64])
    if encoding is not None:
        return content.decode(encoding)
    if b"\0" in content:
        raise ValueError("is no text")
    return narrow_text(content)


def narrow_text(content: bytes) -> str:
    """Text in UTF-8, with or without a mark, else in Latin-1."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:  # as Western European spreadsheets write m/s²
        return content.decode("latin-1")


def cells_of(line: str, separator: str, strict: bool = True) -> list[str]:
    """Cells of a line, without blanks around them.

    Parameters
    ----------
    line : without its end
    separator : character between cells
    strict : whether text behind a quote is refused
    """
    if '"' not in line:
        return [cell.strip() for cell in line.split(separator)]
    rows = csv.reader([line], delimiter=separator, strict=strict, skipinitialspace=True)
    return [cell.strip() for cell in next(rows)]


def split_head(cell: str, is_unit: Callable[[str], bool]) -> tuple[str, str | None]:
    """Split `Fx [N]`, `Fx (N)` and `Fx / N` into name and unit; the unit is None where none is.

    Parameters
    ----------
    cell : text of a cell of a head
    is_unit : whether a text in round brackets or behind a slash is a unit, not part of the name
    """
    match = _HEAD.fullmatch(cell)
    if match is None:
        return cell, None
    unit = match["square"]
    if unit is None:
        unit = match["round"] if match["round"] is not None else match["quotient"]
        if not is_unit(unit.strip()):
            return cell, None
    return match["name"], unit.strip()


@dataclass(frozen=True)
class NumberForm:
    """Signs in the numbers of a file.

    Attributes
    ----------
    decimal : point or comma
    grouped : whether the other one separates thousands
    """

    decimal: str
    grouped: bool = False

    def fits(self, cell: str) -> bool:
        """Whether a cell is a number in this form."""
        return _patterns(self.decimal, self.grouped).fullmatch(cell) is not None

    def plain(self, cell: str) -> str:
        """Number as Python writes it, from one in this form."""
        return cell.replace("." if self.decimal == "," else ",", "").replace(",", ".")

    def python(self, cell: str) -> str:
        """Cell as Python writes it; what is no number is left to `float`.

        Raises
        ------
        ValueError
            It has the sign of another form.
        """
        text = tidy(cell)
        if not self.fits(text) and ("," in text or "." in text):
            raise ValueError(f"{cell}: is no number with a decimal {_SIGNS[self.decimal]}")
        return self.plain(text)

    def numbers(self, cells: Sequence[str]) -> Array:
        """Numbers of cells without blanks around them, shape (cell,)."""
        text = "\n".join(cells)
        if not self.grouped and not re.search(r"[_.]" if self.decimal == "," else r"[_,]", text):
            try:
                values = np.array(text.replace(",", ".").split("\n"), dtype=np.float64)
            except ValueError:
                pass
            else:
                if np.all(np.isfinite(values)):
                    return values
        return np.array([self._number(tidy(cell)) for cell in cells], dtype=np.float64)

    def _number(self, cell: str) -> float:
        value = float(self.plain(cell)) if self.fits(cell) else np.nan
        if not np.isfinite(value):
            raise ValueError(f"{cell or 'nothing'}: must be a finite number")
        return value


_SIGNS: Final = {".": "point", ",": "comma"}
POINT: Final = NumberForm(".")
COMMA: Final = NumberForm(",")
GROUPED: Final = (NumberForm(".", grouped=True), NumberForm(",", grouped=True))


@cache
def _patterns(decimal: str, grouped: bool) -> re.Pattern[str]:
    sign, other = (r"\.", ",") if decimal == "." else (",", r"\.")
    number = rf"[+-]?(?:\d+(?:{sign}\d*)?|{sign}\d+)(?:[eE][+-]?\d+)?"
    groups = rf"|[+-]?[1-9]\d{{0,2}}(?:{other}\d{{3}})+(?:{sign}\d*)?"
    return re.compile(number + (groups if grouped else ""))


def tidy(cell: str) -> str:
    """Number without blanks or apostrophes between its thousands, with a plain minus sign."""
    plain = cell.strip().replace("\u2212", "-")
    match = _BLANK_GROUPS.fullmatch(plain)
    return plain if match is None else match[1].replace(match[2], "") + match[3]


def number_form(cells: Iterable[str], separator: str) -> NumberForm:
    """Find the form of all numbers of a file by the signs in its cells.

    A point or comma before three digits may separate thousands: `1.234` is 1.234 or 1234. What
    another cell shows holds for all. Where none does, a semicolon makes the comma the decimal
    sign, a comma between the cells makes the point it. Else no number is guessed.

    Parameters
    ----------
    cells : that hold numbers; others are left to `NumberForm.numbers`
    separator : character between cells

    Raises
    ------
    ValueError
        Two cells contradict each other, or a cell may be two numbers; with message and cell.
    """
    signed = [tidy(cell) for cell in cells if "." in cell or "," in cell]
    text = "\n".join(signed)
    if "," in text and "." in text:
        fitting = [form for form in GROUPED if all(map(form.fits, signed))]
        if len(fitting) == 1:
            return fitting[0]
        pair = " and ".join(next(cell for cell in signed if sign in cell) for sign in ".,")
        raise ValueError(f"{pair}: have no common decimal sign", pair.partition(" ")[0])
    form, rival, settled = (COMMA, GROUPED[0], ";") if "," in text else (POINT, GROUPED[1], ",")
    if not signed or not all(map(rival.fits, signed)):
        return form
    if not all(map(form.fits, signed)):
        return rival
    if separator == settled:
        return form
    cell = signed[0]
    decimal, integer = form.plain(cell), rival.plain(cell)
    raise ValueError(f"{cell}: may be {decimal} or {integer}; write {decimal}0 or {integer}", cell)
