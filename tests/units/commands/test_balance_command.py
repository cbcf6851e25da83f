"""Command balance: page, bench sheet, tables, pictures and remarks; template of `new balance`."""

import csv
import json
from html import unescape

import numpy as np
import pytest
from support import command_here
from trial_run_files import file_text, written

from vibroacoustics.commands.balancing.template import TEMPLATE

FILES = {
    "balancing.html", "bench.html", "weights.csv", "readings.csv", "answers.csv", "influence.csv",
    "plane_front.svg", "plane_rear.svg",
}  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Results of the template."""
    folder = tmp_path_factory.mktemp("balance")
    assert command_here("new", "balance", "--out", folder / "fan").returncode == 0
    assert (folder / "fan" / "balancing.toml").read_text() == TEMPLATE
    words = "balance", folder / "fan" / "balancing.toml", "--out", folder / "out"
    outcome = command_here(*words, "--json")
    assert outcome.returncode == 0, outcome.stderr
    (folder / "outcome.json").write_text(outcome.stdout)
    return folder


def test_the_template_is_balanced(folder):
    envelope = json.loads((folder / "outcome.json").read_text())
    assert envelope["warnings"] == []
    weights = envelope["tables"]["weights"]
    assert weights["plane"] == ["front", "front", "rear", "rear"]
    assert weights["hole"] == [2.0, 3.0, 4.0, 5.0]
    assert weights["angle_deg"] == pytest.approx([30.0, 60.0, 90.0, 120.0])
    assert {path.name for path in (folder / "out").iterdir()} >= FILES
    readings = envelope["tables"]["readings"]
    low, middle, high = (np.array(readings[f"after_{of}"]) for of in ("low", "median", "high"))
    assert np.all(low < middle)
    assert np.all(middle < high)
    assert np.all(high < 0.2 * np.array(readings["before"]))


def test_the_bench_sheet_alone_names_hole_mass_and_reading(folder):
    text = unescape((folder / "out" / "bench.html").read_text())
    with (folder / "out" / "weights.csv").open() as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        assert f"{float(row['mass_g']):.3g} g in hole {float(row['hole']):.0f}" in text
    assert "all trial weights are out" in text
    assert "The shaft turns counterclockwise; angles of weights count against rotation" in text
    assert "Next reading, 80 % with its scatter" in text
    assert text.count("<img") == 2


def test_remarks_are_warnings_and_on_the_page(tmp_path):
    runs = {
        "first": (np.zeros(1, dtype=complex), np.array([2.0 + 0j])),
        "trial": (np.array([1.0 + 0j]), np.array([2.1 + 0j])),
    }
    path = written(tmp_path, file_text(runs))
    outcome = command_here("balance", path, "--out", tmp_path / "out")
    assert outcome.returncode == 0
    for words in ("the trial weight in plane plane_1 is weak", "scatter of sensor_1 is unknown"):
        assert words in outcome.stderr
        assert words in (tmp_path / "out" / "balancing.html").read_text()
    assert "80 %: unknown" in outcome.stdout


def test_a_bad_file_writes_nothing(tmp_path):
    path = written(tmp_path, "amplitudes = 3\n")
    outcome = command_here("balance", path, "--out", tmp_path / "out")
    assert outcome.returncode == 2
    assert outcome.stderr.count("error: ") == 1
    assert "has no runs: must have tables [runs.NAME]" in outcome.stderr
    assert not (tmp_path / "out").exists()
