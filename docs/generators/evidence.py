"""The page of all claims: computed values beside references, known misses included."""

import csv
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Final

from vibroacoustics.results.claims import MISSED, Claim, claims, closest, documents

from . import tables

CLOSEST: Final = 10
TRENDS: Final = Path(__file__).resolve().parents[2] / "data" / "validation" / "trends.csv"
HEAD: Final = """---
html_theme.sidebar_secondary.remove: true
---
# Evidence

{count} claims of this package, each checked by a test: {kinds}; {missed} are known misses.

- **Exact**: a closed form or a law. **Printed**: a value that a document prints.
- **Second code**: another program, or a second method. **Recording**: a recorded signal.
- **Share**: distance between computed value and reference, in tolerances; a claim is met up to 1.
  The worst of many values is listed. A test fails where a verdict changes or a share moves by more
  than 0.1.

`vibroacoustics/results/evidence.json` holds the same rows. A report lists those that its study
depends on.
"""
KINDS: Final = ("exact", "printed", "second code", "recording")


def page() -> str:
    """Return the page: closest to the limit, missed, trends, all claims, documents."""
    rows = claims()
    numbers = Counter(row.kind for row in rows)
    missed = [row for row in rows if row.verdict == MISSED]
    parts = [
        HEAD.format(
            count=len(rows),
            kinds=", ".join(f"{numbers[kind]} {kind}" for kind in KINDS if numbers[kind]),
            missed=len(missed),
        ),
        f"## The {CLOSEST} closest to their limit\n",
        table(
            ("Claim", "Reference", "Computed", "Tolerance", "Share"),
            ((row.what, *numbers_of(row), share(row)) for row in closest(rows, CLOSEST)),
        ),
        "## Known misses\n",
        misses(missed),
        "## Published trends\n",
        table(
            ("Fact", "Source", "Printed", "Computed", "Verdict", "Remark"),
            (
                (
                    row["fact"],
                    row["source"],
                    row["printed"],
                    _with_unit(row),
                    row["verdict"],
                    row["remark"],
                )
                for row in trends()
            ),
        ),
        "## All claims\n",
        table(
            ("Claim", "Source", "Reference", "Computed", "Tolerance", "Share", "Kind", "Test"),
            (_row(row) for row in sorted(rows, key=lambda row: (row.document, row.what))),
        ),
        "## Documents\n",
        table(
            ("Cited as", "Author", "Title", "Year"),
            ((each.name, each.author, each.title, each.year) for each in documents().values()),
        ),
    ]
    return "\n".join(parts)


def trends() -> list[dict[str, str]]:
    """Return rows of the trends that makers and authors publish beside nominal modelled sources."""
    lines = TRENDS.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def _with_unit(row: dict[str, str]) -> str:
    return f"{row['ours'].replace('-', '−')} {row['unit']}" if row["ours"] else "–"


def misses(rows: Iterable[Claim]) -> str:
    """Return the missed claims by their reasons: computed value and reference."""
    by_reason: dict[str, list[str]] = {}
    for row in rows:
        reference, computed, _ = numbers_of(row)
        by_reason.setdefault(row.reason, []).append(f"{row.what}: {computed}, not {reference}")
    return "".join(f"- {'; '.join(each)}. *{reason}.*\n" for reason, each in by_reason.items())


def _row(row: Claim) -> tuple[str, ...]:
    file, _, name = row.test.rpartition("/")[2].partition(".py::")
    return (
        row.what, f"{row.document}, {row.passage}", *numbers_of(row), share(row), row.kind,
        f"`{file}` `{name.partition('[')[0]}`",
    )  # fmt: skip


def numbers_of(row: Claim) -> tuple[str, str, str]:
    """Reference and computed value with the unit, and the tolerance."""
    unit = "" if row.unit == "1" else f" {row.unit}"
    return (
        f"{short(row.reference)}{unit}", f"{short(row.computed)}{unit}", short(row.tolerance, 3)
    )  # fmt: skip


def short(value: float, digits: int = 5) -> str:
    """A number of a few digits with the field's minus sign."""
    return f"{value:.{digits}g}".replace("-", "−")


def share(row: Claim) -> str:
    """The share of the tolerance to one digit."""
    return f"{row.share:.1f}"


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table of Markdown whose asterisks are shown as they are."""
    shown = [[text.replace("*", "\\*") for text in row] for row in rows]
    return tables.table(list(head), shown) + "\n"
