"""Whether every number of one report is in another, or in a CSV beside it.

    python benchmarks/report_numbers.py BEFORE_FOLDER AFTER_FOLDER [--show 40] [--quick]

CSV files: each value of a column that both files have, row by row, to 1e-12 of its size. Tables of
the page: each number of a row is searched for in the rows of the report after, of tables and CSV
files, that have the same label among their cells: as it is printed, or as a value that rounds to it
(or its hundredth, for per cent). Those whose label is worded otherwise, and numbers in sentences,
are searched for in the whole page and all CSV files. As a control the same searches are made for
numbers that are 37 % larger: that share is found by chance.
"""

import csv
import html
import re
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from quick import parser

NUMBER = re.compile(r"(?<![\w.])[−-]?\d+(?:\.\d+)?(?:e[−-]?\d+)?(?![\w])")
HIDDEN = re.compile(r"<(script|style|svg)\b.*?</\1>", re.DOTALL)
TABLE = re.compile(r"<table.*?</table>", re.DOTALL)
CELL = re.compile(r"<t[hd][^>]*>(.*?)</t[hd]>", re.DOTALL)
EQUAL = 1e-12
CONTROL = 1.37


class Printed(NamedTuple):
    """A number as it is printed, half of its last digit, and the label of its row."""

    text: str
    value: float
    half: float
    label: str


class Report(NamedTuple):
    """A report: printed numbers and values of CSV files by the label of their row; "" for all."""

    printed: list[Printed]
    values: dict[str, set[float]]


def report(folder: Path) -> Report:
    """Read the page and the CSV files of a folder."""
    page = HIDDEN.sub(" ", (folder / "report.html").read_text("utf-8"))
    rows = [cells for table in TABLE.findall(page) for cells in rows_of(table)]
    numbers = [number for cells in rows for text in cells[1:] for number in found(text, cells[0])]
    numbers += found(words(TABLE.sub(" ", page)), "")
    values: dict[str, set[float]] = defaultdict(set)
    for file in folder.glob("*.csv"):
        for cells in csv.reader(file.read_text("utf-8").splitlines()):
            parts = [number.value for text in cells for number in found(text, "")]
            for label in {"", *map(plain, cells)}:
                values[label].update(parts)
    return Report(list(dict.fromkeys(numbers)), values)


def rows_of(table: str) -> Iterator[list[str]]:
    """Yield the cells of the rows of a table as text."""
    for row in table.split("<tr")[1:]:
        cells = [words(cell) for cell in CELL.findall(row)]
        if cells:
            yield cells


def words(markup: str) -> str:
    """Return the text of markup."""
    return html.unescape(re.sub(r"<[^>]+>", " ", markup)).replace("\u200b", "")


def plain(label: str) -> str:
    """Return a label as it is compared."""
    return re.sub(r"[\W_]+", " ", label).strip().lower()


def found(text: str, label: str) -> Iterator[Printed]:
    """Yield the numbers of a text."""
    for word in NUMBER.findall(text):
        number = word.replace("−", "-")
        mantissa, _, exponent = number.partition("e")
        half = 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        yield Printed(number, float(number), half, plain(label))


def is_in(number: Printed, after: Report, by: float = 1.0) -> bool:
    """Return whether a number times a factor is in the rows of its label."""
    value, half = by * number.value, number.half * (1.0 + 1e-9)
    texts = {other.value for other in after.printed if number.label in {"", other.label}}
    values = after.values.get(number.label, set()) | texts
    return any(
        abs(scale * other - value) <= half for other in values for scale in (1.0, -1.0, 100.0)
    )


def differing_files(before: Path, after: Path) -> Iterator[str]:
    """Yield a line for each CSV file that is missing or holds another value."""
    for old in sorted(before.glob("*.csv")):
        new = after / old.name
        if not new.exists():
            yield f"{old.name}: missing"
            continue
        first, last = (
            list(csv.DictReader(file.read_text("utf-8").splitlines())) for file in (old, new)
        )
        shared = [name for name in first[0] if name in last[0]]
        missing = [name for name in first[0] if name not in last[0]]
        pairs = list(zip(first, last, strict=False))
        unequal = sum(not same(row[name], other[name]) for row, other in pairs for name in shared)
        if missing or unequal or len(first) != len(last):
            counts = f"{unequal} values unequal, {len(first)} and {len(last)} rows"
            yield f"{old.name}: columns missing {missing}, {counts}"


def same(before: str, after: str) -> bool:
    """Return whether two cells are equal, numbers to 1e-12 of their size."""
    try:
        first, last = float(before), float(after)
    except ValueError:
        return before == after
    return before == after or abs(first - last) <= EQUAL * max(abs(first), abs(last))


def main() -> int:
    """Print what is missing; the exit code is 1 where something is."""
    options = parser(__doc__)
    options.add_argument("before", type=Path, nargs="?")
    options.add_argument("after", type=Path, nargs="?")
    options.add_argument("--show", type=int, default=40)
    asked = options.parse_args()
    if asked.quick:
        with tempfile.TemporaryDirectory() as folder:
            page = "<p>3 options</p><table><tr><td>level</td><td>54.2 dB</td></tr></table>"
            (Path(folder) / "report.html").write_text(page, "utf-8")
            (Path(folder) / "levels.csv").write_text("option,level_dba\nnone,54.21\n", "utf-8")
            return compared(Path(folder), Path(folder), asked.show)
    if asked.after is None:
        options.error("two folders must be given")
    return compared(asked.before, asked.after, asked.show)


def compared(before_folder: Path, after_folder: Path, show: int) -> int:
    """Print what is missing of a report in another; 1 where something is."""
    broken = list(differing_files(before_folder, after_folder))
    print("\n".join(broken) or "CSV files: every value equal to 1e-12")
    before, after = report(before_folder), report(after_folder)
    of_tables = [number for number in before.printed if number.label]
    others = [number for number in of_tables if not is_in(number, after)]
    of_sentences = [number for number in before.printed if not number.label]
    missing = []
    for name, some in (
        ("of tables, in rows of the same label", of_tables),
        ("of tables, the others anywhere", [number._replace(label="") for number in others]),
        ("of sentences, anywhere", of_sentences),
    ):
        lost = [number for number in some if not is_in(number, after)]
        chance = sum(is_in(number, after, CONTROL) for number in some)
        print(f"numbers {name}: {len(some) - len(lost)} of {len(some)}; control: {chance}")
        missing += [] if some is of_tables else lost
    for number in missing[:show]:
        print(f"  missing: {number.text} of {number.label or 'a sentence'}")
    return int(bool(broken or missing))


if __name__ == "__main__":
    sys.exit(main())
