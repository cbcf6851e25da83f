"""Growth of a compressor's level with speed, and hoods: levels that makers print."""

import csv
from collections import defaultdict
from statistics import median

import numpy as np
import pytest
from support import MACHINE_FILE, PIPELINES, ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.remainder import UnmodelledNoise
from vibroacoustics.machine.speed_growth import (
    RECIPROCATING,
    SCROLL_OR_SCREW,
    LevelPair,
    growth_of_pair,
    growth_of_series,
)
from vibroacoustics.study.loading import load_machine, load_study

RPM_AND_LEVELS = ("slow_rpm", "slow_level_dba", "fast_rpm", "fast_level_dba")
KINDS = {"reciprocating": RECIPROCATING, "scroll or screw": SCROLL_OR_SCREW}


@pytest.fixture(scope="module")
def rows():
    with (ROOT / "data" / "validation" / "published_levels.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


@pytest.fixture(scope="module")
def series(rows):
    """Pairs of levels by kind and series."""
    by_kind = defaultdict(lambda: defaultdict(list))
    for row in rows:
        if row["fast_level_dba"]:
            pair = LevelPair(*(float(row[name]) for name in RPM_AND_LEVELS))
            by_kind[row["kind"]][row["series"]].append(pair)
    return by_kind


def test_growth_of_a_kind_is_that_of_its_series(series):
    assert series.keys() == KINDS.keys()
    for kind, by_series in series.items():
        assert growth_of_series(by_series.values()) == pytest.approx(KINDS[kind], abs=0.06)


def test_a_series_is_predicted_by_the_others(series):
    """80 % of 16 pairs are 13; 11 to 16 lie in their intervals with 90 % probability.

    The seven pairs of SAB are one statement of their maker, "add 2 dB(A) at 60 Hz": six of ten
    independent statements lie in their intervals.
    """
    inside, widths = defaultdict(list), []
    for by_series in series.values():
        for name, pairs in by_series.items():
            others = growth_of_series([by_series[other] for other in by_series if other != name])
            for pair in pairs:
                low, high = others.change_interval_db(pair)
                widths.append(high - low)
                inside[name].append(low <= pair.fast_level_db - pair.slow_level_db <= high)
    total = sum(map(sum, inside.values()))
    assert inside["SAB"] == [inside["SAB"][0]] * 7
    statements = total - 6 * inside["SAB"][0]
    print(f"{total} of {len(widths)} pairs inside, {statements} of 10 statements")
    print(f"median width {median(widths):.1f} dB")
    assert len(widths) == 16
    assert 11 <= total <= 16
    assert median(widths) < 4.0


def test_equal_series_leave_the_error_of_rounding():
    """Two series of one pair each: 2 dB from 3000 to 3600 rpm; by hand."""
    pair = LevelPair(3000.0, 70.0, 3600.0, 72.0)
    growth = growth_of_series([[pair], [pair]])
    rounding = np.sqrt(1.0 / 6.0) / np.log10(1.2)
    assert growth == pytest.approx((2.0 / np.log10(1.2), rounding * np.sqrt(1.5)))
    assert growth_of_pair(pair) == pytest.approx((2.0 / np.log10(1.2), rounding))


def test_the_range_has_the_interval_of_the_growth():
    """The middle 80 % of an even range, 1.2816 deviations on either side."""
    low, high = SCROLL_OR_SCREW.range_db
    half = 0.8 * (high - low) / 2.0
    assert half == pytest.approx(1.2816 * SCROLL_OR_SCREW.deviation_db, rel=1e-4)


@pytest.mark.parametrize(
    ("study", "growth"), [("copeland_thesis", SCROLL_OR_SCREW), ("mayekawa_wbhe", RECIPROCATING)]
)
def test_a_machine_has_the_growth_of_its_kind(study, growth):
    study = load_study(PIPELINES / f"{study}.toml")
    (record,) = [r for r in study.records if r.field.endswith("remainder.speed_growth_db")]
    assert study.machine.remainder.speed_growth_db == pytest.approx(growth.mean_db)
    assert (record.lowest, record.highest) == pytest.approx(growth.range_db, abs=0.051)


def with_noise(folder, lines):
    text = MACHINE_FILE.read_text()
    head, tail = text.split("[overall_noise]\n")
    file = folder / "machine.toml"
    file.write_text(f"{head}[overall_noise]\n{lines}{tail}")
    return file


def test_two_published_levels_override_the_kind(tmp_path):
    """56 dB(A) at 2900 rpm and 58 dB(A) at 3500 rpm."""
    value = '{{ value = {}, source = "Maker" }}\n'
    lines = f"other_speed_rpm = {value.format(3500.0)}other_level_dba = {value.format(58.0)}"
    machine = load_machine(with_noise(tmp_path, lines))
    expected = 2.0 / np.log10(3500.0 / 2900.0)
    assert machine.remainder.speed_growth_db == pytest.approx(expected, abs=0.051)
    with pytest.raises(ParameterError, match="give both or none"):
        load_machine(with_noise(tmp_path, f"other_speed_rpm = {value.format(3500.0)}"))
    falling = f"other_speed_rpm = {value.format(3500.0)}other_level_dba = {value.format(55.0)}"
    assert load_machine(with_noise(tmp_path, falling)).remainder.speed_growth_db < 0.0
    same = f"other_speed_rpm = {value.format(2900.0)}other_level_dba = {value.format(58.0)}"
    with pytest.raises(ParameterError, match="must differ from speed_rpm"):
        load_machine(with_noise(tmp_path, same))


def test_a_printed_change_comes_out(rows):
    row = rows[0]  # 70 dB(A) at 50 Hz, 72 at 60 Hz
    pair = LevelPair(*(float(row[name]) for name in RPM_AND_LEVELS))
    factor = UnmodelledNoise(speed_growth_db=pair.growth_db).speed_factor(
        np.array([3600.0]), 3000.0
    )
    assert 10.0 * np.log10(factor) == pytest.approx([2.0])


def test_hoods_and_jackets(rows):
    """Every printed insertion loss is 6 to 8 dB(A)."""
    losses = [float(row[name]) for row in rows for name in ("slow_hood_db", "fast_hood_db")
              if row[name]]  # fmt: skip
    assert len(losses) == 25
    assert min(losses) == 6.0
    assert max(losses) == 8.0
    assert np.mean(losses) == pytest.approx(7.1, abs=0.1)
