"""SIGINT and SIGTERM end a command with one line and exit code 130 or 143, nothing left behind.

Imports nothing heavy, so that the handlers stand before the imports that take time.
"""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final

from ..base.posix import ENDING
from ..results.interruption import clear_up
from .outcome import write_errors

_AGAIN_S: Final = 2.0
"""A library may swallow the exception, or wait for its threads: then it is raised once more."""


class Interrupted(BaseException):
    """A signal asks this process to end. No `except Exception` holds it up."""


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """End the process where SIGINT or SIGTERM comes, after everything has been cleared up."""
    came: list[int] = []

    def interrupt(number: int, _: FrameType | None) -> None:
        if number != ENDING[-1]:
            came.append(number)
        signal.setitimer(signal.ITIMER_REAL, _AGAIN_S)
        sys.unraisablehook = lambda _: None  # raised where Python cannot let it through
        raise Interrupted

    for number in ENDING:
        signal.signal(number, interrupt)
    try:
        yield
        _ignore()
    except BaseException:
        _ignore()
        if not came:
            raise
        clear_up()
        line = f"ended by {signal.Signals(came[0]).name}"
        print(line, file=sys.stderr, flush=True)
        write_errors(sys.argv[1:], [line])
        os._exit(128 + came[0])  # worker threads are not waited for


def _ignore() -> None:
    """Ignore a signal that comes too late."""
    for number in ENDING:
        signal.signal(number, signal.SIG_IGN)
