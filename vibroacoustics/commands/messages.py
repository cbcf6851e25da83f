"""Warnings as single lines on stderr, at the moment when they come up."""

import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any


def warn(lines: Iterable[str]) -> None:
    """Print each as a warning."""
    for line in lines:
        print(f"warning: {' '.join(line.split())}", file=sys.stderr)


@contextmanager
def warnings_in_one_line() -> Iterator[None]:
    """Print each of Python's warnings as one line; one that says the same comes once."""
    with warnings.catch_warnings():
        warnings.simplefilter("once", UserWarning)
        warnings.showwarning = _show
        yield


def _show(message: Warning | str, *_: Any, **__: Any) -> None:
    warn([str(message)])
