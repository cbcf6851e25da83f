"""What a run refuses for an input, `check` refuses: files of data and values of studies."""

import shutil
from pathlib import Path

import pytest
from late_inputs import CONTENTS, STUDIES, change, changed_values, refused_late
from support import ROOT, TINY, assert_refused, command_here

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


@pytest.mark.parametrize("content", ["a column of numbers", "a name twice", "empty"])
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


@pytest.mark.long
@pytest.mark.parametrize("part", range(4))
def test_all_values_of_a_study(part: int, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(TINY.read_text().replace("../../data", str(ROOT / "data")))
    studies = enumerate(changed_values(file))
    late = {what: refused_late(each) for n, (what, each) in studies if n % 4 == part}
    assert {what: reason for what, reason in late.items() if reason is not None} == {}
