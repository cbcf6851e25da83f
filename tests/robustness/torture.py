"""Kills, full disks, writers beside readers, flipped bits, signals and hostile input, counted.

`make torture COUNT=200` tries each so often; counts lie in `build/torture.csv`, and a later call
goes on where the last one ended, `ONLY=kill` with those trials alone. Each try ends with a look at
what lies on the disk:

- lost: results that were whole before cannot be read, or a value that was computed did not come
- wrong: other values than were written, or files of two runs and nobody says so
- traceback: an error of another kind than it should be, a command that ends otherwise, a try that
  takes too much memory or time
- left: files of a writer that is gone, after the next one
"""

import argparse
import csv
import functools
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import FrameType
from typing import Final

import numpy as np
import xarray as xr

from vibroacoustics.base.errors import StorageError
from vibroacoustics.base.folder import Folder
from vibroacoustics.commands.signals import ended_by_signals
from vibroacoustics.results import cache, manifest, storage
from vibroacoustics.results.files import write

KINDS: Final = ("lost", "wrong", "traceback", "left")
COLUMNS: Final = ("tries", *KINDS)
NAMES: Final = ("report.html", "comparison.csv", "figures/a.png")
FAILED: Final = 70
"""Exit code of a child whose error is no `StorageError`."""
INTERRUPTED: Final = (
    "contextlib.py", "files.py", "folder.py", "interruption.py", "lock.py", "manifest.py",
)  # fmt: skip
"""Files of code in which signals fall at every step."""
Trial = Callable[[Path, random.Random], list[str]]
"""From an empty folder to what went wrong, each word one of `KINDS` or followed by its reason."""


def dataset(number: int) -> xr.Dataset:
    """Results whose values all follow from a number."""
    values = np.random.default_rng(number).standard_normal(4000)
    return xr.Dataset({"a": ("x", values), "b": ("y", values[:7] + 1j)}, attrs={"number": number})


def write_run(folder: Path, number: int) -> None:
    """A run: results and files of theirs, one of which only every second run has."""
    with manifest.replacing(folder, "results.nc") as staged:
        storage.stage_results(dataset(number), staged, "results.nc")
        for name in NAMES[: 2 + number % 2]:
            write(staged, name, f"{name} of {number}\n".encode() * 50)


def seen(folder: Path) -> list[str]:
    """What is wrong in a folder that once held a whole run."""
    try:
        results = storage.open_results(folder / "results.nc")
    except StorageError as error:
        return [f"lost: {error}"]
    number = int(results.attrs["number"])
    if not results.equals(dataset(number)):
        return ["wrong: values"]
    if manifest.mixed(folder):
        return []
    right = [f"{name} of {number}\n" * 50 for name in NAMES[: 2 + number % 2]]
    files = [folder / name for name in NAMES if (folder / name).exists()]
    return [] if [file.read_text() for file in files] == right else ["wrong: mixed in silence"]


def left(folder: Path) -> list[str]:
    """What a writer left that is not a file of a run."""
    hidden = [path.name for path in folder.rglob("*") if path.name.startswith(".")]
    locks = [path.name for path in folder.rglob("*.lock")]
    return [f"left: {name}" for name in {*hidden, *locks}]


def after(folder: Path) -> list[str]:
    """What is wrong now, and after one more run."""
    now = seen(folder)
    write_run(folder, 1001)
    again = [] if manifest.mixed(folder) == [] else ["wrong: mixed after a run"]
    return [*now, *seen(folder), *again, *left(folder)]


def child(work: Callable[[], None], output: int = -1) -> int:
    """Process number of a fork that does the work; a `StorageError` is no failure of it."""
    sys.stdout.flush()
    if number := os.fork():
        return number
    code = 0
    try:
        if output >= 0:
            os.dup2(output, 2)
        work()
    except StorageError:
        code = 2
    except BaseException:
        traceback.print_exc()
        code = FAILED
    finally:
        os._exit(code)
    return code


def ended(number: int) -> int:
    """Exit code of a child, negative for a signal."""
    return os.waitstatus_to_exitcode(os.waitpid(number, 0)[1])


def slow_down() -> None:
    """A disk that takes its time with each file, so that half of all blows fall there."""
    replace, remove = os.replace, manifest._remove

    def slow(source: str, target: str, **folders: int) -> None:
        replace(source, target, **folders)
        time.sleep(0.01)

    def late(folder: Folder, name: str) -> None:
        time.sleep(0.01)
        remove(folder, name)

    os.replace, manifest._remove = slow, late


def write_many(folder: Path, first: int, count: int = 1000) -> None:
    for number in range(first, first + count):
        write_run(folder, number)


def kill_a_writer(folder: Path, chance: random.Random) -> list[str]:
    """SIGKILL anywhere in a row of runs."""
    write_run(folder, 0)

    def work() -> None:
        slow_down()
        write_many(folder, 1)

    writer = child(work)
    time.sleep(chance.uniform(0.0, 0.2))
    os.kill(writer, signal.SIGKILL)
    ended(writer)
    return after(folder)


def signal_a_writer(folder: Path, chance: random.Random) -> list[str]:
    """SIGINT or SIGTERM anywhere in a row of runs: one line, and never a mixture."""
    write_run(folder, 0)
    ready, errors = os.pipe(), tempfile.TemporaryFile()  # noqa: SIM115 - outlives the fork

    def work() -> None:
        with ended_by_signals():
            os.write(ready[1], b"!")
            slow_down()
            write_many(folder, 1)

    number = chance.choice((signal.SIGINT, signal.SIGTERM))
    writer = child(work, errors.fileno())
    os.read(ready[0], 1)
    time.sleep(chance.uniform(0.0, 0.2))
    os.kill(writer, number)
    code = ended(writer)
    errors.seek(0)
    said = errors.read().decode()
    for descriptor in ready:
        os.close(descriptor)
    errors.close()
    bad = [] if code == 128 + number else [f"traceback: code {code}"]
    bad += [] if said == f"ended by {number.name}\n" else [f"traceback: {said}"]
    bad += [f"wrong: {line}" for line in manifest.mixed(folder)]
    return [*bad, *left(folder), *after(folder)]


def signal_at(step: int) -> list[int]:
    """Send SIGTERM to this process at a step of Python, 0 for none; how many there were."""
    steps = [0]

    def traced(frame: FrameType, event: str, _: object) -> object:
        frame.f_trace_opcodes = True
        if event == "opcode":
            steps[0] += 1
            if steps[0] == step:
                os.kill(os.getpid(), signal.SIGTERM)
        return traced if frame.f_code.co_filename.endswith(INTERRUPTED) else None

    sys.settrace(traced)
    return steps


@functools.cache
def steps_of_a_run() -> int:
    """In which a signal can come while a run is written."""
    with tempfile.TemporaryDirectory() as folder:
        before = sys.gettrace()
        steps = signal_at(0)
        write_run(Path(folder), 1)
        sys.settrace(before)
    return steps[0]


def signal_at_a_step(folder: Path, chance: random.Random) -> list[str]:
    """SIGTERM between any two steps of Python in the code that writes."""
    write_run(folder, 0)
    step = chance.randrange(1, steps_of_a_run())

    def work() -> None:
        with ended_by_signals():
            signal_at(step)
            write_run(folder, 1)
            sys.settrace(None)

    code = ended(child(work, os.open(os.devnull, os.O_WRONLY)))
    bad = [] if code == 128 + signal.SIGTERM else [f"traceback: code {code} at step {step}"]
    bad += [f"wrong: {line}" for line in manifest.mixed(folder)]
    return [*bad, *left(folder), *after(folder)]


def fill_the_disk(folder: Path, chance: random.Random) -> list[str]:
    """No file may be longer than so much: the run is whole, or the older one is."""
    write_run(folder, 0)
    limit = int(chance.uniform(0.0, 1.3) * (folder / "results.nc").stat().st_size)

    def work() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        write_run(folder, 1)

    code = ended(child(work))
    bad = [] if code in (0, 2) else [f"traceback: code {code}"]
    bad += [f"wrong: {line}" for line in manifest.mixed(folder)]
    return [*bad, *left(folder), *after(folder)]


def fill_the_disk_of_the_cache(folder: Path, chance: random.Random) -> list[str]:
    """What is computed comes all the same."""
    os.environ["XDG_CACHE_HOME"] = str(folder)
    limit = int(chance.uniform(0.0, 80_000.0))

    def work() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        result, _ = storage.cached("kind", {"a": 1}, lambda: dataset(1))
        assert result.equals(dataset(1))

    code = ended(child(work))
    result, _ = storage.cached("kind", {"a": 1}, lambda: dataset(1))
    bad = [] if code == 0 else [f"lost: code {code}"]
    return [*bad, *([] if result.equals(dataset(1)) else ["wrong: cache"]), *left(folder)]


def read_beside_writers(folder: Path, chance: random.Random) -> list[str]:
    """Three writers and two readers of one folder: no reader is refused or reads a mixture."""
    write_run(folder, 0)

    def read() -> None:
        for _ in range(60):
            try:
                results = storage.open_results(folder / "results.nc")
            except StorageError as error:
                raise AssertionError from error
            assert results.equals(dataset(int(results.attrs["number"])))

    firsts = (100, 200, 300)
    writers = [child(lambda first=first: write_many(folder, first, 8)) for first in firsts]
    readers = [child(read) for _ in range(2)]
    bad = ["lost: a reader was refused" for reader in readers if ended(reader)]
    bad += ["traceback: a writer" for writer in writers if ended(writer)]
    bad += [f"wrong: {line}" for line in manifest.mixed(folder)]
    return [*bad, *seen(folder), *left(folder)]


def compute_together(folder: Path, chance: random.Random) -> list[str]:
    """Three want the same of the cache, one is killed: the others have it."""
    os.environ["XDG_CACHE_HOME"] = str(folder)

    def compute() -> xr.Dataset:
        time.sleep(0.02)
        return dataset(2)

    def work() -> None:
        result, _ = storage.cached("kind", {"a": 2}, compute)
        assert result.equals(dataset(2))

    workers = [child(work) for _ in range(3)]
    time.sleep(chance.uniform(0.0, 0.06))
    os.kill(workers[0], signal.SIGKILL)
    codes = [ended(worker) for worker in workers]
    with cache.opened() as opened:
        cache.tidy(opened)
    bad = [f"lost: code {code}" for code in codes[1:] if code]
    result, _ = storage.cached("kind", {"a": 2}, compute)
    return [*bad, *([] if result.equals(dataset(2)) else ["wrong: cache"]), *left(folder)]


def flip_a_bit(folder: Path, chance: random.Random) -> list[str]:
    """One bit, or the end cut off: results are refused, other files are named."""
    write_run(folder, chance.randrange(10))
    path = chance.choice([path for path in folder.rglob("*") if path.is_file()])
    damage(path, chance)
    with suppress(StorageError):
        storage.open_results(folder / "results.nc")
        if path.name == "results.nc":
            return ["wrong: read although damaged"]
    return [] if manifest.mixed(folder) or path.name == "results.nc" else [f"wrong: {path.name}"]


def flip_a_bit_of_the_cache(folder: Path, chance: random.Random) -> list[str]:
    """What is damaged is computed again."""
    os.environ["XDG_CACHE_HOME"] = str(folder)
    storage.cached("kind", {"a": 3}, lambda: dataset(3))
    (path,) = cache.folder().glob("*.nc")
    damage(path, chance)
    result, was_cached = storage.cached("kind", {"a": 3}, lambda: dataset(3))
    return [] if result.equals(dataset(3)) and not was_cached else ["wrong: cache"]


def damage(path: Path, chance: random.Random) -> None:
    content = bytearray(path.read_bytes())
    if chance.random() < 0.3:
        del content[chance.randrange(len(content)) :]
    else:
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    path.write_bytes(content)


TRIALS: Final[tuple[Trial, ...]] = (
    kill_a_writer,
    signal_a_writer,
    signal_at_a_step,
    fill_the_disk,
    fill_the_disk_of_the_cache,
    read_beside_writers,
    compute_together,
    flip_a_bit,
    flip_a_bit_of_the_cache,
)


class Counts:
    """Tries of every trial and what went wrong, in a file that is kept after each of them.

    A try has its chance from seed, trial and number, so that a later call goes on where this one
    ends and any try can be made again.
    """

    def __init__(self, file: Path | None, seed: int) -> None:
        self.file = file
        self.seed = seed
        self.of: dict[str, Counter[str]] = {}
        if file is not None and file.exists():
            with file.open(encoding="utf-8", newline="") as text:
                for row in csv.DictReader(text):
                    self.seed = int(row["seed"])
                    self.of[row["trial"]] = Counter({kind: int(row[kind]) for kind in COLUMNS})

    def tries(self, trial: Trial) -> int:
        """How often a trial was made."""
        return self.of.setdefault(trial.__name__, Counter())["tries"]

    def make(self, trial: Trial) -> None:
        """Try once more and count."""
        number = self.tries(trial)
        folder = Path(tempfile.mkdtemp(prefix="torture-"))
        try:
            bad = trial(folder, random.Random(f"{self.seed} {trial.__name__} {number}"))
        except Exception:
            bad = [f"traceback: {traceback.format_exc()}"]
        shutil.rmtree(folder, ignore_errors=True)
        kinds = (reason.partition(":")[0] for reason in bad)
        self.of[trial.__name__].update(["tries", *kinds])
        for reason in bad:
            print(f"{trial.__name__}, try {number}, seed {self.seed}: {reason}", flush=True)
        self._keep()

    def _keep(self) -> None:
        if self.file is None:
            return
        self.file.parent.mkdir(parents=True, exist_ok=True)
        written = self.file.with_suffix(".new")
        with written.open("w", encoding="utf-8", newline="") as text:
            rows = csv.writer(text)
            rows.writerow(("seed", "trial", *COLUMNS))
            for name, count in self.of.items():
                rows.writerow((self.seed, name, *(count[kind] for kind in COLUMNS)))
        written.replace(self.file)

    def __str__(self) -> str:
        head = f"{'':28}" + "".join(f"{kind:>10}" for kind in COLUMNS)
        rows = (
            f"{name:28}" + "".join(f"{count[kind]:10}" for kind in COLUMNS)
            for name, count in self.of.items()
        )
        return "\n".join((head, *rows))

    @property
    def wrong(self) -> int:
        """How much went wrong in all."""
        return sum(count[kind] for count in self.of.values() for kind in KINDS)


def torture(
    trials: tuple[Trial, ...], tries: int, minutes: float, seed: int, file: Path | None = None
) -> int:
    """Try in turn until each was tried so often, or so long; returns how much went wrong.

    Parameters
    ----------
    trials : what is done
    tries : of each, those that the file counts included; at least one where there are minutes
    minutes : after which no further try begins; 0 for no end
    seed : of the chances, where there is no file
    file : keeps the counts; none for none
    """
    counts = Counts(file, seed)
    end = time.monotonic() + 60.0 * minutes if minutes else float("inf")
    while open_trials := [trial for trial in trials if counts.tries(trial) < tries]:
        for trial in open_trials:
            counts.make(trial)
            if time.monotonic() > end:
                print(counts)
                return counts.wrong
    print(counts)
    return counts.wrong


def main() -> None:
    """From the command line; exit code 1 where anything went wrong."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=0.0)
    parser.add_argument("--tries", type=int, default=10**9)
    parser.add_argument("--only", nargs="*", help="names of trials, or how they begin")
    parser.add_argument("--file", type=Path, help="keeps the counts; a later call goes on")
    parser.add_argument("--seed", type=int, default=20061)
    arguments = parser.parse_args()
    from commands_torture import COMMAND_TRIALS
    from input_torture import INPUT_TRIALS

    trials = TRIALS + INPUT_TRIALS + COMMAND_TRIALS
    if arguments.only:
        begin = tuple(arguments.only)
        trials = tuple(trial for trial in trials if trial.__name__.startswith(begin))
    given = (arguments.tries, arguments.minutes, arguments.seed, arguments.file)
    sys.exit(bool(torture(trials, *given)))


if __name__ == "__main__":
    main()
