"""Hostile results for every command that reads results: a result, or one line that says why not."""

import random
from pathlib import Path
from unittest.mock import patch

import pytest
import xarray as xr
from input_torture import mutated, results_of_a_run
from support import assert_refused, command_here

from vibroacoustics.commands import outputs

COMMANDS = {
    "report": ("report", "{file}", "--out", "{out}"),
    "score": ("score", "{file}", "--out", "{out}"),
    "listen": ("listen", "{file}", "--out", "{out}"),
    "datasheet": ("datasheet", "{file}", "--out", "{out}"),
    "compare first": ("compare", "{file}", "{good}", "--out", "{out}"),
    "compare second": ("compare", "{good}", "{file}", "--out", "{out}"),
}
SEEDS = [
    pytest.param(number, marks=pytest.mark.long) if number % 12 else number for number in range(60)
]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("command", COMMANDS)
def test_of_a_command(command: str, seed: int, tmp_path: Path) -> None:
    """What is changed goes with the seed; the file is as if it were written so."""
    good = results_of_a_run()
    hostile, what = mutated(good, random.Random(seed))
    hostile.attrs = {name: _as_in_a_file(value) for name, value in hostile.attrs.items()}
    places = {
        "file": tmp_path / "hostile.nc",
        "good": tmp_path / "good.nc",
        "out": tmp_path / "out",
    }

    def opened(path: Path) -> tuple[xr.Dataset, str]:
        return (hostile if Path(path).name == "hostile.nc" else good), "0" * 64

    words = [word.format(**places) for word in COMMANDS[command]]
    with patch.object(outputs.storage, "open_with_hash", opened):
        outcome = command_here(*words)
    assert outcome.returncode in (0, 1, 2), (what, outcome.stderr)
    if outcome.returncode == 2:
        assert_refused(outcome)
        assert outcome.stderr.count("\n") == 1, (what, outcome.stderr)
        assert not places["out"].exists(), what


def _as_in_a_file(value: object) -> object:
    """An attribute of a type that a file can hold."""
    return value if isinstance(value, str | int | float) and value != 10**310 else repr(value)
