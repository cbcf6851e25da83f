"""`vibroacoustics cache`, `--no-cache` and what `score`, `report` and `doctor` say of a folder."""

import json
import os
import warnings
from pathlib import Path

import pytest
import xarray as xr
from support import ROOT, TINY, assert_refused, command_here, tiny_run

from vibroacoustics import open_results, report, write_report
from vibroacoustics.base.plain_bytes import sha256
from vibroacoustics.commands import messages
from vibroacoustics.results import cache, storage


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return cache.folder()


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return tiny_run()


def test_lists_limits_and_clears(folder, results):
    for n in range(3):
        storage.cached("kind", {"a": n}, lambda: results, "" if n else "First study")
    lines = command_here("cache").stdout.splitlines()
    assert len(lines) == 4
    assert lines[0].endswith(".nc  First study")
    assert lines[1].endswith(".nc  unknown study")
    assert f"{folder}: 3 results" in lines[3]
    assert "of at most 2000 MB" in lines[3]
    lines = command_here("cache", "--limit", "0.0012").stdout.splitlines()
    assert lines[0].startswith("removed 2 results")
    assert "1 results" in lines[-1]
    assert "of at most 1.2 MB" in lines[-1]
    lines = command_here("cache", "--clear").stdout.splitlines()
    assert lines[0].startswith("removed 1 results")
    assert cache.contents()[0] == []


def test_an_empty_cache_is_no_error(folder):
    assert "0 results" in command_here("cache").stdout
    assert "0 results" in command_here("cache", "--clear").stdout
    assert not folder.exists()


def test_bad_limits(folder, tmp_path, monkeypatch):
    for limit in ("nan", "inf", "-1"):
        assert command_here("cache", "--limit", limit).returncode == 2
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert_refused(command_here("cache", "--limit", "1"), "cannot be written")


@pytest.fixture
def study(tmp_path) -> Path:
    """The tiny study, its room in closed form."""
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file = tmp_path / "study.toml"
    file.write_text(text.replace("[radiation]\n", '[radiation]\nroom_solver = "closed-form"\n'))
    return file


@pytest.mark.long
def test_no_cache(folder, study, tmp_path):
    outcome = command_here("radiation", study, "--no-cache", "--out", tmp_path / "out")
    assert (outcome.returncode, outcome.stderr) == (0, "")
    assert not folder.exists()
    assert (
        open_results(tmp_path / "out" / "transfer_vectors.nc")
        .attrs["transfer_vectors"]
        .startswith("comp")
    )


def test_a_folder_whose_name_is_no_utf_8(tmp_path):
    outcome = command_here("radiation", TINY, "--out", os.fsdecode(bytes(tmp_path) + b"/caf\xe9"))
    assert_refused(outcome, "the name is no UTF-8")


@pytest.mark.long
def test_a_cache_that_cannot_be_written_costs_one_line(study, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    outcome = command_here("radiation", study, "--out", tmp_path / "out")
    assert outcome.returncode == 0
    (line,) = outcome.stderr.splitlines()
    assert line.startswith("warning: cache ")
    assert line.endswith("the run goes on without it")


def test_a_warning_of_two_modules_comes_once(capsys):
    with messages.warnings_in_one_line():
        for module in ("one", "two"):
            warnings.warn_explicit("cache full", UserWarning, f"{module}.py", 1, module, {})
        warnings.warn("cache empty", stacklevel=1)
    assert capsys.readouterr().err == "warning: cache full\nwarning: cache empty\n"


# --- files of one run ----------------------------------------------------------------------------


def test_every_file_carries_the_hash_of_its_results(results, tmp_path):
    write_report(results, tmp_path)
    _, digest = storage.open_with_hash(tmp_path / "results.nc")
    assert (
        f'<meta name="results-sha256" content="{digest}">' in (tmp_path / "report.html").read_text()
    )
    outcome = command_here("doctor", tmp_path)
    assert f"results: {tmp_path}/results.nc: fits its hash" in outcome.stdout
    assert "files that belong together" in outcome.stdout


@pytest.fixture
def few_files(monkeypatch) -> None:
    """A report of two small files: what they hold is no subject."""
    tables = {"comparison.csv": {"option": ["none"]}}
    analysis = report.Analysis("report", "", "", "", "", (), tables=tables)
    monkeypatch.setattr(report, "analysis_of_study", lambda _: analysis)


@pytest.mark.usefixtures("few_files")
def test_a_mixed_folder_is_named_and_mended(results, tmp_path):
    write_report(results, tmp_path)
    (tmp_path / "comparison.csv").write_text("of another run\n")
    (tmp_path / "sources.csv").write_text("of a run long ago\n")
    line = f"{tmp_path}/comparison.csv: is not that of results.nc"
    assert command_here("score", tmp_path / "results.nc").stderr == f"warning: {line}\n"
    assert f"results: {line}\n" in command_here("doctor", tmp_path).stdout
    outcome = command_here("report", tmp_path / "results.nc")
    left = f"{tmp_path}/sources.csv: is not of these results"
    assert (outcome.returncode, outcome.stderr) == (0, f"warning: {left}\n")
    assert command_here("score", tmp_path / "results.nc").stderr == ""


@pytest.mark.usefixtures("few_files")
def test_a_file_of_an_older_run_is_named_by_readers(results, tmp_path):
    """Left by a run that was killed before it removed what it no longer makes."""
    write_report(results, tmp_path)
    path, entry = tmp_path / "sources.csv", tmp_path / "files.json"
    path.write_text("of an older run\n")
    known = json.loads(entry.read_text())
    known["results.nc"]["older"] = {"sources.csv": sha256(path.read_bytes())}
    entry.write_text(json.dumps(known))
    line = f"{path}: is of older results than results.nc"
    assert command_here("score", tmp_path / "results.nc").stderr == f"warning: {line}\n"
    assert command_here("doctor", tmp_path).stdout.count(str(path)) == 1
    outcome = command_here("report", tmp_path / "results.nc")
    assert (outcome.returncode, outcome.stderr, path.exists()) == (0, "", False)


def test_a_report_that_fails_leaves_the_older_run(results, tmp_path, monkeypatch):
    write_report(results, tmp_path)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    monkeypatch.setattr("vibroacoustics.report.study.terminal_blocks", lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_report(results.assign_attrs(title="another"), tmp_path)
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_doctor_names_damaged_results(results, tmp_path):
    path = storage.write_results(results, tmp_path / "results.nc")
    path.write_bytes(path.read_bytes()[:-100])
    assert f"results: {path}: has no hash" in command_here("doctor", tmp_path).stdout
    assert (
        f"results: {tmp_path}/none: is no folder"
        in command_here("doctor", tmp_path / "none").stdout
    )
