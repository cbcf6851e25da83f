"""The pool of processes: results, deaths, bounds, ends, and that nobody else can reach it."""

import itertools
import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from threading import Thread

import process_work
import psutil
import pytest

from vibroacoustics.base import worker_process
from vibroacoustics.base.errors import SolverError
from vibroacoustics.base.processes import ProcessPool

ROOT = Path(__file__).resolve().parents[3]
SQUARES = [number**2 for number in range(30)]


@pytest.fixture(scope="module")
def pool() -> Iterator[ProcessPool]:
    """Two processes that several tests share: each must leave them fit for the next."""
    with ProcessPool(2) as opened:
        yield opened


def wait_for(condition, seconds: float = 20.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def workers_of(parent: psutil.Process) -> list[psutil.Process]:
    """Those started afresh, and copies, which have the command of their parent."""
    commands, copied = [(one, command_of(one)) for one in parent.children()], command_of(parent)
    return [one for one, command in commands if command == copied or "spawn_main" in command]


def command_of(process: psutil.Process) -> str:
    """Command line; empty of one that has ended and that another test has not waited for."""
    with suppress(psutil.ZombieProcess, psutil.NoSuchProcess):
        return " ".join(process.cmdline())
    return ""


def test_results_are_in_order_and_by_two_processes(pool):
    assert list(pool.in_order(process_work.square, range(30))) == SQUARES
    assert sorted(pool.as_completed(process_work.square, range(30))) == list(enumerate(SQUARES))
    numbers = set(pool.in_order(process_work.process_of, range(100)))
    assert len(numbers) <= 2
    assert os.getpid() not in numbers
    assert list(pool.in_order(process_work.square, [])) == []


def test_results_come_as_completed(pool):
    assert [index for index, _ in pool.as_completed(process_work.pause, [1.0, 0.0, 0.0])] == [
        1,
        2,
        0,
    ]
    assert list(pool.in_order(process_work.pause, [0.1, 0.0, 0.0])) == [0.1, 0.0, 0.0]


def test_killed_workers_lose_nothing(pool, tmp_path):
    """Every third of 12 items kills its worker the first time."""
    function = partial(process_work.end_once, tmp_path, 1)
    assert list(pool.in_order(function, range(12))) == SQUARES[:12]
    assert len(list(tmp_path.iterdir())) == 4


def test_item_that_ends_two_workers_is_reported(pool, tmp_path):
    function = partial(process_work.end_once, tmp_path, 9)
    lost = pool.in_order(function, range(5), lambda item, reason: (item, reason))
    assert list(lost) == [(0, "SIGKILL"), 1, 4, (3, "SIGKILL"), 16]
    assert [path.read_text() for path in tmp_path.iterdir()] == ["xx", "xx"]
    with pytest.raises(SolverError, match=r"two worker processes ended at the same item \(SIGKILL"):
        list(pool.in_order(function, [6]))


def test_workers_killed_before_they_begin(pool):
    """Two in turn, which have not read the item that they were given: it is not blamed."""
    list(pool.in_order(process_work.pause, [0.1, 0.1]))
    workers = workers_of(psutil.Process())
    for worker in workers:
        worker.suspend()

    def kill() -> None:
        for worker in workers:
            time.sleep(0.2)
            worker.kill()

    killer = Thread(target=kill)
    killer.start()
    assert list(pool.in_order(process_work.square, [7])) == [49]
    killer.join()


def test_items_are_taken_as_they_are_needed(pool):
    """Of endless items; a slow one does not let the results behind it pile up."""
    taken: list[int] = []

    def seconds() -> Iterator[float]:
        for number in itertools.count():
            taken.append(number)
            yield 0.0 if number else 0.5

    results = pool.in_order(process_work.pause, seconds())
    assert next(results) == 0.5
    assert len(taken) <= 4 * 2 + 2  # ahead of the slow one, and what follows it
    results.close()
    for index, _ in pool.as_completed(process_work.square, itertools.count()):
        if index == 20:
            break
    assert list(pool.in_order(process_work.square, range(30))) == SQUARES


def test_an_error_ends_the_map_and_not_the_pool(pool):
    with pytest.raises(ValueError, match="three is wrong") as caught:
        list(pool.in_order(process_work.fail, range(9)))
    assert "process_work.py" in caught.value.__notes__[0]
    with pytest.raises(SolverError, match=r"^TwoPartError: oddly$"):
        list(pool.in_order(process_work.fail_oddly, [1]))
    with pytest.raises(Exception, match="pickle"):
        list(pool.in_order(process_work.unsendable, [1]))
    with pytest.raises(Exception, match="pickle"):
        list(pool.in_order(process_work.square, [lambda: None]))
    assert list(pool.in_order(process_work.square, range(30))) == SQUARES


def test_two_maps_at_a_time_are_refused(pool):
    first = pool.as_completed(process_work.pause, [0.0, 0.5, 0.5])
    next(first)
    with pytest.raises(RuntimeError, match="one map at a time"):
        list(pool.in_order(process_work.square, [1]))
    first.close()


def test_workers_that_cannot_begin(monkeypatch):
    monkeypatch.setattr(worker_process, "_serve", process_work.leave)
    with (
        ProcessPool(1) as broken,
        pytest.raises(SolverError, match="end before they begin to work: exit code 7"),
    ):
        list(broken.in_order(process_work.square, [1]))


def endpoints(process: psutil.Process) -> set[object]:
    """What another process could find: internet sockets, named sockets, and open files to write."""
    sockets = process.net_connections(kind="all")
    named = {one.laddr for one in sockets if one.laddr}
    return named | {one.path for one in process.open_files() if set(one.mode) & set("wa+")}


def test_there_is_no_endpoint(tmp_path, monkeypatch):
    """No internet socket, no socket or pipe with a name, no temporary file."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    parent = psutil.Process()
    before, present = endpoints(parent), {child.pid for child in parent.children(recursive=True)}
    with ProcessPool(2) as opened:
        running = opened.as_completed(process_work.pause, [0.0, 0.0, 5.0, 5.0])
        next(running), next(running)
        assert endpoints(parent) <= before
        children = [one for one in parent.children(recursive=True) if one.pid not in present]
        workers = [one for one in workers_of(parent) if one in children]
        assert len(workers) == 2
        for child in children:
            assert not endpoints(child)
            for link in Path(f"/proc/{child.pid}/fd").iterdir():
                assert not (link.is_fifo() or link.is_socket()) or ":[" in os.readlink(link)
        assert not list(tmp_path.iterdir())
    assert not any(worker.is_running() for worker in workers)


PARENT = """
    import sys
    from vibroacoustics.commands.signals import ended_by_signals
    def main():
        from process_work import pause
        from vibroacoustics.base.processes import ProcessPool
        inherited = pause if sys.argv[1:] else None
        with ended_by_signals(), ProcessPool(2, inherited) as pool:
            for index, _ in pool.as_completed(pause, [0.0, 0.0, 60.0, 60.0]):
                print(index, flush=True)
    if __name__ == "__main__":
        main()
"""


@pytest.fixture(params=[(), ("forked",)], ids=["afresh", "forked"])
def started(request, tmp_path) -> tuple[subprocess.Popen[str], list[psutil.Process]]:
    """A group of processes, as a terminal makes one, and all that the first one started."""
    script = tmp_path / "parent.py"
    script.write_text(textwrap.dedent(PARENT))
    parent = subprocess.Popen(
        [sys.executable, str(script), *request.param],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "tests/helpers")))},
    )
    number = 2 if request.param else 3  # two workers; those started afresh need Python's tracker
    wait_for(lambda: len(psutil.Process(parent.pid).children()) == number)
    return parent, psutil.Process(parent.pid).children(recursive=True)


def test_interrupt_of_the_group_ends_all_with_one_line(started):
    """While workers start and work they take no notice; none prints a traceback."""
    parent, children = started
    workers = workers_of(psutil.Process(parent.pid))
    lines = Thread(target=lambda: [parent.stdout.readline() for _ in range(2)])
    lines.start()
    while lines.is_alive():
        for worker in workers:
            worker.send_signal(signal.SIGINT)
        time.sleep(0.01)
    assert len(workers) == 2
    assert workers_of(psutil.Process(parent.pid)) == workers
    os.killpg(parent.pid, signal.SIGINT)
    _, errors = parent.communicate(timeout=20)
    assert (parent.returncode, errors) == (130, "ended by SIGINT\n")
    assert not psutil.wait_procs(children, timeout=10)[1]


def test_workers_end_with_a_parent_that_is_killed(started):
    """In the middle of an item of a minute."""
    parent, children = started
    assert parent.stdout is not None
    parent.stdout.readline(), parent.stdout.readline()
    parent.kill()
    _, errors = parent.communicate(timeout=20)
    assert not psutil.wait_procs(children, timeout=10)[1]
    assert errors == ""


FORKED = """
    import sys
    from functools import partial
    from pathlib import Path
    from threading import Event, Thread
    from process_work import end_once
    from vibroacoustics.base.processes import ProcessPool
    from vibroacoustics.base.worker_process import can_fork
    known = {"squares": partial(end_once, Path(sys.argv[1]), 1)}
    square = lambda number: known["squares"](number)
    assert can_fork()
    with ProcessPool(2, inherited=square) as pool:
        print(*pool.in_order(square, range(12)))
        workers = [worker for worker in pool._workers if worker.ready]
    print(*{worker.reason for worker in workers})
    stop = Event()
    other = Thread(target=stop.wait)
    other.start()
    print(can_fork())
    stop.set()
    other.join()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="workers are copies on Linux alone")
def test_forked_workers_know_what_pickle_does_not_take(tmp_path):
    """Killed ones are replaced; nothing is forked beside another thread."""
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(FORKED), str(tmp_path)],
        capture_output=True, text=True, check=True, timeout=60,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "tests/helpers")))},
    )  # fmt: skip
    squares, ends, can_fork = done.stdout.splitlines()
    assert squares.split() == [*map(str, SQUARES[:12])]
    assert ends == "exit code 0"  # each sees its pipe closed, whoever was forked after it
    assert can_fork == "False"
    assert len(list(tmp_path.iterdir())) == 4


INTRUDER = """
    import os, socket, sys
    import psutil
    processes = [psutil.Process(int(word)) for word in sys.argv[1:]]
    numbers = {process.pid for process in processes[1:]}
    named = [one for one in psutil.net_connections(kind="all") if one.pid in numbers and one.laddr]
    os.setgroups([]); os.setgid(65534); os.setuid(65534)
    opened = len(named)
    for process in processes:
        for name in ("fd", "mem", "fd/0", "fd/3", "fd/4", "fd/5", "fd/6", "fd/7", "fd/8"):
            try:
                os.listdir(f"/proc/{process.pid}/{name}") if name == "fd" else os.close(
                    os.open(f"/proc/{process.pid}/{name}", os.O_RDWR))
            except PermissionError:
                continue
            opened += 1
        try:
            process.kill()
        except psutil.AccessDenied:
            continue
        opened += 1
    print(opened, "opened")
"""


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can start a process of another user")
def test_another_user_can_open_nothing(pool):
    """No pipe, no memory, no signal: of the parent and of its workers."""
    running = pool.as_completed(process_work.pause, [0.0, 0.0, 20.0, 20.0])
    next(running), next(running)
    children = psutil.Process().children(recursive=True)
    numbers = [one.pid for one in children if "multiprocessing" in command_of(one)]
    assert len(numbers) >= 3
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(INTRUDER), *map(str, [os.getpid(), *numbers])],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    running.close()
    assert done.stdout == "0 opened\n"
