"""Score a program's answers to the open benchmark of compressor noise and vibration.

    python score.py SUBMISSION [CASE ...] [--json]

Needs Python 3.11 or later and nothing else. SUBMISSION is a CSV file with the columns case, key,
unit and value, or a JSON list of objects with these names, of at most 1 MB; the order of rows has
no meaning. Named cases alone are scored; without names all are. A case passes where every expected
row is met. Characters that a terminal would obey are printed as escapes.

Exit code 0: all pass; 1: a case fails; 2: the submission or a case cannot be read.
"""

import argparse
import csv
import json
import math
import os
import stat
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

CASES = Path(__file__).resolve().parent / "cases"
FIELDS = ("case", "key", "unit", "value")
LARGEST_BYTES = 1_000_000
LONGEST_WORDS = 200
"""Characters of a submitted text that a message repeats."""
RATIOS = {
    "the sign is reversed": -1.0,
    "a factor of 2 too large": 2.0,
    "a factor of 2 too small": 0.5,
    "root mean square instead of peak": math.sqrt(0.5),
    "peak instead of root mean square": math.sqrt(2.0),
    "degrees instead of radians": 180.0 / math.pi,
    "radians instead of degrees": math.pi / 180.0,
    "a power of ten too large, a unit": 1000.0,
    "a power of ten too small, a unit": 0.001,
}
"""Usual mistakes by the ratio of the submitted value to the expected one."""


class RefusedError(Exception):
    """The submission or a case cannot be read; the message is one line."""


class Row(NamedTuple):
    """An expected value with its tolerance, both in `unit`."""

    key: str
    unit: str
    value: float
    tolerance: float


class Verdict(NamedTuple):
    """What a row or a case comes to: whether it passes, and why not."""

    case: str
    key: str
    passed: bool
    reason: str


def main(words: list[str] | None = None) -> int:
    """Score the submission that the command line names."""
    parser = argparse.ArgumentParser(description="Score answers to the benchmark.")
    parser.add_argument("submission", type=Path)
    parser.add_argument("case", nargs="*")
    parser.add_argument("--json", action="store_true", help="print verdicts as JSON")
    asked = parser.parse_args(words)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    try:
        verdicts = score(read_submission(asked.submission), asked.case or case_names())
    except RefusedError as error:
        print(f"error: {harmless(str(error))}", file=sys.stderr)
        return 2
    if asked.json:
        print(json.dumps([verdict._asdict() for verdict in verdicts], indent=1))
    else:
        print("\n".join(map(harmless, summary(verdicts))))
    return 0 if all(verdict.passed for verdict in verdicts) else 1


def harmless(line: str) -> str:
    """Return a line with escapes for characters that a terminal would obey or not show."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line)


def shortened(text: Any) -> str:
    """Return the beginning of a submitted text, for a message."""
    words = str(text)
    return words if len(words) <= LONGEST_WORDS else f"{words[:LONGEST_WORDS]}…"


def case_names() -> list[str]:
    """Names of the cases, which are their folders."""
    return sorted(path.parent.name for path in CASES.glob("*/expected.csv"))


def score(answers: list[dict[str, Any]], names: list[str]) -> list[Verdict]:
    """Return a verdict for every expected row of the named cases, and for rows that none expects.

    Raises
    ------
    RefusedError
        There is no such case, or its expected values cannot be read.
    """
    unknown = sorted({str(answer["case"]) for answer in answers} - set(case_names()))
    verdicts = [Verdict(shortened(name), "", False, "there is no such case") for name in unknown]
    for name in names:
        rows = expected(name)
        given: dict[str, list[dict[str, Any]]] = {}
        for answer in answers:
            if answer["case"] == name:
                given.setdefault(str(answer["key"]), []).append(answer)
        for row in rows:
            reason = fault(row, given.pop(row.key, []), rows)
            verdicts.append(Verdict(name, row.key, not reason, reason))
        verdicts += [
            Verdict(name, shortened(key), False, "no such key is expected") for key in given
        ]
    return verdicts


def expected(name: str) -> list[Row]:
    """Return the expected rows of a case.

    Raises
    ------
    RefusedError
        There is no such case, or its file cannot be read.
    """
    path = CASES / name / "expected.csv"
    if name not in case_names():
        raise RefusedError(f"case = {name}: must be one of {', '.join(case_names())}")
    try:
        rows = [
            Row(row["key"], row["unit"], float(row["value"]), float(row["tolerance"]))
            for row in csv.DictReader(path.read_text(encoding="utf-8").splitlines())
        ]
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise RefusedError(f"{path}: cannot be read: {error}") from None
    return rows


def fault(row: Row, answers: list[dict[str, Any]], rows: list[Row]) -> str:
    """Say what is wrong with the answers to an expected row; empty where nothing is."""
    if len(answers) != 1:
        return "is missing" if not answers else f"is given {len(answers)} times"
    unit = str(answers[0]["unit"]).strip()
    if unit != row.unit:
        return f"unit = {shortened(unit) or 'none'}: must be {row.unit or 'none'}"
    try:
        value = number(answers[0]["value"])
    except ValueError:
        return f"value = {shortened(answers[0]['value'])}: must be a finite number"
    if abs(value - row.value) <= row.tolerance:
        return ""
    words = f"value = {value:.6g} {row.unit}: must be {row.value:.6g} ± {row.tolerance:.2g}"
    guess = usual_mistake(value, row, rows)
    return f"{words} {row.unit}" + (f" ({guess})" if guess else "")


def number(value: Any) -> float:
    """Return a finite number from a cell or a JSON value.

    Raises
    ------
    ValueError
        It is text, empty, true or false, or not finite.
    """
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ValueError
    try:
        result = float(value)
    except OverflowError:
        raise ValueError from None
    if not math.isfinite(result):
        raise ValueError
    return result


def usual_mistake(value: float, row: Row, rows: list[Row]) -> str:
    """Name a usual mistake that would give the value; empty where there is none."""
    for words, ratio in RATIOS.items():
        if row.value and abs(value - ratio * row.value) <= abs(ratio) * row.tolerance:
            return f"{words}?"
    for other in rows:
        if other.value and other.unit == row.unit and abs(value - other.value) <= other.tolerance:
            return f"the value of {other.key}?"
    return ""


def summary(verdicts: list[Verdict]) -> list[str]:
    """Return lines for a terminal: each fault, then each case, then the count."""
    lines = [f"{v.case}: {v.key}: {v.reason}" for v in verdicts if not v.passed]
    cases: dict[str, list[bool]] = {}
    for verdict in verdicts:
        cases.setdefault(verdict.case, []).append(verdict.passed)
    passed = 0
    for name, rows in cases.items():
        passed += all(rows)
        word = "passed" if all(rows) else "FAILED"
        lines.append(f"{word}  {name}: {sum(rows)} of {len(rows)} values")
    return [*lines, f"{passed} of {len(cases)} cases passed"]


def read_submission(path: Path) -> list[dict[str, Any]]:
    """Return the rows of a submission.

    Raises
    ------
    RefusedError
        It cannot be read, is no regular file, is too large or nested too deeply, is neither CSV
        nor JSON, or lacks a column.
    """
    try:
        text = read_bytes(path).decode("utf-8-sig")
        if path.suffix.lower() == ".json":
            rows = json.loads(text)
        else:
            rows = list(csv.DictReader(text.splitlines()))
    except RecursionError:
        raise RefusedError(f"{path}: cannot be read: lists or objects nest too deeply") from None
    except OSError as error:
        raise RefusedError(f"{path}: cannot be read: {error.strerror}") from None
    except (ValueError, csv.Error) as error:
        raise RefusedError(f"{path}: cannot be read: {error}") from None
    if not isinstance(rows, list) or not rows:
        raise RefusedError(f"{path}: must have at least one row")
    for place, row in enumerate(rows, 1):
        for reason in faults_of(row):
            raise RefusedError(f"{path}: row {place}: {reason}")
    return rows


def read_bytes(path: Path) -> bytes:
    """Return the content of a regular file of a limited size; pipes are not waited for.

    Raises
    ------
    RefusedError
        It is no regular file, or larger.
    OSError
        It cannot be opened.
    """
    with open(os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise RefusedError(f"{path}: is no regular file")
        content = file.read(LARGEST_BYTES + 1)
    if len(content) > LARGEST_BYTES:
        raise RefusedError(f"{path}: must have at most {LARGEST_BYTES} bytes")
    return content


def faults_of(row: Any) -> Iterable[str]:
    """Say which field of a row is missing or of another type."""
    held = row if isinstance(row, dict) else {}
    for name in FIELDS:
        value = held.get(name)
        if name not in held or (value is None and name != "value"):
            yield f"{name} = missing: must be given"
        elif name != "value" and not isinstance(value, str):
            yield f"{name}: must be text"
        elif isinstance(value, dict | list):
            yield f"{name}: must be a number"


if __name__ == "__main__":
    sys.exit(main())
