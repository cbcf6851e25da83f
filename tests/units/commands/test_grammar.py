"""Every command on a small input: its flags, its JSON by the schema, its help and exit codes."""

import csv
import json
import re
import sys
import warnings
from importlib.metadata import version
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
import typer
from command_lines import CASES, PRINTS_ONLY, command_lines, made_up_fields, words_of, write_inputs
from json_schema import faults
from support import assert_refused, command_here, tiny_run

import vibroacoustics as va
from vibroacoustics.base.errors import PlatformError
from vibroacoustics.base.fault import FaultError, Owner, leave_out
from vibroacoustics.commands import cli, starter
from vibroacoustics.commands.command import COMMANDS, JOBS
from vibroacoustics.commands.outcome import SCHEMA
from vibroacoustics.results.claim_kinds import KINDS, MEAN_INTERVAL, UNCONDITIONAL
from vibroacoustics.results.storage import write_results

WRITES_ONLY = {"report", "new", "export", "schema", "cache", "doctor"}
"""Commands that compute nothing; all others have `--verbose` and `--log`."""


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a small input of every kind."""
    folder = tmp_path_factory.mktemp("inputs")
    write_inputs(folder)
    return folder


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Made-up radiation, figures without pixels, an empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    made_up_fields(monkeypatch)


def options_of(name: str) -> set[str]:
    group = typer.main.get_command(cli.app)
    return {word for parameter in group.commands[name].params for word in parameter.opts}


def test_every_command_has_a_case_and_a_job() -> None:
    assert set(CASES) == set(COMMANDS)
    assert {each.job for each in COMMANDS.values()} == set(JOBS)


def test_command_lines_have_all_commands_and_their_inputs(tmp_path: Path) -> None:
    """Each begins with its command, its files exist, and its results go to a folder of its own."""
    lines = command_lines(tmp_path)
    assert set(lines) == set(COMMANDS)
    assert command_lines(tmp_path) == lines
    for name, words in lines.items():
        assert words[0] == name
        files = [word for word in words if str(tmp_path / "inputs") in word]
        assert all(Path(file).is_file() for file in files)
        own = [word for word in words if str(tmp_path / "out" / name) in word]
        assert len(own) == (name not in PRINTS_ONLY)


@pytest.mark.parametrize("name", list(COMMANDS))
def test_flags(name: str) -> None:
    flags = options_of(name)
    assert {"--json", "--quiet"} <= flags
    assert ({"--verbose", "--log"} <= flags) == (name not in WRITES_ONLY)
    assert ("--out" in flags) == (name not in PRINTS_ONLY)
    assert not {"--receiver", "--listener", "--mic", "--microphones"} & flags
    outcome = command_here(name, "-h")
    assert outcome.returncode == 0
    assert f"Example:\n  vibroacoustics {name}" in outcome.stdout
    assert not re.search(r"<\w|FILE\.py|\w\.toml|\w\.\.\. +\S", outcome.stdout.split("Example:")[0])


@pytest.mark.parametrize("name", list(COMMANDS))
def test_json_and_quiet(name: str, inputs: Path, tmp_path: Path) -> None:
    words = words_of(name, inputs, tmp_path / "out")
    log = () if name in WRITES_ONLY else ("--verbose", "--log", tmp_path / "log.txt")
    outcome = command_here(*words, "--json", *log)
    assert outcome.returncode == 0, outcome.stderr
    envelope = json.loads(outcome.stdout)
    assert list(faults(envelope, SCHEMA)) == []
    assert (envelope["command"], envelope["errors"]) == (name, [])
    assert "as_json" not in envelope["inputs"]
    files = {label: Path(path) for label, path in envelope["files"].items()}
    assert bool(files) == (name not in PRINTS_ONLY)
    assert all(path.is_file() for path in files.values())
    written = {
        path for path in (tmp_path / "out").rglob("*.*") if path.parent.name[-6:] != "pieces"
    }
    ours = {path for path in written if path.name not in (".lock", "files.json")}
    assert ours <= set(files.values())
    for label, path in files.items():
        if label.endswith(".csv"):
            head = next(csv.reader(path.read_text(encoding="utf-8").splitlines()))
            assert list(envelope["tables"][label.removesuffix(".csv")]) == head
    check_numbers(envelope["numbers"], files.get("results", Path()))
    check_claims(name, envelope["tables"])
    if log:
        assert (tmp_path / "log.txt").read_text()
    again = tmp_path / "again" if name == "new" else tmp_path / "out"
    outcome = command_here(*words_of(name, inputs, again), "--quiet")
    assert (outcome.returncode, outcome.stdout) == (0, "")
    assert all(line.startswith("warning: ") for line in outcome.stderr.splitlines())


def check_claims(name: str, tables: dict[str, Any]) -> None:
    """A command states the kinds of claims that the table of the docs lists for it, and no others.

    The interval of a mean is that of several recordings.
    """
    stated = {claim for each in tables if each.endswith("_conditions")
              for claim in tables[each]["claim"]}  # fmt: skip
    listed = {kind.name for kind in KINDS if name in kind.commands and kind is not MEAN_INTERVAL}
    assert stated == listed
    assert bool(listed) != (name in UNCONDITIONAL)


def check_numbers(numbers: list[dict[str, Any]], file: Path) -> None:
    """Each number is the value of its variable in the dataset beside it."""
    if file.suffix != ".nc":
        return
    results = va.open_results(file)
    for number in numbers:
        variable, selection = number["variable"], number["selection"]
        if variable in results and set(results[variable].dims) == set(selection):
            value = results[variable].sel(selection).item()
            shown = np.nan if number["value"] is None else number["value"]
            assert shown == pytest.approx(value, rel=1e-12, nan_ok=True), number


def errors_of(outcome: CompletedProcess[str], command: str) -> list[dict[str, Any]]:
    """Errors of an envelope that says nothing else; they are the lines on stderr."""
    envelope = json.loads(outcome.stdout)
    assert list(faults(envelope, SCHEMA)) == []
    assert (envelope["command"], envelope["version"]) == (command, version("vibroacoustics"))
    assert not any(envelope[key] for key in ("inputs", "tables", "numbers", "charts", "files"))
    errors: list[dict[str, Any]] = envelope["errors"]
    lines = [line for line in outcome.stderr.splitlines() if line.startswith("error: ")]
    assert [f"error: {each['message']}" for each in errors] == lines
    return errors


REFUSED: dict[str, tuple[tuple[object, ...], dict[str, Any]]] = {
    "new": (("nothing",), {}),
    "cache": (("--limit", "-1"), {}),
    "doctor": (("--bogus",), {"field": "--bogus"}),
    "schema": (("nothing",), {"field": "NAME", "value": "nothing"}),
}
"""Words that commands refuse whose input is no file, and parts of their errors."""


@pytest.mark.parametrize("name", list(COMMANDS))
def test_errors_are_one_line_and_one_object(name: str, inputs: Path, tmp_path: Path) -> None:
    words = words_of(name, inputs, tmp_path / "out")[2:]
    missing = tmp_path / "missing.toml"
    further, parts = REFUSED.get(name, ((missing, *words), {"file": str(missing)}))
    outcome = command_here(name, *further, "--json")
    (error,) = errors_of(outcome, name)
    assert (outcome.returncode, outcome.stderr.count("\n")) == (2, 1)
    assert {key: error[key] for key in parts} == parts
    quiet = command_here(name, *further)
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (2, "", outcome.stderr)


@pytest.mark.parametrize("name", list(COMMANDS))
def test_unknown_options_are_errors_of_every_command(name: str) -> None:
    outcome = command_here(name, "--json", "--bogus")
    (error,) = errors_of(outcome, name)
    assert (outcome.returncode, error["field"], error["file"]) == (2, "--bogus", None)


@pytest.mark.parametrize(
    ("words", "command", "parts"),
    [
        (("run", "--json"), "run", {"field": "STUDY"}),
        (("nonsense", "--json"), "nonsense", {"field": None}),
        (("--json", "run"), "run", {"field": "--json"}),
        (("orders", "a.wav", "--rpm", "fast", "--json"), "orders",
         {"field": "--rpm", "value": "fast"}),
    ],
)  # fmt: skip
def test_usage_errors_are_one_object(
    words: tuple[str, ...], command: str, parts: dict[str, Any]
) -> None:
    outcome = command_here(*words)
    (error,) = errors_of(outcome, command)
    assert outcome.returncode == 2
    assert {key: error[key] for key in parts} == parts


def test_a_file_that_is_named_as_the_option_is_no_request() -> None:
    assert command_here("run", "--", "--json").stdout == ""


def test_every_refusal_of_a_file_is_an_object(inputs: Path, tmp_path: Path) -> None:
    text = (inputs / "study.toml").read_text()
    for old, new in (("share_ratio = 0.5", "share_ratio = 7.0"), ("x_mm = 1082.5", "x_mm = 1e9")):
        text = text.replace(old, new)
    file = tmp_path / "study.toml"
    file.write_text(text)
    for command in ("run", "check", "radiation"):
        errors = errors_of(command_here(command, file, "--json"), command)
        assert {each["file"] for each in errors} == {str(file)}
        by_field = {each["field"]: each for each in errors}
        share = by_field["options.counterweight-half.share_ratio"]
        assert (share["value"], share["unit"]) == (7.0, None)
        assert share["allowed"].endswith("0 to 2")
        x_mm = by_field["receivers.front_1m.x_mm"]
        assert (x_mm["value"], x_mm["unit"]) == (1e9, "mm")
        assert x_mm["allowed"] == "from -20000 to 20000 mm"


class BrokenError(Exception):
    """Of the package itself."""


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (PlatformError("memory is short"), "memory is short"),
        (MemoryError("1 GiB"), "not enough memory: 1 GiB"),
        (FaultError.at_line(Owner("option", "mine", "mine.py"), 3, "ZeroDivisionError"),
         "option mine: mine.py, line 3: ZeroDivisionError"),
    ],
)  # fmt: skip
def test_errors_that_come_up_in_a_command(
    error: Exception, line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        warnings.warn("before", stacklevel=2)
        raise error

    monkeypatch.setattr(starter, "as_file", fail)
    outcome = command_here("schema", "--json")
    (each,) = errors_of(outcome, "schema")
    assert (outcome.returncode, each["message"]) == (2, line)
    assert json.loads(outcome.stdout)["warnings"] == ["before"]
    if isinstance(error, FaultError):
        assert (each["file"], each["field"]) == ("mine.py", "option mine")


def test_a_fault_of_the_package_is_an_object_before_its_traceback(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(starter, "as_file", Mock(side_effect=BrokenError("here")))
    monkeypatch.setattr(sys, "argv", ["vibroacoustics", "schema", "--json"])
    with pytest.raises(BrokenError):
        cli.main()
    envelope = json.loads(capsys.readouterr().out)
    assert list(faults(envelope, SCHEMA)) == []
    assert [each["message"] for each in envelope["errors"]] == ["BrokenError: here"]


def test_what_is_omitted_is_an_error_of_a_whole_envelope(
    inputs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    as_file = starter.as_file

    def leaving_out(*words: Any) -> Any:
        leave_out(FaultError.at_line(Owner("option", "mine", "mine.py"), 3, "ZeroDivisionError"))
        return as_file(*words)

    monkeypatch.setattr(starter, "as_file", leaving_out)
    outcome = command_here("schema", "--out", inputs / "schemas", "--json")
    envelope = json.loads(outcome.stdout)
    assert list(faults(envelope, SCHEMA)) == []
    (error,) = envelope["errors"]
    assert (outcome.returncode, error["file"], error["field"]) == (3, "mine.py", "option mine")
    assert error["message"] == "option mine is omitted: mine.py, line 3: ZeroDivisionError"
    assert envelope["files"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("orders", "a.wav", "--speed", "tacho"), "No such option: --speed"),
        (("datasheet", "a.nc", "--microphones=a,b"), "(Possible options: --microphone"),
        (("orders", "a.wav", "--rpm", "fast"), "'--rpm': is no number; see vibroacoustics orders"),
        (("orders",), "Missing argument"),
        (("orderz",), "No such command 'orderz'"),
        (("run", "a.toml", "--jsn"), "No such option: --jsn"),
    ],
)
def test_usage_is_one_line_without_types_of_python(words: tuple[str, ...], message: str) -> None:
    outcome = command_here(*words)
    assert_refused(outcome, message)
    assert outcome.stderr.count("\n") == 1
    assert not any(kind in outcome.stderr for kind in ("float", "str>", "Path", "<class"))


READS_RESULTS = [name for name, words in CASES.items() if "results.nc" in words]


@pytest.mark.parametrize("name", READS_RESULTS)
def test_a_file_of_another_version_is_refused(name: str, inputs: Path, tmp_path: Path) -> None:
    older = tiny_run().assign_attrs(schema_version="2")
    file = write_results(older, tmp_path / "results.nc")
    words = [
        str(file) if str(word) == str(inputs / "results.nc") else word
        for word in words_of(name, inputs, tmp_path / "out")
    ]
    outcome = command_here(*words)
    assert_refused(outcome, f"{file}: schema_version = 2", "make it again: vibroacoustics run")
    assert (outcome.stdout, outcome.stderr.count("\n")) == ("", 1)
    assert not (tmp_path / "out").exists()


def test_help_is_grouped_by_job_with_run_first() -> None:
    lines = command_here("-h").stdout.splitlines()
    heads = [line.removesuffix(":") for line in lines if line.removesuffix(":") in JOBS]
    assert heads == list(JOBS)
    assert lines[lines.index("Studies:") + 1].split()[0] == "run"


def test_schema_of_the_envelope_is_printed() -> None:
    assert json.loads(command_here("schema", "envelope").stdout) == SCHEMA
    assert list(faults({"command": 1, "more": []}, SCHEMA)) != []


def test_tones_have_numbers_and_files(inputs: Path, tmp_path: Path) -> None:
    words = words_of("tones", inputs, tmp_path)
    envelope = json.loads(command_here(*words, "--json").stdout)
    level = next(each for each in envelope["numbers"] if each["variable"] == "recorded_tone_level")
    assert level["selection"]["frequency_hz"] == pytest.approx(5000.0 / (2.0 * np.pi), abs=0.5)
    assert level["value"] == pytest.approx(20.0 * np.log10(np.sqrt(0.5) / 20e-6), abs=0.1)
    found = va.open_results(tmp_path / "tones.nc")
    shown = envelope["tables"]["tones"]
    np.testing.assert_allclose(found["recorded_tone_level"].values[0], shown["level_db"], rtol=1e-8)
    assert "front" in (tmp_path / "tones.html").read_text(encoding="utf-8")
