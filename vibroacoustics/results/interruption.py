"""Short steps that a signal must not cut in two, and what must be cleared up after one."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Final

from ..base.folder import Folder
from ..base.posix import ENDING


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold signals back, and let them act afterwards; only the main thread ever gets them."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    present = {number: signal.getsignal(number) for number in ENDING}
    # None: a handler of a host program in C, which could not be put back
    handlers = {number: handler for number, handler in present.items() if handler is not None}
    for number in handlers:
        signal.signal(number, lambda caught, _: came.append(caught))
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for caught in dict.fromkeys(came):
            signal.raise_signal(caught)


_CLEARING: Final[dict[object, Callable[[], object]]] = {}


@contextmanager
def cleared(clear: Callable[[], object]) -> Iterator[None]:
    """Call `clear` in the end, however it comes.

    A signal that comes just before it is called cuts it off; `clear_up` then does it.
    """
    key = object()
    _CLEARING[key] = clear
    try:
        yield
    finally:
        with uninterrupted():
            del _CLEARING[key]
            clear()


@contextmanager
def cleared_in(folder: Folder, clear: Callable[[Folder], object]) -> Iterator[None]:
    """Call `clear` of a folder in the end; `clear_up` may do so when the folder is closed."""
    duplicate = folder.duplicate()

    def clear_and_close() -> None:
        try:
            clear(duplicate)
        finally:
            os.close(duplicate.descriptor)

    with cleared(clear_and_close):
        yield


def clear_up() -> None:
    """Do what a signal cut off, before the process ends."""
    for clear in reversed(list(_CLEARING.values())):
        with suppress(Exception):
            clear()
