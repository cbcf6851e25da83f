"""Seeded faults: one formula, sign, factor or threshold is changed; do the tests see it?

    python tests/robustness/seeded_faults.py [--seed S] [--number N]

Works in a copy of the repository and goes on where a killed run stopped. The tests are collected
once. A first child process runs the quick ones and writes down which of them execute the lines of
the faults. A child process for each fault gets the changed code in memory and runs these tests, the
fastest first, until one fails. A fault in a constant or in compiled code is written into a copy and
needs a process of its own, with the files of tests that share most words with it. `--all` runs
every test once for a survivor, which takes minutes each.

- caught: a test fails, or takes ten times as long as before
- survived: all these tests pass and some execute the line
- never executed: none executes the line

`--again TEST …` runs these tests on the survivors. `--table FILE` writes the outcomes as CSV; the
column with the reasons of survivors is written by hand and kept.
"""

import argparse
import csv
import gc
import importlib
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import groupby, islice, pairwise
from pathlib import Path
from typing import Final, TextIO

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import fault_code
import pytest
from fault_places import ROOMS, Place, chosen, places_of
from fault_tests import Order, by_time

ROOT: Final = Path(__file__).resolve().parents[2]
FOLDER: Final = Path(tempfile.gettempdir()) / "seeded_faults"
FOLDERS: Final = (
    *(
        f"tests/units/{room}"
        for room in (
            "mechanics", "mechanisms", "balancers", "sources", "transfer", "levels", "scoring",
            "uncertainty", "stopping", "measured", "sound", "orders", "recordings", "radiation",
            "pipeline", "stages",
        )
    ),
    "tests/invariants", "tests/literature", "tests/oracles",
)  # fmt: skip
"""Tests of formulas; none looks at pages or runs commands."""
PRELOADED: Final = (
    "numba.core.caching", "scipy.integrate", "scipy.interpolate", "scipy.linalg", "scipy.optimize",
    "scipy.signal", "scipy.sparse.linalg", "scipy.spatial", "scipy.special", "scipy.stats",
)  # fmt: skip
"""Imported once, for all child processes."""
QUICK: Final = "not slow and not long"
LEAST_S: Final = 30.0
SLOWER: Final = 10.0
"""A test hangs that takes so many times as long as before and the least; kernels may compile."""
HARD_S: Final = 120
"""Processor time over that of the tests after which a child process is killed."""
MAPPED_S: Final = 0.8
"""Tests in the map take no longer."""
FIRST: Final = 4
"""Tests of a file that run before those of other files."""
UNSEEN_FILES: Final = 3
"""Files whose tests all run when none in the map executes the line."""
LONGEST_S: Final = 5.0
FRESH_FILES: Final = 3
"""Tests for a fault that needs a process of its own: not longer, of so many files."""
COLUMNS: Final = ("seed", "number", "file", "line", "text", "change", "outcome", "test", "reason")


class Faults:
    """A pytest plug-in that runs the tests of each fault in a child process."""

    def __init__(
        self, places: Sequence[Place], options: argparse.Namespace, results: Path, progress: TextIO
    ) -> None:
        self._places = places
        self._options = options
        self._results = results
        self._progress = progress
        self._tree = options.folder / "tree"
        self._trees = [options.folder / f"tree_{job}" for job in range(options.jobs)]
        self._times = options.folder / "times.json"
        self._seconds: dict[str, float] = {}
        self._executing: dict[str, list[str]] = {}
        if self._times.exists():
            self._seconds = json.loads(self._times.read_text(encoding="utf-8"))
        self._failed = ""
        self._executed = 0

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        items = defaultdict(dict)
        for item in session.items:
            items[item.nodeid.split("::", maxsplit=1)[0]][item.nodeid] = item
        order = Order(self._tree, items)
        for name in (*PRELOADED, *_modules(self._tree)):
            importlib.import_module(name)
        gc.collect()
        gc.freeze()  # else each collection in a child copies the pages of all objects
        self._executing = self._map(session.items)
        running: dict[int, tuple[Place, Path, Path]] = {}
        start = time.monotonic()
        waiting = sorted(self._places, key=lambda place: not place.is_living)
        with tempfile.TemporaryDirectory() as folder:
            while waiting or running:
                while waiting and len(running) < self._options.jobs:
                    place, tree = waiting.pop(0), self._trees.pop()
                    answer = Path(folder) / f"{len(waiting)}.json"
                    process = os.fork()
                    if process == 0:
                        self._child(place, tree, answer, order, items)
                    running[process] = (place, tree, answer)
                process, status = os.wait()
                place, tree, answer = running.pop(process)
                self._trees.append(tree)
                self._keep(place, self._answer(answer, status))
                done = len(self._places) - len(waiting) - len(running)
                left_min = (time.monotonic() - start) / done * (len(waiting) + len(running)) / 60.0
                print(f"  {done} of {len(self._places)}, {left_min:.0f} min left",
                      file=self._progress, flush=True)  # fmt: skip
        return True

    def _map(self, items: Sequence[pytest.Item]) -> dict[str, list[str]]:
        """Quick tests that execute the line of each fault in a living function.

        One child process runs them all, with a call before each of these lines.
        """
        file = self._results.with_suffix(".executed.json")
        living = [place for place in self._places if place.is_living]
        if not file.exists():
            process = os.fork()
            if process == 0:
                try:
                    _silence()
                    self._write_map(file, living, items)
                finally:
                    os._exit(0)
            os.waitpid(process, 0)
        return json.loads(file.read_text(encoding="utf-8"))

    def _write_map(self, file: Path, places: Sequence[Place], items: Sequence[pytest.Item]) -> None:
        executed: set[str] = set()
        gc.unfreeze()
        for name, inside in groupby(sorted(places, key=_file_of), _file_of):
            calls = {place.first: partial(executed.add, place.key) for place in inside}
            fault_code.put_in(self._tree, name, (self._tree / name).read_bytes(), calls)
        gc.freeze()
        executing = defaultdict(list)
        quick = [item for item in items if self._seconds.get(item.nodeid, 0.0) < MAPPED_S]
        start = time.monotonic()
        for number, (item, following) in enumerate(pairwise([*quick, None]), 1):
            executed.clear()
            self._failed = ""
            before = _processor_s()
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
            self._seconds[item.nodeid] = round(_processor_s() - before, 3)
            if not self._failed:
                for key in executed:
                    executing[key].append(item.nodeid)
            if number % 100 == 0:
                left_min = (time.monotonic() - start) / number * (len(quick) - number) / 60.0
                print(
                    f"map: {number} of {len(quick)} tests, {left_min:.0f} min left",
                    file=self._progress,
                    flush=True,
                )
        self._times.write_text(json.dumps(self._seconds), encoding="utf-8")
        file.write_text(json.dumps(executing), encoding="utf-8")

    def _answer(self, answer: Path, status: int) -> dict[str, object]:
        """What a child process wrote; one that was killed hung."""
        if answer.exists():
            return json.loads(answer.read_text(encoding="utf-8"))
        code = os.waitstatus_to_exitcode(status)
        return {"outcome": "caught" if code < 0 else "error", "test": f"ended by {code}"}

    def _keep(self, place: Place, row: dict[str, object]) -> None:
        self._seconds |= row.pop("times", {})
        self._times.write_text(json.dumps(self._seconds), encoding="utf-8")
        with self._results.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"key": place.key, **row}) + "\n")
        print(
            f"{row['outcome']}: {place.file}:{place.first}: {place.before} to {place.after}: "
            f"{row['test']} ({row.get('seconds', 0.0)} s)",
            end="", file=self._progress,
        )  # fmt: skip

    def _child(
        self,
        place: Place,
        tree: Path,
        answer: Path,
        order: Order,
        items: dict[str, dict[str, pytest.Item]],
    ) -> None:
        """Run the tests of a fault in this process, which ends with it."""
        try:
            os.setsid()
            _silence()
            limit = int(self._options.seconds + HARD_S)
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
            row = {"outcome": "never executed"}
            if place.is_living and not self._options.again:
                row = self._in_memory(place, order, items)
            if row["outcome"] == "never executed":  # it may be in processes that tests start
                in_a_copy = self._in_a_copy(place, tree, order, items)
                row = in_a_copy if in_a_copy["test"] or not place.is_living else row
            row["seconds"] = round(_processor_s(), 1)
            answer.write_text(json.dumps(row), encoding="utf-8")
        except BaseException as error:  # the parent goes on whatever happens here
            answer.write_text(json.dumps({"outcome": "error", "test": repr(error)}))
        finally:
            os._exit(0)

    def _in_memory(
        self, place: Place, order: Order, items: dict[str, dict[str, pytest.Item]]
    ) -> dict[str, object]:
        gc.unfreeze()
        changed = place.changed((self._tree / place.file).read_bytes())
        fault_code.put_in(self._tree, place.file, changed, {place.first: self._count})
        gc.freeze()
        times = {}
        sequence = self._sequence(place, order, items)
        item = next(sequence, None)
        while item is not None and not self._failed:
            following = next(sequence, None)
            start = _processor_s()
            usual = self._seconds.get(item.nodeid, 0.0)
            signal.signal(signal.SIGPROF, _end)
            signal.setitimer(signal.ITIMER_PROF, LEAST_S + SLOWER * usual)
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            if not self._failed:
                times[item.nodeid] = round(_processor_s() - start, 3)
            item = following
        row = {"test": self._failed, "executed": self._executed, "tests": len(times)}
        if self._failed:
            return {"outcome": "caught", **row}
        return {"outcome": "survived" if self._executed else "never executed",
                "times": times, **row}  # fmt: skip

    def _sequence(
        self, place: Place, order: Order, items: dict[str, dict[str, pytest.Item]]
    ) -> Iterator[pytest.Item]:
        """Tests until the time is up: those that execute the line, then others of their files.

        The others may see it too: what a fixture of a file computes is counted to its first test.
        Where the map has none, the slower ones of the likeliest files come.
        """
        end = _processor_s() + self._options.seconds
        executing = defaultdict(list)
        for test in by_time(self._executing.get(place.key, []), self._seconds):
            executing[test.split("::", maxsplit=1)[0]].append(test)
        first = [test for tests in executing.values() for test in tests[:FIRST]]
        later = [test for tests in executing.values() for test in tests[FIRST:]]
        files = list(executing) or order.files(place)[:UNSEEN_FILES]
        others = [test for file in files for test in by_time(list(items[file]), self._seconds)]
        for test in dict.fromkeys([*first, *later, *others]):
            if _processor_s() > end:
                return
            yield items[test.split("::", maxsplit=1)[0]][test]

    def _in_a_copy(
        self, place: Place, tree: Path, order: Order, items: dict[str, dict[str, pytest.Item]]
    ) -> dict[str, object]:
        """Run the tests in a new process that imports a changed file."""
        tests = self._options.again or [
            test
            for file in order.files(place)[:FRESH_FILES]
            for test in by_time(list(items[file]), self._seconds)
            if self._seconds.get(test, 0.5) < LONGEST_S
        ]
        file = _copy(tree) / place.file
        content, state = file.read_bytes(), file.stat()
        try:
            file.write_bytes(place.changed(content))
            failed = _failing(tree, tests)
        finally:
            file.write_bytes(content)
            os.utime(file, ns=(state.st_atime_ns, state.st_mtime_ns))
        return {"outcome": "caught" if failed else "survived", "test": failed, "tests": len(tests)}

    def _count(self) -> None:
        self._executed += 1

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed and not self._failed:
            self._failed = report.nodeid


def main() -> None:
    """Run the faults of a seed, or what the options ask."""
    options = _options()
    results = options.folder / f"seed_{options.seed}.jsonl"
    tree = _copy(options.folder / "tree")
    faults = list(islice(chosen(places_of(tree), options.seed), options.number))
    known = _known(results)
    if options.again or options.all:
        waiting = [place for place in faults if known.get(place.key, {}).get("test") == ""]
        options.again = options.again or ["tests"]
    else:
        waiting = [place for place in faults if place.key not in known]
    if waiting:
        progress = os.fdopen(os.dup(2), "w")
        os.chdir(tree)
        sys.path.insert(0, str(tree))
        os.environ["PYTHONPATH"] = str(tree)
        folders = ["tests/oracles/test_cabinet.py"] if options.again else FOLDERS
        arguments = ["-q", "-n0", "-m", QUICK, "-p", "no:cacheprovider", "-p", "no:pytest_cov"]
        pytest.main([*arguments, *folders], plugins=[Faults(waiting, options, results, progress)])
    known = _known(results)
    counts = Counter(known[place.key]["outcome"] for place in faults if place.key in known)
    print(", ".join(f"{outcome}: {count}" for outcome, count in sorted(counts.items())))
    if options.table:
        _write_table(options.table, options.seed, faults, known)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--number", type=int, default=200, help="faults, the first of the seed")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="copies and results")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60.0, help="processor time of a fault")
    parser.add_argument("--all", action="store_true", help="every test for each survivor")
    parser.add_argument("--again", nargs="+", default=[], metavar="TEST", help="for survivors")
    parser.add_argument("--table", type=Path, help="CSV of the outcomes")
    options = parser.parse_args()
    options.folder = options.folder.resolve()
    options.table = options.table and options.table.resolve()
    return options


def _copy(tree: Path) -> Path:
    """A copy of the files that git knows; those that are the same stay, with their time."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    for name in filter(None, listed.split("\0")):
        source, target = ROOT / name, tree / name
        if not source.is_file():
            target.unlink(missing_ok=True)
        elif not target.exists() or source.read_bytes() != target.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, target)
    return tree


def _modules(tree: Path) -> list[str]:
    """Modules of the physics rooms."""
    files = (path for room in ROOMS for path in (tree / "vibroacoustics" / room).rglob("*.py"))
    return [
        ".".join(file.relative_to(tree).with_suffix("").parts).removesuffix(".__init__")
        for file in sorted(files)
    ]


def _failing(tree: Path, tests: Sequence[str]) -> str:
    """First of the tests that fails in a new process, with kernels that are compiled anew."""
    with tempfile.TemporaryDirectory() as kernels:
        environment = os.environ | {
            "PYTHONPATH": str(tree),
            "PYTHONDONTWRITEBYTECODE": "1",  # two changes of a second look alike to Python
            "NUMBA_CACHE_DIR": kernels,
        }
        done = subprocess.run(
            [sys.executable, "-m", "pytest", "-q", "-x", "-n0", "--tb=no", "-rfE", "-p",
             "no:cacheprovider", *tests],
            cwd=tree, env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
    for line in done.stdout.splitlines():
        if line.startswith(("FAILED ", "ERROR ")):
            return line.split(" ", maxsplit=1)[1].split(" - ")[0]
    return "" if done.returncode == 0 else f"pytest ended by {done.returncode}"


def _processor_s() -> float:
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def _silence() -> None:
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)


def _file_of(place: Place) -> str:
    return place.file


def _end(*_: object) -> None:
    raise TimeoutError("the test takes too long")


def _known(results: Path) -> dict[str, dict[str, str]]:
    """The last outcome of each fault; a line that a kill cut is passed over."""
    known = {}
    if results.exists():
        for line in results.read_text(encoding="utf-8").splitlines():
            try:
                row = json.loads(line)
            except json.JSONDecodeError:
                continue
            known[row["key"]] = row
    return known


def _write_table(
    table: Path, seed: int, faults: Sequence[Place], known: dict[str, dict[str, str]]
) -> None:
    """Outcomes as CSV; faults of another seed and all reasons stay."""
    rows = []
    if table.exists():
        with table.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    reasons = {(row["file"], row["text"], row["change"]): row["reason"] for row in rows}
    rows = [row for row in rows if row["seed"] != str(seed)]
    for number, place in enumerate(faults, 1):
        found = known.get(place.key)
        if found:
            change = " ".join(f"{place.kind}: {place.before} to {place.after}".split())
            values = (
                seed, number, place.file, place.first, place.text, change, found["outcome"],
                found["test"], reasons.get((place.file, place.text, change), ""),
            )  # fmt: skip
            rows.append(dict(zip(COLUMNS, map(str, values), strict=True)))
    with table.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
