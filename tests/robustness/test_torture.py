"""The short form of `torture`: nothing lost, nothing silently wrong, no traceback, nothing left."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
TRIES = 1


def test_of_storage() -> None:
    """In a process of its own, which has one thread and may fork."""
    outcome = subprocess.run(
        [sys.executable, "-W", "ignore", HERE / "torture.py", "--tries", str(TRIES)],
        capture_output=True,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        check=False,
        timeout=300,
    )
    print(outcome.stdout)
    assert (outcome.returncode, outcome.stderr) == (0, ""), outcome.stdout
    rows = [line.split() for line in outcome.stdout.splitlines()[1:]]
    assert len(rows) == 13
    assert all(row[1:] == [str(TRIES), "0", "0", "0", "0"] for row in rows), outcome.stdout


@pytest.mark.long
@pytest.mark.parametrize("name", ["kill_a_command", "signal_a_command"])
def test_of_a_command(name: str) -> None:
    import commands_torture
    import torture

    assert torture.torture((getattr(commands_torture, name),), 1, 0.0, 20061) == 0
