"""Work in threads, as many as this process has processors."""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from .linear_algebra import one_thread_of_linear_algebra

Item = TypeVar("Item")
Result = TypeVar("Result")


def in_threads(tasks: Sequence[Callable[[], Result]], workers: int | None = None) -> list[Result]:
    """Results of tasks that mostly compute without the interpreter's lock, in their order.

    Linear algebra in them takes one thread each. The first error ends what has not begun.
    """
    return list(mapped_in_threads(lambda task: task(), tasks, workers))


def mapped_in_threads(
    function: Callable[[Item], Result], items: Iterable[Item], workers: int | None = None
) -> Iterator[Result]:
    """Apply a function in threads; the results are in the order of the items."""
    with one_thread_of_linear_algebra(), ThreadPoolExecutor(workers or processors()) as pool:
        yield from pool.map(function, items)


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
