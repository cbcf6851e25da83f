"""Forms in which programs of several countries write the same table as CSV."""

import csv
import io
from dataclasses import dataclass, replace

BLANK_LINES = ("", "   ", "")
COMMENTS = ("# test stand 2; 3,5 kW", "#", "# 2026-11-26")


@dataclass(frozen=True)
class Form:
    """How a program writes a table.

    Attributes
    ----------
    separator, decimal : signs between cells and in numbers
    thousands : sign between thousands; empty for none
    head : format of a name with its unit; empty for keys of this package
    has_unit_row : whether units are in a line below the names
    quoting : of Python's csv
    trailing : whether lines end with a separator
    above : lines above the head
    blank_after : blank lines below the head
    end : of a line
    encoding : of the text
    """

    separator: str = ","
    decimal: str = "."
    thousands: str = ""
    head: str = "{name} [{unit}]"
    has_unit_row: bool = False
    quoting: int = csv.QUOTE_MINIMAL
    trailing: bool = False
    above: tuple[str, ...] = ()
    blank_after: bool = False
    end: str = "\n"
    encoding: str = "utf-8"

    def number(self, value: float) -> str:
        """Number in the form; `repr` and back is exact."""
        signs = str.maketrans({",": self.thousands, ".": self.decimal})
        whole, _, digits = repr(float(value)).partition(".")
        grouped = f"{int(whole):,}" if whole.lstrip("-").isdigit() else whole
        grouped = f"-{grouped}" if whole == "-0" else grouped
        return (f"{grouped}.{digits}" if digits not in ("", "0") else grouped).translate(signs)

    def written(self, columns, rows) -> bytes:
        """Table as bytes.

        Parameters
        ----------
        columns : key, name and unit of each
        rows : of numbers and words
        """
        if self.has_unit_row:
            above = [[name for _, name, _ in columns], [unit for _, _, unit in columns]]
        else:
            above = [[self._head(*column) for column in columns]]
        lines = above + [
            [cell if isinstance(cell, str) else self.number(cell) for cell in row] for row in rows
        ]
        text = io.StringIO()
        writer = csv.writer(text, delimiter=self.separator, quoting=self.quoting,
                            lineterminator="\n")  # fmt: skip
        writer.writerows([*line, ""] if self.trailing else line for line in lines)
        written = text.getvalue().splitlines()
        if self.blank_after:
            written[len(above) : len(above)] = BLANK_LINES
        return (self.end.join([*self.above, *written]) + self.end).encode(self.encoding)

    def _head(self, key: str, name: str, unit: str) -> str:
        if not self.head:
            return key
        return self.head.format(name=name, unit=unit) if unit else name


PLAIN = Form()
GERMAN = Form(";", ",")
FORMS = {
    "comma": PLAIN,
    "semicolon": replace(PLAIN, separator=";"),
    "tab": replace(PLAIN, separator="\t"),
    "bar": replace(PLAIN, separator="|"),
    "semicolon, decimal comma": GERMAN,
    "tab, decimal comma": replace(GERMAN, separator="\t"),
    "bar, decimal comma": replace(GERMAN, separator="|"),
    "comma, quoted decimal comma": replace(GERMAN, separator=","),
    "comma, thousands by commas in quotes": replace(PLAIN, thousands=","),
    "semicolon, thousands by points": replace(GERMAN, thousands="."),
    "semicolon, thousands by commas": replace(PLAIN, separator=";", thousands=","),
    "tab, thousands by commas": replace(PLAIN, separator="\t", thousands=","),
    "tab, thousands by points": replace(GERMAN, separator="\t", thousands="."),
    "bar, thousands by points": replace(GERMAN, separator="|", thousands="."),
    "French thousands": replace(GERMAN, thousands="\u202f"),
    "thousands by no-break spaces": replace(GERMAN, thousands="\u00a0", encoding="latin-1"),
    "Swiss thousands": replace(PLAIN, separator=";", thousands="'"),
    "round brackets": replace(PLAIN, head="{name} ({unit})"),
    "quotients": replace(GERMAN, head="{name} / {unit}"),
    "brackets without a blank": replace(GERMAN, head="{name}[{unit}]"),
    "blanks in brackets": replace(PLAIN, head="{name} [ {unit} ]"),
    "keys": replace(PLAIN, head=""),
    "keys, decimal comma": replace(GERMAN, head=""),
    "row of units": replace(PLAIN, has_unit_row=True),
    "row of units, decimal comma": replace(GERMAN, has_unit_row=True),
    "row of units, tab, trailing": replace(GERMAN, separator="\t", has_unit_row=True,
                                           trailing=True),
    "all quoted": replace(PLAIN, quoting=csv.QUOTE_ALL),
    "all quoted, decimal comma": replace(GERMAN, quoting=csv.QUOTE_ALL),
    "words quoted": replace(PLAIN, quoting=csv.QUOTE_NONNUMERIC),
    "trailing commas": replace(PLAIN, trailing=True),
    "trailing semicolons": replace(GERMAN, trailing=True),
    "trailing tabs": replace(PLAIN, separator="\t", trailing=True),
    "comments": replace(PLAIN, above=COMMENTS),
    "comments, decimal comma": replace(GERMAN, above=(*COMMENTS, "")),
    "stated separator": replace(GERMAN, above=("sep=;",)),
    "stated bar": replace(PLAIN, separator="|", above=("sep=|",)),
    "lines above": replace(GERMAN, above=("Export of stand 2;;;", "Operator;Ms, Meier;;", "")),
    "blank lines": replace(PLAIN, above=BLANK_LINES, blank_after=True),
    "blank lines, decimal comma": replace(GERMAN, blank_after=True, end="\r\n"),
    "carriage returns": replace(PLAIN, end="\r\n"),
    "spreadsheet of Germany": replace(GERMAN, end="\r\n", encoding="latin-1"),
    "byte-order mark": replace(GERMAN, end="\r\n", encoding="utf-8-sig"),
    "UTF-16": replace(GERMAN, separator="\t", end="\r\n", encoding="utf-16"),
    "UTF-16 without a mark": replace(PLAIN, separator="\t", encoding="utf-16-le"),
    "UTF-16 of the other end": replace(PLAIN, separator=";", encoding="utf-16-be"),
    "all at once": replace(GERMAN, thousands=".", quoting=csv.QUOTE_ALL, trailing=True,
                           above=("sep=;", *COMMENTS), has_unit_row=True, end="\r\n",
                           encoding="utf-8-sig"),
}  # fmt: skip
