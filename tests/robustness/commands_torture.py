"""The command `run`, killed or ended by a signal anywhere; see `torture`."""

import atexit
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Final

import xarray as xr
from torture import Trial, left

from vibroacoustics import open_results
from vibroacoustics.base.errors import StorageError
from vibroacoustics.results import manifest

STUDY: Final = Path(__file__).resolve().parents[1] / "studies" / "tiny.toml"
WARM_CACHE: Final = Path(tempfile.mkdtemp(prefix="torture-cache-"))
atexit.register(shutil.rmtree, WARM_CACHE, ignore_errors=True)
MOST_S: Final = 2.0
"""Time within which workers end after their command."""


def start(out: Path, cache_folder: Path) -> subprocess.Popen[str]:
    """The command, once it listens to signals."""
    process = subprocess.Popen(
        [sys.executable, "-m", "vibroacoustics", "run", str(STUDY), "--out", str(out)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env={
            **os.environ,
            "XDG_CACHE_HOME": str(cache_folder),
            "MPLCONFIGDIR": str(WARM_CACHE),
            "PYTHONFAULTHANDLER": "1",  # a crash shows where
        },
        start_new_session=True,
    )
    while process.poll() is None and not listens(process.pid):
        time.sleep(0.005)
    return process


def listens(process: int) -> bool:
    status = Path(f"/proc/{process}/status").read_text()
    caught = int(status.partition("SigCgt:")[2].split()[0], 16)
    return bool(caught >> (signal.SIGALRM - 1) & 1)  # the last one of the three


def said(process: subprocess.Popen[str]) -> str:
    """What it said on stderr until its end, apart from its advance."""
    _, errors = process.communicate()
    lines = errors.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("progress: "))


@cache
def reference() -> tuple[xr.Dataset, float, float]:
    """Results of a run that nothing disturbs, and the seconds of a cold and of a warm one."""
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(2):
            begin = time.monotonic()
            errors = said(start(Path(folder), WARM_CACHE))
            assert errors == "", errors
            seconds.append(time.monotonic() - begin)
        return open_results(Path(folder) / "results.nc").drop_attrs(), seconds[0], seconds[1]


def begin(folder: Path, chance: random.Random) -> tuple[subprocess.Popen[str], Path]:
    """A command somewhere on its way, cold or near the end of a warm one, and its cache."""
    _, cold, warm = reference()
    is_cold = chance.random() < 0.5
    cache_folder = folder / "cache" if is_cold else WARM_CACHE
    process = start(folder / "out", cache_folder)
    time.sleep(chance.uniform(0.0, cold) if is_cold else chance.uniform(0.5, 1.0) * warm)
    return process, cache_folder


def seen(folder: Path) -> list[str]:
    """What is wrong with what lies there."""
    try:
        results = open_results(folder / "out" / "results.nc")
    except StorageError as error:
        return [] if str(error).endswith("no such file") else [f"lost: {error}"]
    return [] if results.drop_attrs().identical(reference()[0]) else ["wrong: values"]


def after(folder: Path, cache_folder: Path) -> list[str]:
    """What is wrong now, and after one more run."""
    now = seen(folder)
    process = start(folder / "out", cache_folder)
    errors = said(process)
    again = [] if process.returncode == 0 and errors == "" else [f"lost: {errors}"]
    again += [f"wrong: {line}" for line in manifest.mixed(folder / "out")]
    return [*now, *again, *seen(folder), *left(folder)]


def kill_a_command(folder: Path, chance: random.Random) -> list[str]:
    """SIGKILL to the command and its children."""
    process, cache_folder = begin(folder, chance)
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    return after(folder, cache_folder)


def signal_a_command(folder: Path, chance: random.Random) -> list[str]:
    """SIGINT or SIGTERM: one line, exit code 130 or 143, nothing left; or it had done its work."""
    process, _ = begin(folder, chance)
    number = chance.choice((signal.SIGINT, signal.SIGTERM))
    process.send_signal(number)
    errors = said(process)
    expected = [(128 + number, f"ended by {number.name}\n"), (0, "")]
    outcome = (process.returncode, errors)
    bad = [] if outcome in expected else [f"traceback: {outcome}"]
    bad += [f"wrong: {line}" for line in manifest.mixed(folder / "out")]
    return [*bad, *seen(folder), *left(folder), *children_of(process.pid)]


def children_of(session: int) -> list[str]:
    """What is left of a session's processes; a worker ends a moment after its command."""
    end = time.monotonic() + MOST_S
    while running(session):
        if time.monotonic() > end:
            return ["left: a child"]
        time.sleep(0.05)
    return []


def running(session: int) -> list[int]:
    """Processes of a session that have not ended; who collects the ended ones is init's affair."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            state, _, _, of = path.read_text().rpartition(")")[2].split()[:4]
            if int(of) == session and state not in "ZX":
                found.append(int(path.parent.name))
    return found


COMMAND_TRIALS: Final[tuple[Trial, ...]] = (kill_a_command, signal_a_command)
