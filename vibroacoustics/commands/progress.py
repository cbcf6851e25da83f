"""Advance of long work on stderr: a bar on a terminal, else a line a stage."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final

from ..base.progress import Progress
from . import messages

SHORTEST_S: Final = 1.0
"""A stage that takes less is not worth a line."""
PAUSE_S: Final = 30.0
"""Time between two lines of a stage."""


@contextmanager
def progress_on_stderr(quiet: bool = False, verbose: bool = False) -> Iterator[Progress]:
    """A bar with remaining time; where stderr is no terminal, lines; verbose, one for every stage.

    The log gets lines.
    """
    shortest_s = 0.0 if verbose else SHORTEST_S
    if quiet:
        yield Lines(messages.note, shortest_s=shortest_s)
    elif verbose or not sys.stderr.isatty():
        yield Lines(messages.inform, shortest_s=shortest_s)
    else:
        with _bar() as progress:
            yield progress


@contextmanager
def _bar() -> Iterator[Progress]:
    from rich.console import Console
    from rich.progress import BarColumn, TaskID, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bars

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("ETA"),
        TimeRemainingColumn(),
    )
    tasks: dict[str, TaskID] = {}
    lines = Lines(messages.note)
    with Bars(*columns, console=Console(stderr=True)) as bar:

        def advance(description: str, done: int, total: int) -> None:
            lines(description, done, total)
            if description not in tasks:
                tasks[description] = bar.add_task(description, total=total)
            bar.update(tasks[description], completed=done, total=total)

        yield advance


@dataclass
class _Stage:
    """A stage that runs: when it began, how far it was then, when a line is due."""

    begin_s: float
    done: int
    due_s: float


class Lines:
    """Advance as lines: of a stage that takes seconds one at its end, of a long one some before.

    Stages may run in several threads at once. One that takes less than `shortest_s` gets no line.
    """

    def __init__(
        self,
        write: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
        shortest_s: float = SHORTEST_S,
    ) -> None:
        self._write, self._clock, self._shortest_s = write, clock, shortest_s
        self._stages: dict[str, _Stage] = {}
        self._lock = threading.Lock()

    def __call__(self, task: str, done: int, total: int) -> None:
        """Take note of the advance; see `Progress`."""
        with self._lock:
            now = self._clock()
            stage = self._stages.setdefault(task, _Stage(now, done, now + PAUSE_S))
            elapsed = now - stage.begin_s
            if done >= total:
                del self._stages[task]
                if elapsed >= self._shortest_s:
                    self._write(f"progress: {task}: done in {elapsed:.0f} s")
            elif now >= stage.due_s and done > stage.done:
                stage.due_s = now + PAUSE_S
                remaining_s = elapsed * (total - done) / (done - stage.done)
                self._write(
                    f"progress: {task}: {done} of {total} after {elapsed:.0f} s, "
                    f"ETA {remaining_s:.0f} s"
                )
