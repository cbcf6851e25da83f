"""`check`: all errors in one go, and what a run costs before it starts."""

import json
import os
import time
from math import sqrt
from pathlib import Path

import pytest
from support import PIPELINES, ROOT, TINY, assert_refused, command_here

from vibroacoustics import pipeline
from vibroacoustics.commands import outputs
from vibroacoustics.pipeline.cost import RunCost, run_cost
from vibroacoustics.results.size import MOST_BYTES
from vibroacoustics.results.storage import without_cache
from vibroacoustics.study.loading import load_study

SAMPLED = ROOT / "tests" / "studies" / "sources_made_up.toml"
NOT_OF_PIPELINE = ("start and study", "report")


def changed(folder: Path, *changes: tuple[str, str]) -> Path:
    """The tiny study with other text."""
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    file = folder / "study.toml"
    file.write_text(text)
    return file


def test_every_error_is_told(tmp_path: Path) -> None:
    changes = [("share_ratio = 0.5", "share_ratio = 7.0"), ("x_mm = 1082.5", "x_mil = 1082.5")]
    outcome = command_here("check", changed(tmp_path, *changes))
    assert_refused(outcome, "options.counterweight-half.share_ratio = 7")
    assert_refused(outcome, "receivers.front_1m.x_m")
    assert outcome.stdout == ""


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("maximum_order = 16", "maximum_order = 30", ["radiation.maximum_frequency_hz", "1450 Hz"]),
        ("x_mm = 1082.5", "x_mm = 2000.0", ["catalogue_receiver", "stands 1.9"]),
        ("[receivers.", "[receivers.under]\nx_mm = 0.0\ny_mm = 0.0\nheight_mm = 100.0\n[receivers.",
         ["receivers.under"]),
    ],
)  # fmt: skip
def test_what_crosses_fields_is_told(tmp_path: Path, old: str, new: str, words: list[str]) -> None:
    change = (old, new) if old != "[receivers." else ("[receivers.front_1m]", f"{new}front_1m]")
    assert_refused(command_here("check", changed(tmp_path, change)), *words)


def test_too_large_a_result_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = changed(tmp_path, ("[2900.0]", "[2900.0, 3000.0]"))
    monkeypatch.setattr("vibroacoustics.results.size.MOST_BYTES", 1000)
    assert MOST_BYTES > 1000
    assert_refused(command_here("check", file), "study.toml", "GiB")


@pytest.mark.parametrize("name", ["zhao_minicrank", "copeland_zp41k3e"])
def test_machine(name: str) -> None:
    outcome = command_here("check", ROOT / "data" / "machines" / f"{name}.toml")
    assert outcome.returncode == 0, outcome.stderr
    assert "machine: " in outcome.stdout
    assert "nothing is wrong" in outcome.stdout


def middle_s(cost: RunCost, *without: str) -> float:
    """Middle of the range of processor time, without some stages."""
    counted = [one for one in cost.costs if one.name not in without]
    return sqrt(sum(one.low_s for one in counted) * sum(one.high_s for one in counted))


@pytest.mark.long
def test_time_is_within_a_factor_of_two(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    study = load_study(PIPELINES / "zhao_minicrank.toml")
    cost = run_cost(study)
    assert not cost.was_cached
    start = time.process_time()
    pipeline.run(study)
    taken_s = time.process_time() - start
    expected_s = middle_s(cost, *NOT_OF_PIPELINE)
    assert 0.5 < taken_s / expected_s < 2.0
    again = run_cost(study)
    assert again.was_cached
    assert again.radiation_bytes == 0.0
    assert middle_s(again, *NOT_OF_PIPELINE) < 0.7 * expected_s


@pytest.mark.long
def test_time_with_samples_and_kwave_is_within_a_factor_of_two(tmp_path: Path) -> None:
    study = load_study(SAMPLED)
    with without_cache():
        cost = run_cost(study)
        start = sum(os.times()[:4])
        results = pipeline.run(study)
    outputs.write_report(results, tmp_path)
    taken_s = sum(os.times()[:4]) - start  # of ended workers too
    assert 0.5 < taken_s / middle_s(cost, "start and study") < 2.0


def test_lines_of_a_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    closed = ("room_spacing_mm = 60.0", 'room_spacing_mm = 60.0\nroom_solver = "closed-form"')
    outcome = command_here("check", changed(tmp_path, closed))
    assert outcome.returncode == 0, outcome.stderr
    for words in ("1 speeds x 2 options", "samples: none, though ",
                  "size of the result: 0.", "MB of memory",
                  "boundary elements: ", "of processor time; ", "nothing is wrong"):  # fmt: skip
        assert words in outcome.stdout, outcome.stdout


def test_values_of_the_example_are_counted_and_ranked(tmp_path: Path) -> None:
    """Two values of the machine are marked, one of them was changed since."""
    machine = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text()
    for old, new in (
        ('0.0727, source = "', '0.0727, source = "example: 0.0727 kg; '),
        ('35.0, source = "', '35.0, source = "example: 34 kg; '),
    ):
        assert old in machine
        machine = machine.replace(old, new, 1)
    (tmp_path / "machine.toml").write_text(machine)
    file = changed(tmp_path, (f"{ROOT}/data/machines/copeland_zp41k3e.toml", "machine.toml"))
    outcome = command_here("check", file, "--example", "--json")
    assert outcome.returncode == 0, outcome.stderr
    assert "price: 2 runs in the coarse setting, 0 of them" in outcome.stderr
    ranked = json.loads(outcome.stdout)["tables"]["example"]
    assert ranked["field"] == ["oldham.mass_kg"] * 2
    assert ranked["change_modelled_dba"] == pytest.approx([-1.938, 1.584], abs=1e-3)
    text = command_here("check", file).stdout
    assert "example: 1 of " in text
    assert "write yours: housing.mass_kg" in text


def test_a_machine_has_no_values_that_a_study_reads() -> None:
    file = ROOT / "data" / "machines" / "zhao_minicrank.toml"
    assert_refused(command_here("check", file, "--example"), "is a machine", "--example")
