"""SIGINT and SIGTERM: one line, exit code 130 or 143, and nothing left behind."""

import json
import os
import signal
import subprocess
import sys
import textwrap
import time
from functools import partial
from pathlib import Path

import psutil
import pytest
from support import TINY

CODES = {signal.SIGINT: 130, signal.SIGTERM: 143}
long = partial(pytest.param, marks=pytest.mark.long)


def start(words: list[object], cache: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "XDG_CACHE_HOME": str(cache)},
    )


def assert_ended(process: subprocess.Popen[str], number: signal.Signals) -> str:
    """Stages that end before a signal is let through may print their line of progress."""
    output, errors = process.communicate(timeout=30)
    *progress, last = errors.splitlines()
    assert (process.returncode, last) == (CODES[number], f"ended by {number.name}")
    assert all(line.startswith("progress: ") for line in progress)
    return output


def wait_for(condition, seconds: float = 30.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.mark.parametrize("number", [signal.SIGINT, long(signal.SIGTERM)])
def test_while_the_radiation_is_computed(tmp_path, number):
    """The cache's lock is held then."""
    words = ["-m", "vibroacoustics", "run", TINY, "--out", tmp_path / "out", "--json"]
    process = start(words, tmp_path)
    wait_for(lambda: list(tmp_path.glob("vibroacoustics/*.lock")))
    process.send_signal(number)
    envelope = json.loads(assert_ended(process, number))
    assert envelope["command"] == "run"
    assert [each["message"] for each in envelope["errors"]] == [f"ended by {number.name}"]
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


@pytest.mark.parametrize("number", [long(signal.SIGINT), signal.SIGTERM])
@pytest.mark.long
def test_while_a_recording_is_read(tmp_path, number):
    """The child that reads ends with its parent."""
    recording = tmp_path / "long.csv"
    row = b"0.123456789,0.123456789\n"
    recording.write_bytes(b"time [s],a [Pa]\n" + row * (60_000_000 // len(row)))
    process = start(["-m", "vibroacoustics", "orders", recording, "--rpm", "3000"], tmp_path)
    parent = psutil.Process(process.pid)
    wait_for(lambda: any("recordings.child" in " ".join(c.cmdline()) for c in parent.children()))
    (child,) = parent.children()
    process.send_signal(number)
    assert_ended(process, number)
    wait_for(lambda: not child.is_running(), 5.0)
    assert [path.name for path in tmp_path.iterdir()] == ["long.csv"]


SWALLOWED = """
    import sys, time
    from vibroacoustics.commands.signals import ended_by_signals
    with ended_by_signals():
        try:
            print("here", flush=True)
            time.sleep(60)
        except BaseException:
            {then}
        time.sleep(60)
"""


@pytest.mark.parametrize("then", ["pass", "raise ImportError('in its place') from None"])
def test_a_library_that_swallows_or_replaces_it(tmp_path, then):
    process = start(["-c", textwrap.dedent(SWALLOWED).format(then=then)], tmp_path)
    assert process.stdout is not None
    assert process.stdout.readline() == "here\n"
    process.send_signal(signal.SIGTERM)
    assert_ended(process, signal.SIGTERM)
