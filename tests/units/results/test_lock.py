"""Locks between processes: one holder, whose name is told, and nothing left of the dead."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from vibroacoustics.results import lock
from vibroacoustics.results.interruption import uninterrupted

HOLD = """
import sys, time
from pathlib import Path
from vibroacoustics.results.lock import locked
with locked(Path(sys.argv[1]), "it"):
    print("held", flush=True)
    time.sleep(float(sys.argv[2]))
"""


def hold(path: Path, seconds: float) -> subprocess.Popen[bytes]:
    """A process that holds the lock."""
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, path, str(seconds)], stdout=subprocess.PIPE
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"held\n"
    return process


def test_the_file_is_there_while_the_lock_is_held(tmp_path):
    path = tmp_path / "a.lock"
    with lock.locked(path, "it"):
        assert lock.is_held(path)
        assert f"process {os.getpid()} on " in lock.holder(path)
        with lock.taken(path) as held:
            assert not held
    assert not path.exists()
    assert not lock.is_held(path)


def test_the_second_waits_and_says_for_whom(tmp_path):
    path = tmp_path / "a.lock"
    process = hold(path, 1.5)
    begin = time.monotonic()
    with pytest.warns(UserWarning, match=rf"^it: waiting for process {process.pid} on .*, since 2"):
        take(path)
    assert time.monotonic() - begin > 0.5
    assert process.wait(timeout=20) == 0
    assert not path.exists()


def take(path: Path) -> None:
    with lock.locked(path, "it"):
        assert lock.is_held(path)


def test_lock_of_the_dead_is_taken_over_in_silence(tmp_path):
    path = tmp_path / "a.lock"
    process = hold(path, 60)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert path.exists()
    with lock.locked(path, "it"):
        assert lock.is_held(path)
    assert not path.exists()


def test_never_two_at_once(tmp_path):
    """Each adds one to a number that it read a moment before."""
    script = """
import sys, time
from pathlib import Path
from vibroacoustics.results.lock import locked
number = Path(sys.argv[1])
for _ in range(30):
    with locked(number.with_suffix(".lock"), "it"):
        before = int(number.read_text())
        time.sleep(0.001)
        number.write_text(str(before + 1))
"""
    number = tmp_path / "number"
    number.write_text("0")
    command = [sys.executable, "-W", "ignore", "-c", script, number]
    for process in [subprocess.Popen(command) for _ in range(3)]:
        assert process.wait(timeout=60) == 0
    assert number.read_text() == "90"
    assert [path.name for path in tmp_path.iterdir()] == ["number"]


def test_holder_that_cannot_be_read(tmp_path):
    (tmp_path / "a.lock").write_bytes(b"\xff{")
    assert lock.holder(tmp_path / "a.lock") == "another process"


def test_a_signal_waits_for_the_step(monkeypatch):
    came = []
    before = signal.signal(signal.SIGTERM, lambda *_: came.append("came"))
    try:
        with uninterrupted():
            signal.raise_signal(signal.SIGTERM)
            assert not came
        assert came == ["came"]
    finally:
        signal.signal(signal.SIGTERM, before)
