"""Equal quantity, equal value: CSV, tables, first screen, comparison, limits, scores, sound."""

import csv
import io
import re

import numpy as np
import pytest
from sources_study import sources_run

from vibroacoustics import report
from vibroacoustics.base import rounding
from vibroacoustics.base.ellipse import semi_major_axis
from vibroacoustics.base.vocabulary import HIGH, LOW, NOMINAL, SUFFIXES, VARIABLES
from vibroacoustics.report.columns import COLUMNS
from vibroacoustics.report.sections.comparison import comparison_table
from vibroacoustics.report.sections.verdict import words as first_screen
from vibroacoustics.results.bands import band
from vibroacoustics.results.estimates import estimate
from vibroacoustics.results.figure_limit import FigureLimit
from vibroacoustics.results.figure_limits import Compared, check_figures
from vibroacoustics.results.order_comparison import channel_orders, compare
from vibroacoustics.results.stored_study import catalogue_receiver, nearest_speed
from vibroacoustics.sound.ingredients import ingredients

ROUNDED = 5.1e-9
"""Of nine significant digits."""
NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?")


@pytest.fixture(scope="module")
def results():
    return sources_run()


@pytest.fixture(scope="module")
def analysis(results):
    return report.analysis_of_study(results)


@pytest.fixture(scope="module")
def files(analysis):
    return analysis.files()


def rows_of(files, name):
    return list(csv.DictReader(io.StringIO(files[name].decode())))


def keys(row):
    return {"option": row["option"], "speed": float(row["speed_rpm"]), "receiver": row["receiver"]}


def test_every_column_is_the_estimate_of_its_variable(results, files):
    columns = [one for one in COLUMNS.values() if one.variable]
    assert len(columns) >= 14
    for row in rows_of(files, "comparison.csv"):
        for column in columns:
            known = estimate(results, column.variable, **keys(row), **column.at)
            stem, unit = column.name.rsplit("_", 1)
            names = [f"{stem}{suffix}_{unit}" for suffix in (SUFFIXES[LOW], "", SUFFIXES[HIGH])]
            got = [float(row[name.replace("__", "_")]) for name in names]
            assert got == pytest.approx(list(known), rel=ROUNDED, abs=1e-9), column.name
            assert f"{stem}{SUFFIXES[NOMINAL]}_{unit}" in row


def test_numbers_of_json_are_estimates_and_read_as_their_text(results, analysis):
    numbers = analysis.json()["numbers"]
    assert len(numbers) > 20
    for number in numbers:
        known = estimate(results, number["variable"], **number["selection"])
        assert number["value"] == known.value
        if number["low"] is not None:
            assert (number["low"], number["high"]) == (known.low, known.high)
            assert number["statistic"] == VARIABLES[number["variable"]].statistic


def test_columns_of_json_are_those_of_the_files(analysis, files):
    tables = analysis.json()["tables"]
    assert {f"{name}.csv" for name in tables} == {name for name in files if name.endswith(".csv")}
    for name, columns in tables.items():
        for row, values in zip(rows_of(files, f"{name}.csv"), zip(*columns.values(), strict=True),
                               strict=True):  # fmt: skip
            for cell, value in zip(row.values(), values, strict=True):
                if isinstance(value, float) and np.isfinite(value):
                    assert float(cell) == pytest.approx(value, rel=ROUNDED)


def test_terminal_is_headed_by_the_first_screen(results, analysis):
    """Value and interval of the total in the words of the page."""
    lines = analysis.text().splitlines()
    assert lines[0].startswith(first_screen.sentences(results)[0].split(" at ")[0])
    total = band(results, "level_total", option="none", speed=nearest_speed(results))
    assert total.middle_and_ends(rounding.level) in analysis.text()


def test_sources_have_the_estimates_of_level_and_share(results, files):
    for row in rows_of(files, "sources.csv"):
        at = {**keys(row), "sound_source": row["source"]}
        for name, column in (("source_level", "level_dba"), ("source_share", "share_of_energy")):
            value = estimate(results, name, **at).value
            assert float(row[column]) == pytest.approx(value, rel=ROUNDED, abs=1e-12)


def test_shares_add_up_to_the_whole(results):
    total = results["source_share"].sum("sound_source") + results["unmodelled_share"]
    assert total.values == pytest.approx(np.ones(total.shape), abs=1e-9)


def test_tables_show_the_values_of_the_file(results, files):
    """Each cell's first number is the value of the CSV to the digits that are shown."""
    rows = rows_of(files, "comparison.csv")
    receiver = catalogue_receiver(results)
    columns = {one.head: one for one in COLUMNS.values() if one.head}
    shown, speed, table = 0, nearest_speed(results), comparison_table(results)
    for cells in table.rows:
        row = next(
            one for one in rows
            if keys(one) == {"option": cells[0], "speed": speed, "receiver": receiver}
        )  # fmt: skip
        for head, cell in zip(table.head[2:], cells[2:], strict=True):
            number = NUMBER.match(str(cell))
            if number:
                text = number.group().replace("−", "-")
                column = columns[head]
                known = band(results, column.variable, **keys(row), **column.at)
                unit = max(known.units[1], 10.0 ** -len(text.partition(".")[2]))
                assert abs(float(text) - float(row[column.name])) <= 0.5001 * unit, head
                shown += 1
    assert shown > 20


def test_first_screen_has_numbers_of_the_files(results, files):
    """At most 90 words; every number is one of the CSV files, rounded as shown."""
    sentences = first_screen.sentences(results)
    assert sum(len(one.split()) for one in sentences) <= 90
    values = [
        float(cell)
        for name in ("comparison.csv", "sources.csv")
        for row in rows_of(files, name)
        for cell in row.values()
        if re.fullmatch(r"-?[\d.]+(?:e[+-]\d+)?", cell or "")
    ]
    percent = [100.0 * (10.0 ** (value / 20.0) - 1.0) for value in values]
    percent += [100.0 * value for value in values]
    numbers = [
        float(text.replace("−", "-"))
        for one in sentences
        for text in re.findall(r"[−+]?\d+(?:\.\d+)?", one.partition(": ")[2])
    ]
    assert numbers
    for number in numbers:
        near = min(abs(number - value) for value in [*values, *percent, 80.0, 0.5, 1.0, 56.0])
        assert near <= 0.5 * max(1.0, 10.0 ** np.floor(np.log10(max(abs(number), 1.0)))), number


def test_comparison_has_the_amplitudes_and_levels_of_the_file(results, files):
    row = rows_of(files, "comparison.csv")[0]
    at = keys(row)
    orders = channel_orders(results, at["option"]).sel(speed=at["speed"], order=1)
    force = np.array([orders.sel(channel=f"force {axis}").item() for axis in "xyz"])
    assert semi_major_axis(force, 0) == pytest.approx(float(row["force_1x_n"]), rel=1e-9)
    pressure = abs(orders.sel(channel=f"pressure {at['receiver']}").item()) / np.sqrt(2.0)
    level = 20.0 * np.log10(pressure / 2e-5)
    assert level == pytest.approx(float(row["level_1x_db"]), abs=1e-4)  # in single precision


def test_limits_and_sound_have_the_total_of_the_file(results, files):
    compared = Compared(compare(results, results), results, results)
    limits = check_figures(compared, [FigureLimit(60.0, "dB(A)", "*")])
    rows = {
        (f"total of pressure {row['receiver']}", float(row["speed_rpm"])): row
        for row in rows_of(files, "comparison.csv")
        if row["option"] == "none"
    }
    for limit in limits:
        value = float(rows[limit.figure, limit.speed_rpm]["level_total_dba"])
        assert limit.value == pytest.approx(value, abs=1e-6)
        assert 0.0 <= limit.probability <= 1.0
    for row in rows_of(files, "comparison.csv"):
        at = keys(row)
        sound = ingredients(results, at["option"], at["receiver"], at["speed"])
        assert sound.a_weighted_db == pytest.approx(float(row["level_total_dba"]), abs=0.01)


def test_scores_have_the_forces_of_the_file_at_a_single_speed(results, files):
    (speed,) = results["speed"].values
    receiver, compared = catalogue_receiver(results), 0
    for row in rows_of(files, "comparison.csv"):
        at = keys(row)
        if at["receiver"] == receiver and at["speed"] == speed:
            for criterion, column in (
                ("foot_force_1x_n", "foot_force_1x_n"), ("residual_moment_nm", "moment_1x_nm"),
            ):  # fmt: skip
                if criterion not in results["criterion"]:
                    continue
                value = results["criterion_value"].sel(criterion=criterion, option=at["option"])
                assert value.item() == pytest.approx(float(row[column]), rel=1e-6)
                compared += 1
    assert compared >= results.sizes["option"]
