"""Every command on a small input: its flags, its JSON by the schema, its help and exit codes."""

import csv
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer
from design_studies import WEIGHT
from in_situ_bench import BELOW
from in_situ_bench import write as write_blocked
from json_schema import faults
from measured_bench import AS_MEASURED, FREQUENCY, state
from measured_bench import write as write_bench
from pictures import draw_nothing
from rooms_made_up import made_up_vectors
from support import (
    MACHINE_FILE,
    TINY,
    assert_refused,
    command_here,
    made_up_radiation,
    made_up_transfer_vectors,
    tiny_run,
)

import vibroacoustics as va
from vibroacoustics import pipeline
from vibroacoustics.commands import cli
from vibroacoustics.commands.command import COMMANDS, JOBS
from vibroacoustics.commands.outcome import SCHEMA
from vibroacoustics.pipeline.study import run as run_study
from vibroacoustics.results.storage import write_results
from vibroacoustics.stages import room

SPEED = ("--rpm", "2900")
CASES = {
    "run": ("study.toml",),
    "check": ("study.toml",),
    "radiation": ("study.toml",),
    "curves": (MACHINE_FILE, "--speed", "2900"),
    "new": ("reciprocating",),
    "report": ("results.nc",),
    "score": ("results.nc",),
    "compare": ("results.nc", "results.nc", "--other-option", "counterweight-half"),
    "datasheet": ("results.nc", "--option", "counterweight-half", "--speed", "2900"),
    "listen": ("results.nc", "--option", "none", "--speed", "2900", "--seconds", "1"),
    "impulse-responses": ("kitchen.toml", "--microphone", "table"),
    "sweep": ("designs.toml",),
    "optimise": ("designs.toml",),
    "orders": ("recording.csv", *SPEED, "--orders", "1,2", "--maximum-order", "5"),
    "track": ("recording.csv", *SPEED, "--orders", "1", "--bandwidth", "2"),
    "map": ("recording.csv", *SPEED),
    "tones": ("recording.csv",),
    "export": ("recording.csv",),
    "sound-power": ("recording.csv", "--hemisphere", "1"),
    "replay": (
        "recording.csv", *SPEED, "--results", "results.nc", "--option", "counterweight-half",
        "--pair", "front=front_1m",
    ),
    "predict": ("bench.toml",),
    "blocked-forces": ("in_situ/in_situ.toml",),
    "benchmark": (),
    "cache": (),
    "doctor": (),
    "schema": (),
}  # fmt: skip
"""Arguments of each command; a name with an ending is a file of `inputs`."""
PRINTS_ONLY = {"check", "cache", "doctor"}
"""Commands that write no file; all others have `--out`."""
WRITES_ONLY = {"report", "new", "export", "schema", "cache", "doctor"}
"""Commands that compute nothing; all others have `--verbose` and `--log`."""
DESIGN = """
[design]
option = "weight"
[design.variables]
"options.weight.mass_g" = { list = [10, 50] }
[design.objectives.light]
figure = "added_mass_kg"
"""
ROOM = """
[room]
size_mm = [4000.0, 3000.0, 2500.0]
foot_mm = [3500.0, 400.0]
maximum_frequency_hz = 800.0
walls = { floor = "tiles", "-x" = "plaster", ceiling = "acoustic_ceiling" }
listeners.table = { x_mm = 2000.0, y_mm = 2200.0, height_mm = 1200.0 }
"""
HALVED = "[changes.halved.mounts.one]\nstiffness_n_per_mm = 100.0\nloss_factor_percent = 10.0\n"


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a small input of every kind."""
    folder = tmp_path_factory.mktemp("inputs")
    text = TINY.read_text().replace("../../data", str(MACHINE_FILE.parents[1]))
    (folder / "study.toml").write_text(text)
    (folder / "kitchen.toml").write_text(text + ROOM)
    (folder / "designs.toml").write_text(f"{text}\n{WEIGHT}\n{DESIGN}")
    write_results(tiny_run(), folder / "results.nc")
    time_s = np.arange(4 * 8000) / 8000.0
    noise = 0.01 * np.random.default_rng(1).standard_normal(time_s.size)
    sound = noise + np.cos(2.0 * np.pi * 2900.0 / 60.0 * time_s) + np.cos(5000.0 * time_s)
    va.export_recording(
        va.label_recording([sound], 8000.0, ["front"], ["Pa"]), folder / "recording.csv"
    )
    write_bench(folder, HALVED, state(FREQUENCY, AS_MEASURED))
    (folder / "in_situ").mkdir()
    write_blocked(folder / "in_situ", BELOW)
    return folder


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Made-up radiation, figures without pixels, an empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(
        pipeline,
        "run",
        lambda study, progress: run_study(study, progress, made_up_radiation),
        raising=False,
    )
    radiated = made_up_transfer_vectors(va.load_study(TINY))
    monkeypatch.setattr(pipeline, "radiate", lambda *_: radiated, raising=False)
    vectors = made_up_vectors(["table"], highest_hz=2000.0)
    monkeypatch.setattr(room, "vectors_of", lambda *_: (vectors, False))
    draw_nothing(monkeypatch)


def words_of(name: str, inputs: Path, out: Path) -> list[object]:
    """Words of a command, its files within the inputs and its results in `out`."""
    words = [inputs / word if (inputs / str(word)).is_file() else word for word in CASES[name]]
    target = out / "copy.csv" if name in {"benchmark", "export"} else out
    return [name, *words, *(() if name in PRINTS_ONLY else ("--out", target))]


def options_of(name: str) -> set[str]:
    group = typer.main.get_command(cli.app)
    return {word for parameter in group.commands[name].params for word in parameter.opts}


def test_every_command_has_a_case_and_a_job() -> None:
    assert set(CASES) == set(COMMANDS)
    assert {each.job for each in COMMANDS.values()} == set(JOBS)


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
    assert envelope["command"] == name
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
    if log:
        assert (tmp_path / "log.txt").read_text()
    again = tmp_path / "again" if name == "new" else tmp_path / "out"
    outcome = command_here(*words_of(name, inputs, again), "--quiet")
    assert (outcome.returncode, outcome.stdout) == (0, "")
    assert all(line.startswith("warning: ") for line in outcome.stderr.splitlines())


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


@pytest.mark.parametrize(
    "name", sorted(set(COMMANDS) - {"benchmark", "new", "cache", "doctor", "schema"})
)
def test_errors_are_one_line_also_with_json(name: str, inputs: Path, tmp_path: Path) -> None:
    words = words_of(name, inputs, tmp_path / "out")
    outcome = command_here(name, tmp_path / "missing.toml", *words[2:], "--json")
    assert_refused(outcome, "missing.toml")
    assert (outcome.stdout, outcome.stderr.count("\n")) == ("", 1)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("orders", "a.wav", "--speed", "tacho"), "--speed was renamed to --speed-channel"),
        (("impulse-responses", "a", "--listener", "b"), "--listener was renamed to --microphone"),
        (("datasheet", "a.nc", "--microphones=a,b"), "--microphones was renamed to --microphone"),
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
