"""Advance of long work on stderr: a bar on a terminal, else a line a stage."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final

from ..base.progress import Progress

SHORTEST_S: Final = 1.0
"""A stage that takes less is not worth a line."""
PAUSE_S: Final = 30.0
"""Between two lines of a stage."""


@contextmanager
def progress_on_stderr() -> Iterator[Progress]:
    """A bar with remaining time; where stderr is no terminal, lines."""
    if not sys.stderr.isatty():
        yield Lines(lambda line: print(line, file=sys.stderr, flush=True))
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        TaskID,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("ETA"),
        TimeRemainingColumn(),
    )
    tasks: dict[str, TaskID] = {}
    with Progress(*columns, console=Console(stderr=True)) as bar:

        def advance(description: str, done: int, total: int) -> None:
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

    Stages may run in several threads at once.

    Parameters
    ----------
    write : takes a line
    clock : in s
    """

    def __init__(
        self, write: Callable[[str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._write, self._clock = write, clock
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
                if elapsed >= SHORTEST_S:
                    self._write(f"progress: {task}: done in {elapsed:.0f} s")
            elif now >= stage.due_s and done > stage.done:
                stage.due_s = now + PAUSE_S
                left = elapsed * (total - done) / (done - stage.done)
                self._write(
                    f"progress: {task}: {done} of {total} after {elapsed:.0f} s, ETA {left:.0f} s"
                )
