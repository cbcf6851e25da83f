"""The short form of `torture`: nothing lost, nothing silently wrong, no traceback, nothing left."""

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
TRIES = 1
QUICK = (
    "kill_a_writer", "signal_a_writer", "signal_at_a_step", "fill_the_disk",
    "fill_the_disk_of_the_cache", "read_beside_writers", "compute_together", "flip_a_bit",
    "flip_a_bit_of_the_cache", "mutate_a_study", "give_a_hostile_file",
)  # fmt: skip

STORAGE = (*QUICK, "mutate_results", "give_a_hostile_name", "damage_a_wav", "damage_a_tdms")


@pytest.mark.parametrize(
    ("only", "trials"),
    [(QUICK, len(QUICK)), pytest.param(STORAGE, len(STORAGE), marks=pytest.mark.long)],
    ids=["quick", "all"],
)
@pytest.mark.long
def test_of_storage(only: tuple[str, ...], trials: int) -> None:
    """In a process of its own, which has one thread and may fork.

    Two of the trials make a run first, which takes most of the time: they are of the long form.
    """
    asked = ("--tries", str(TRIES), "--only", *only)
    outcome = subprocess.run(
        [sys.executable, "-W", "ignore", HERE / "torture.py", *asked],
        capture_output=True,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        check=False,
        timeout=300,
    )
    print(outcome.stdout)
    assert (outcome.returncode, outcome.stderr) == (0, ""), outcome.stdout
    rows = [line.split() for line in outcome.stdout.splitlines()[1:]]
    assert len(rows) == trials
    assert all(row[1:] == [str(TRIES), "0", "0", "0", "0"] for row in rows), outcome.stdout


@pytest.mark.long
def test_a_later_call_goes_on(tmp_path: Path) -> None:
    """The file holds seed and counts; chances are those of the number of the try."""
    import torture

    drawn: list[tuple[str, float]] = []

    def first(folder: Path, chance: random.Random) -> list[str]:
        drawn.append(("first", chance.random()))
        return ["wrong: as asked"] if len(drawn) == 1 else []

    def second(folder: Path, chance: random.Random) -> list[str]:
        drawn.append(("second", chance.random()))
        return []

    file = tmp_path / "counts.csv"
    for tries in (1, 3):
        wrong = torture.torture((first, second), tries, 0.0, 7 if tries == 1 else 8, file)
        assert wrong == 1  # of the first call, kept
    assert file.read_text().splitlines() == [
        "seed,trial,tries,lost,wrong,traceback,left", "7,first,3,0,1,0,0", "7,second,3,0,0,0,0"
    ]  # fmt: skip
    kept, drawn[:] = list(drawn), [("", 0.0)]
    torture.torture((first, second), 3, 0.0, 7)
    assert sorted(drawn[1:]) == sorted(kept)


@pytest.mark.long
@pytest.mark.parametrize("name", ["kill_a_command", "signal_a_command"])
def test_of_a_command(name: str) -> None:
    import commands_torture
    import torture

    assert torture.torture((getattr(commands_torture, name),), 1, 0.0, 20061) == 0
