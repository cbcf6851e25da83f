"""One thread for linear algebra while threads of this package are at work.

Threads of OpenBLAS that several callers want at once wait for each other in busy loops: up to
thirteen times the work where a machine is loaded.
"""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from threading import Lock
from typing import Any, Final

import numpy as np
import scipy

_NAMES: Final = ("scipy_openblas_{}_num_threads", "scipy_openblas_{}_num_threads64_")


class _OpenBlas:
    """OpenBLAS in the wheels of NumPy and SciPy; nothing where there is none."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._callers = 0
        self._before: list[int] = []

    def enter(self) -> None:
        """One more caller wants one thread."""
        with self._lock:
            if self._callers == 0:
                self._before = [get() for get, _ in self._functions]
                self._put([1] * len(self._before))
            self._callers += 1

    def leave(self) -> None:
        """One caller less; the last one gives the threads back."""
        with self._lock:
            self._callers -= 1
            if self._callers == 0:
                self._put(self._before)

    @property
    def threads(self) -> list[int]:
        """Number of threads of each library."""
        return [get() for get, _ in self._functions]

    def _put(self, threads: list[int]) -> None:
        for (_, put), number in zip(self._functions, threads, strict=True):
            put(number)

    @cached_property
    def _functions(self) -> list[tuple[Callable[[], int], Callable[[int], Any]]]:
        """Getter and setter of the number of threads of each library."""
        functions = []
        for package in (np, scipy):
            folder = Path(str(package.__file__)).parent
            for path in folder.parent.glob(f"{folder.name}.libs/*openblas*"):
                library = ctypes.CDLL(str(path))  # loaded already: the same one
                functions += [
                    (getattr(library, name.format("get")), getattr(library, name.format("set")))
                    for name in _NAMES
                    if hasattr(library, name.format("set"))
                ]
        return functions


OPENBLAS: Final = _OpenBlas()


@contextmanager
def one_thread_of_linear_algebra() -> Iterator[None]:
    """Products and factorisations take one thread each, whoever calls them."""
    OPENBLAS.enter()
    try:
        yield
    finally:
        OPENBLAS.leave()
