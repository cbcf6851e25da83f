"""Locks between processes: one holder, whose name is told, and nothing left of the dead."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from vibroacoustics.base.folder import Folder, opened_folder
from vibroacoustics.results import lock
from vibroacoustics.results.interruption import uninterrupted

HOLD = """
import sys, time
from pathlib import Path
from vibroacoustics.base.folder import opened_folder
from vibroacoustics.results.lock import locked
path = Path(sys.argv[1])
with opened_folder(path.parent) as folder, locked(folder, path.name, "it"):
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


@pytest.fixture
def folder(tmp_path) -> Iterator[Folder]:
    with opened_folder(tmp_path) as opened:
        yield opened


def test_the_file_is_there_while_the_lock_is_held(folder, tmp_path):
    with lock.locked(folder, "a.lock", "it"):
        assert lock.is_held(folder, "a.lock")
        assert f"process {os.getpid()} on " in lock.holder(folder, "a.lock")
        with lock.taken(folder, "a.lock") as held:
            assert not held
    assert not list(tmp_path.iterdir())
    assert not lock.is_held(folder, "a.lock")


def test_the_second_waits_and_says_for_whom(folder, tmp_path):
    path = tmp_path / "a.lock"
    process = hold(path, 1.5)
    begin = time.monotonic()
    with pytest.warns(UserWarning, match=rf"^it: waiting for process {process.pid} on .*, since 2"):
        take(folder)
    assert time.monotonic() - begin > 0.5
    assert process.wait(timeout=20) == 0
    assert not path.exists()


def take(folder: Folder) -> None:
    with lock.locked(folder, "a.lock", "it"):
        assert lock.is_held(folder, "a.lock")


def test_lock_of_the_dead_is_taken_over_in_silence(folder, tmp_path):
    path = tmp_path / "a.lock"
    process = hold(path, 60)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert path.exists()
    take(folder)
    assert not path.exists()


def test_never_two_at_once(tmp_path):
    """Each adds one to a number that it read a moment before."""
    script = """
import sys, time
from pathlib import Path
from vibroacoustics.base.folder import opened_folder
from vibroacoustics.results.lock import locked
number = Path(sys.argv[1])
for _ in range(30):
    with opened_folder(number.parent) as folder, locked(folder, "number.lock", "it"):
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


def test_holder_that_cannot_be_read(folder, tmp_path):
    (tmp_path / "a.lock").write_bytes(b"\xff{")
    assert lock.holder(folder, "a.lock") == "another process"


def test_a_lock_that_is_held_keeps_its_links(folder, tmp_path):
    """As a backup of hard links makes one: nobody else gets the lock for it."""
    with lock.locked(folder, "a.lock", "it"):
        (tmp_path / "copy").hardlink_to(tmp_path / "a.lock")
        with lock.taken(folder, "a.lock") as held:
            assert not held
    assert [path.name for path in tmp_path.iterdir()] == ["copy"]


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
