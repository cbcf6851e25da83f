"""Reports of the advance of long work."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[str, int, int], None]
"""Called with what is being done, steps done and steps in all."""


def no_progress(task: str, done: int, total: int) -> None:
    """Report nothing."""


@contextmanager
def stage(progress: Progress, task: str) -> Iterator[None]:
    """Report work of a few seconds that has no steps: its begin and its end."""
    progress(task, 0, 1)
    yield
    progress(task, 1, 1)
