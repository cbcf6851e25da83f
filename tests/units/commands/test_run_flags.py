"""Each flag of `run`, and what all commands share; radiation is made up."""

import json
import os
import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from support import ROOT, TINY, assert_refused, command_here, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.pipeline.study import run as run_study

TIME = r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d "


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Made-up radiation."""
    monkeypatch.setattr(
        pipeline,
        "run",
        lambda study, progress: run_study(study, progress, made_up_radiation),
        raising=False,
    )


def a_study(folder: Path, name: str, *changes: tuple[str, str]) -> Path:
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / name).write_text(text)
    return folder / name


@pytest.mark.long
def test_several_studies_as_json(tmp_path: Path) -> None:
    files = [a_study(tmp_path, f"{name}.toml") for name in ("one", "two")]
    outcome = command_here("run", *files, "--out", tmp_path / "out", "--json")
    assert outcome.returncode == 0, outcome.stderr
    envelope = json.loads(outcome.stdout)
    tables, written = envelope["tables"], envelope["files"]
    assert tables["studies"]["study"] == ["one.toml", "two.toml"]
    assert tables["studies"]["kwave_difference_db"] == [None, None]
    assert tables["microphones"] == {
        "study": ["one.toml", "two.toml"],
        "microphone": ["front_1m"] * 2,
        "method": ["given transfer vectors"] * 2,
        "reason": ["transfer vectors are given to the run"] * 2,
    }
    for name in ("one", "two"):
        assert written[f"{name}/report"] == str(tmp_path / "out" / name / "report.html")
        assert Path(written[f"{name}/results"]).is_file()
        compared = tables[f"{name}/comparison"]
        rows = {option: row for row, option in enumerate(compared["option"])}
        none, half = rows["none"], rows["counterweight-half"]
        assert compared["change_1x_db"][none] == 0.0
        assert compared["force_1x_n"][half] < compared["force_1x_n"][none]
        assert set(tables[f"{name}/scores"]["rank_topsis"]) == {1.0, 2.0}


def test_all_studies_are_read_before_the_first_runs(tmp_path: Path) -> None:
    good = a_study(tmp_path, "good.toml")
    bad = a_study(tmp_path, "bad.toml", ("share_ratio = 0.5", "share_ratio = 7.0"))
    assert_refused(command_here("run", good, bad, "--out", tmp_path / "out"), "bad.toml", "share")
    assert not (tmp_path / "out").exists()


def test_two_studies_of_one_name_are_refused(tmp_path: Path) -> None:
    file = a_study(tmp_path, "one.toml")
    outcome = command_here("run", file, file, "--out", tmp_path / "out")
    assert_refused(outcome, "two studies would write to")


def test_quiet(tmp_path: Path) -> None:
    file = a_study(tmp_path, "one.toml")
    outcome = command_here("run", file, "--quiet", "--out", tmp_path / "out")
    assert (outcome.returncode, outcome.stdout, outcome.stderr) == (0, "", "")
    assert (tmp_path / "out" / "report.html").is_file()


def test_verbose_and_log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("support.without_progress", lambda errors: errors)
    file, log = a_study(tmp_path, "one.toml"), tmp_path / "log.txt"
    outcome = command_here("run", file, "--verbose", "--log", log, "--out", tmp_path / "out")
    assert outcome.returncode == 0, outcome.stderr
    told = outcome.stderr.splitlines()
    assert "progress: forces: done in 0 s" in told
    assert any(line.startswith("progress: report: done in ") for line in told)
    lines = log.read_text().splitlines()
    assert all(re.match(TIME, line) for line in lines)
    logged = [re.sub(TIME, "", line) for line in lines]
    assert [line for line in logged if line.startswith("progress")] == told
    assert logged[0] == "run: one.toml"
    assert logged[-1] == f"report: {tmp_path / 'out' / 'report.html'}"


def test_log_holds_errors(tmp_path: Path) -> None:
    bad = a_study(tmp_path, "bad.toml", ("share_ratio = 0.5", "share_ratio = 7.0"))
    log = tmp_path / "log.txt"
    outcome = command_here("run", bad, "--log", log)
    assert_refused(outcome, "share_ratio")
    assert re.sub(TIME, "", log.read_text()) == outcome.stderr
    refused = command_here("run", bad, "--log", tmp_path / "none" / "log.txt")
    assert_refused(refused, "log.txt", "cannot be written")


def test_nothing_to_coarsen_is_told(tmp_path: Path) -> None:
    closed = ("room_spacing_mm = 60.0", 'room_spacing_mm = 60.0\nroom_solver = "closed-form"')
    file = a_study(tmp_path, "one.toml", closed)
    outcome = command_here("run", file, "--coarse", "--out", tmp_path / "out")
    assert outcome.returncode == 0, outcome.stderr
    assert "one.toml: has nothing to coarsen; it runs in full" in outcome.stderr


def test_coarse(tmp_path: Path) -> None:
    file = a_study(
        tmp_path, "one.toml", ("[2900.0]", "{ start = 2500.0, stop = 3400.0, step = 50.0 }")
    )
    outcome = command_here("run", file, "--coarse", "--out", tmp_path / "out")
    assert outcome.returncode == 0, outcome.stderr
    assert "coarse: 8 of 19 speeds" in outcome.stdout  # seven, and that of the published level
    assert "coarse: image sources in closed form instead of k-Wave" in outcome.stdout
    report = (tmp_path / "out" / "report.html").read_text()
    assert "This is a first look, coarser than the study says" in report
    assert "8 of 19 speeds" in report
    rows = (tmp_path / "out" / "comparison.csv").read_text().splitlines()
    assert len(rows) - 1 == 8 * 2


def test_score_writes_a_report(tmp_path: Path) -> None:
    more = "[scoring.criteria]\nadded_mass_kg = { weight = 1.0, best = 0.0, worst = 1e-3 }\n"
    other = a_study(tmp_path, "other.toml", ("[scoring.criteria]\n", more))
    file = a_study(tmp_path, "one.toml")
    assert command_here("run", file, "--out", tmp_path / "out").returncode == 0
    results = tmp_path / "out" / "results.nc"
    before = results.read_bytes()
    outcome = command_here("score", results, "--scoring", other)
    assert outcome.returncode == 0, outcome.stderr
    assert results.read_bytes() == before
    scored = tmp_path / "out" / "scored"
    assert f"report: {scored / 'report.html'}" in outcome.stdout
    assert "added_mass_kg" in (scored / "scores.csv").read_text().splitlines()[0]
    again = command_here("score", scored / "results.nc", "--out", tmp_path / "again")
    assert again.returncode == 0, again.stderr
    assert again.stdout.splitlines()[:-2] == outcome.stdout.splitlines()[:-2]
    assert (tmp_path / "again" / "scores.csv").read_bytes() == (scored / "scores.csv").read_bytes()


def test_version() -> None:
    outcome = command_here("--version")
    assert outcome.stdout == f"vibroacoustics {version('vibroacoustics')}\n"


def test_completion() -> None:
    words = {"COMP_WORDS": "vibroacoustics ch", "COMP_CWORD": "1"}
    environment = {**os.environ, **words, "_VIBROACOUSTICS_COMPLETE": "complete_bash"}
    program = "import sys; sys.argv = ['vibroacoustics']; from vibroacoustics.__main__ import main"
    outcome = subprocess.run(
        [sys.executable, "-c", f"{program}; main()"],
        env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert sorted(outcome.stdout.split()) == ["check", "check-functions"]
