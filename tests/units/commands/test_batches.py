"""Batches of files: one that fails late costs itself alone; broken files are named together."""

import json
import shutil
from pathlib import Path

import pytest
from support import ROOT, TINY, assert_refused, command_here, tiny_run

from vibroacoustics.base.errors import ParameterError, SolverError, StorageError, gathered
from vibroacoustics.commands import study_commands
from vibroacoustics.commands.outcome import Outcome
from vibroacoustics.report.analysis import Analysis
from vibroacoustics.results.storage import write_results


def failing(number: int) -> int:
    """Double a number; odd ones fail, the last by another type of error."""
    if number % 2:
        raise (StorageError if number < 5 else ParameterError)(f"{number}: is odd")
    return 2 * number


def test_errors_of_all_items_come_together() -> None:
    assert gathered(failing, [2, 4]) == [4, 8]
    with pytest.raises(StorageError, match=r"^1: is odd$"):
        gathered(failing, [2, 1])
    with pytest.raises(StorageError) as refusal:
        gathered(failing, [1, 3, 1, 2])
    assert refusal.value.args == ("1: is odd", "3: is odd")
    with pytest.raises(ParameterError) as refusal:
        gathered(failing, [1, 5])
    assert refusal.value.args == ("1: is odd", "5: is odd")


def _studies(folder: Path, *names: str) -> list[Path]:
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    for name in names:
        (folder / f"{name}.toml").write_text(text)
    return [folder / f"{name}.toml" for name in names]


@pytest.fixture
def run_of(monkeypatch: pytest.MonkeyPatch) -> None:
    """Studies run in no time; those whose name begins with `late` fail at the end."""

    def run(study, folder, *_):
        if study.source_file.startswith("late_memory"):
            raise MemoryError("unable to allocate 9 TiB")
        if study.source_file.startswith("late"):
            raise SolverError("no convergence", "at 2900 rpm")
        tables = {"studies": {"study": [study.source_file]}, "microphones": {}}
        return Outcome(
            tables=tables, analyses={"": Analysis("a", folder.name, "Machine", "", "", ())}
        )

    monkeypatch.setattr(study_commands, "_run", run)


def test_other_studies_finish(tmp_path: Path, run_of: None) -> None:
    files = _studies(tmp_path, "late", "one", "late_memory", "two")
    done = command_here("run", *files, "--out", tmp_path / "out", "--no-cache", "--json")
    assert done.returncode == 3, done.stderr
    assert done.stderr.splitlines() == [
        f"warning: {files[0]} is omitted: no convergence; at 2900 rpm",
        f"warning: {files[2]} is omitted: not enough memory: unable to allocate 9 TiB",
    ]
    tables = json.loads(done.stdout)["tables"]
    assert tables["studies"]["study"] == ["one.toml", "two.toml"]
    assert tables["omitted"]["study"] == [str(files[0]), str(files[2])]
    assert tables["omitted"]["reason"][0] == "no convergence; at 2900 rpm"


def test_studies_that_all_fail_are_refused(tmp_path: Path, run_of: None) -> None:
    files = _studies(tmp_path, "late_1", "late_2")
    done = command_here("run", *files, "--out", tmp_path / "out", "--no-cache")
    for file in files:
        assert_refused(done, f"{file}: no convergence; at 2900 rpm")
    alone = command_here("run", files[0], "--out", tmp_path / "out", "--no-cache")
    assert alone.returncode == 2
    assert alone.stderr.splitlines() == ["error: no convergence", "error: at 2900 rpm"]


def test_all_bad_studies_are_named_before_the_first_runs(tmp_path: Path) -> None:
    good, *bad = _studies(tmp_path, "good", "bad", "worse")
    for file in bad:
        file.write_text(file.read_text().replace("share_ratio = 0.5", "share_ratio = 7.0"))
    done = command_here("run", bad[0], good, bad[1], "--out", tmp_path / "out")
    for file in bad:
        assert_refused(done, file.name, "share")
    assert not (tmp_path / "out").exists()


def test_all_broken_functions_of_a_prediction_are_named(tmp_path: Path) -> None:
    settings = """
title = "bench"
[measured]
frequency_responses = ["a.uff", "b.uff"]
operating = ["c.uff", "d.uff"]
points.foot = { node = 1, direction = "+z" }
microphones.front = { node = 2 }
[changes.heavier.masses.foot]
points = ["foot"]
mass_kg = 1.0
"""
    (tmp_path / "bench.toml").write_text(settings)
    (tmp_path / "a.uff").write_bytes(b"")
    shutil.copy(ROOT / "README.md", tmp_path / "c.uff")
    done = command_here("predict", tmp_path / "bench.toml", "--out", tmp_path / "out")
    for name in "abcd":
        assert_refused(done, f"{tmp_path / name}.uff: ")
    assert len(done.stderr.splitlines()) == 4


def test_all_broken_results_of_a_comparison_are_named(tmp_path: Path) -> None:
    (tmp_path / "a.nc").write_bytes(b"")
    write_results(tiny_run(), tmp_path / "study.nc")
    others = [tmp_path / "a.nc", tmp_path / "b.nc"]
    done = command_here("compare", tmp_path / "study.nc", *others, "--out", tmp_path / "out")
    for file in others:
        assert_refused(done, f"{file}: ")
