"""The short form of `torture`: nothing lost, nothing silently wrong, no traceback, nothing left."""

import os
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


@pytest.mark.parametrize(
    ("only", "trials"),
    [(QUICK, len(QUICK)), pytest.param((), 13, marks=pytest.mark.long)],
    ids=["quick", "all"],
)
@pytest.mark.long
def test_of_storage(only: tuple[str, ...], trials: int) -> None:
    """In a process of its own, which has one thread and may fork.

    Two of the trials make a run first, which takes most of the time: they are of the long form.
    """
    names = ("--only", *only) if only else ()
    outcome = subprocess.run(
        [sys.executable, "-W", "ignore", HERE / "torture.py", "--tries", str(TRIES), *names],
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
@pytest.mark.parametrize("name", ["kill_a_command", "signal_a_command"])
def test_of_a_command(name: str) -> None:
    import commands_torture
    import torture

    assert torture.torture((getattr(commands_torture, name),), 1, 0.0, 20061) == 0
