"""Hostile values of options: exit code 0 to 3, at most one error line, no traceback, bounded."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from command_lines import made_up_fields
from option_trials import Trial, fault, prepared, remove, trials

from vibroacoustics.commands.command import COMMANDS


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Folder with the inputs of all commands."""
    folder = tmp_path_factory.mktemp("options")
    prepared(folder)
    yield folder
    remove(folder)  # pytest's own way recurses


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    """Made-up radiation, figures without pixels, a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
    made_up_fields(monkeypatch)


def faults(folder: Path, some: Iterator[Trial]) -> list[str]:
    """What is wrong with the outcomes of trials, a line each."""
    return [
        f"{trial.command} {trial.option}={trial.value[:30]!r}: {wrong}"
        for trial in some
        if (wrong := fault(folder, trial))
    ]


def test_hostile_values_of_every_option_once(folder: Path) -> None:
    """An option that several commands have is tried in the quickest of them."""
    tried = set[str]()
    some = list(trials(folder, prepared(folder), tried))
    assert {trial.option for trial in some} == tried
    assert faults(folder, iter(some)) == []


@pytest.mark.long
@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_hostile_values_of_every_option_of(command: str, folder: Path) -> None:
    """All values, in the command that has the option, on a steady sound, a run-up and silence."""
    lines = {command: prepared(folder)[command]}
    assert faults(folder, trials(folder, lines)) == []
