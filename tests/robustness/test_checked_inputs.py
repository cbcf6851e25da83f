"""What a run refuses for an input, `check` refuses: files of data and values of studies."""

import shutil
from pathlib import Path

import pytest
from late_inputs import BASES, CONTENTS, STUDIES, change, changed_values, refused_late
from support import assert_refused, command_here, without_warnings

pytestmark = pytest.mark.filterwarnings("ignore")
WHOLE = ("as it is", "missing", "folder", *CONTENTS)
QUICK = {
    "published_table": ("a column of numbers", "a name twice", "rows of one name"),
    "floor_functions": ("as it is", "other columns", "missing"),
    "sound_functions": ("as it is",),
}
"""Representatives of what once passed `check` and failed in a run."""


def late_contents(name: str, contents: tuple[str, ...], folder: Path) -> dict[str, str]:
    """Why a run refuses what `check` takes, by content of the data file."""
    late = {}
    for content in contents:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        inputs = STUDIES[name](folder)
        if content != "as it is":
            change(inputs.file, content)
        reason = refused_late(inputs.study)
        if reason is not None:
            late[content] = reason
    return late


@pytest.mark.parametrize("name", QUICK)
def test_some_contents_of_data_files(name: str, tmp_path: Path) -> None:
    assert late_contents(name, QUICK[name], tmp_path / "study") == {}


@pytest.mark.long
@pytest.mark.parametrize("name", STUDIES)
def test_all_contents_of_data_files(name: str, tmp_path: Path) -> None:
    assert late_contents(name, WHOLE, tmp_path / "study") == {}


@pytest.mark.parametrize("content", ["a column of numbers", "rows of one name", "empty"])
def test_a_published_table_that_is_none_is_refused_by_check(content: str, tmp_path: Path) -> None:
    inputs = STUDIES["published_table"](tmp_path)
    change(inputs.file, content)
    outcome = command_here("check", inputs.study)
    assert_refused(outcome, "data.csv")
    assert outcome.stderr.count("\n") == 1


def test_measured_functions_that_do_not_fit_are_refused_by_check(tmp_path: Path) -> None:
    inputs = STUDIES["floor_functions"](tmp_path)
    text = inputs.study.read_text()
    inputs.study.write_text(text.replace("node = 12,", "node = 99,"))
    assert_refused(command_here("check", inputs.study), "measured.floor")


def late_values(base: str, every: int, first: int, folder: Path) -> dict[str, str]:
    """Why a run refuses what `check` takes, by the value that is changed: every n-th of all."""
    study, file = BASES[base](folder)
    late = {what: refused_late(study) for what in changed_values(file, every, first)}
    return {what: reason for what, reason in late.items() if reason is not None}


@pytest.mark.parametrize(("base", "every"), [("rigid", 40), ("machine", 500), ("by_table", 300)])
def test_some_values_of_a_study(base: str, every: int, tmp_path: Path) -> None:
    assert late_values(base, every, 0, tmp_path) == {}


@pytest.mark.long
@pytest.mark.parametrize(
    ("base", "every", "first"),
    [("rigid", 1, 0), ("by_table", 2, 0), ("machine", 7, 0), ("machine", 7, 1),
     ("with_sources", 7, 0), ("with_sources", 7, 1)],
)  # fmt: skip
def test_many_values_of_a_study(base: str, every: int, first: int, tmp_path: Path) -> None:
    assert late_values(base, every, first, tmp_path) == {}


def test_speeds_that_a_table_does_not_reach_are_refused_by_check(tmp_path: Path) -> None:
    """Wherever they are in the list."""
    study, _ = BASES["by_table"](tmp_path)
    text = study.read_text()
    speeds = next(line for line in text.splitlines() if line.startswith("speed_rpm"))
    study.write_text(text.replace(speeds, "speed_rpm = [900.0, 1000.0, 3000.0, 1100.0]"))
    outcome = without_warnings(command_here("check", study))
    assert_refused(outcome, "speed_rpm = 3000 rpm", "the table of forces has 800")
