"""CSV that no spreadsheet takes for formulas."""

import csv
import io

import pytest

from vibroacoustics.base.csv_text import csv_bytes, defused, fused

FORMULAS = ("=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", " =1", "'=1", "''-x")
HARMLESS = ("none", "counterweight-half", "'quoted'", "", "a=b", "−3", "1×")


@pytest.mark.parametrize("text", FORMULAS)
def test_text_that_would_be_a_formula_is_defused(text: str) -> None:
    (head, row) = csv.reader(io.StringIO(csv_bytes([text], [[text]]).decode(), newline=""))
    assert head == row == [f"'{text}"]


def test_a_carriage_return_ends_no_row() -> None:
    assert csv_bytes(["name"], [["\r=1\r2"]]) == b"name\n' =1 2\n"


@pytest.mark.parametrize("text", HARMLESS)
def test_other_text_stays(text: str) -> None:
    assert defused(text) == text


@pytest.mark.parametrize("text", [*FORMULAS, *HARMLESS])
def test_fused_is_the_inverse(text: str) -> None:
    assert fused(defused(text)) == text


def test_numbers_stay_numbers() -> None:
    assert csv_bytes(["change"], [[-3.2], [1e-9]]) == b"change\n-3.2\n1e-09\n"
