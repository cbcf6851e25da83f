"""Growth of a compressor's level with speed: makers' levels at two speeds."""

import csv

import numpy as np
import pytest
from support import PIPELINES, ROOT

from vibroacoustics.machine.remainder import Remainder
from vibroacoustics.study.loading import load_study

ROUNDED_DB = 1.0
"""Of the difference of two levels that are each rounded to 1 dB."""


def growth(row, change_db):
    """Decibels for ten times the speed."""
    return change_db / np.log10(float(row["fast_rpm"]) / float(row["slow_rpm"]))


def change(row):
    return float(row["fast_level_dba"]) - float(row["slow_level_dba"])


@pytest.fixture(scope="module")
def rows():
    with (ROOT / "data" / "validation" / "catalogue_levels.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


@pytest.mark.parametrize("left_out", range(3))
def test_each_machine_lies_in_the_band_of_the_others(rows, left_out):
    row = rows.pop(left_out)
    lowest = min(growth(other, change(other) - ROUNDED_DB) for other in rows)
    highest = max(growth(other, change(other) + ROUNDED_DB) for other in rows)
    rows.insert(left_out, row)
    assert lowest <= growth(row, change(row)) <= highest


def test_range_of_the_growth_holds_every_machine(rows):
    """And no end of it is more than half a decibel off all that were printed."""
    study = load_study(PIPELINES / "copeland_thesis.toml")
    (record,) = [r for r in study.records if r.field.endswith("remainder.speed_growth_db")]
    for row in rows:
        low, high = (growth(row, change(row) + sign * ROUNDED_DB) for sign in (-1.0, 1.0))
        assert low <= record.highest
        assert record.lowest <= high
    printed = [growth(row, change(row)) for row in rows]
    assert record.lowest == pytest.approx(min(printed), abs=0.5)
    assert record.highest == pytest.approx(max(printed), abs=0.5)


def test_a_printed_change_comes_out(rows):
    row = rows[0]  # 70 dB(A) at 50 Hz, 72 at 60 Hz
    law = Remainder(speed_growth_db=growth(row, change(row)))
    factor = law.speed_factor(np.array([float(row["fast_rpm"])]), float(row["slow_rpm"]))
    assert 10.0 * np.log10(factor) == pytest.approx([2.0])
