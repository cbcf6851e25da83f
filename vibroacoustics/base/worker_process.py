"""A worker process and both ends of the pipe that leads to it.

Every worker is started afresh (spawn), or is a copy of this process (fork) that knows a function
of any kind. It shares one unnamed pair of sockets with this process. Nothing listens: there is no
port, file or name that another process could open. A worker ends with this process, however that
ends.
"""

import multiprocessing
import os
import pickle
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import connection
from typing import Any, Final, Generic, TypeAlias, TypeVar

from .errors import SolverError
from .process_start import start_worker

Item = TypeVar("Item")
Result = TypeVar("Result")

_SPAWN: Final = multiprocessing.get_context("spawn")
_FORK: Final = multiprocessing.get_context("fork") if sys.platform == "linux" else None
_Connection: TypeAlias = "connection.Connection[Any, Any]"
READY, BEGUN, DONE, FAILED = range(4)
"""Kinds of messages of a worker."""
_END_S: Final = 5.0
"""A worker without an item may take this long to end."""


@dataclass(eq=False)
class Task(Generic[Item]):
    """An item in work, and how many workers ended at it."""

    index: int
    item: Item
    deaths: int = 0


class WorkerProcess:
    """A process, and this end of the pipe that leads to it."""

    def __init__(self, inherited: Callable[[Any], Any] | None, ends: Sequence[_Connection]) -> None:
        context: Any = _SPAWN if inherited is None else _FORK
        try:
            self.connection, far_end = context.Pipe()
            # A copy has this process's ends too, and would never see them closed.
            copied = () if inherited is None else (*ends, self.connection)
            self._process = context.Process(
                target=_serve, args=(far_end, inherited, copied), daemon=True
            )
            with far_end:  # closed here: else its end would go unnoticed
                start_worker(self._process, is_copy=inherited is not None)
        except OSError as error:
            raise SolverError(f"a worker process cannot start: {error.strerror}") from None
        self.ready = self.begun = False
        self.task: Task[Any] | None = None
        self.reason = ""

    def take(self, function: Callable[[Item], Result] | None, task: Task[Item]) -> None:
        """Send a task; None is the inherited function."""
        content = pickle.dumps((function, task.item))
        self.task, self.begun = task, False
        with suppress(OSError):  # it is dead, which `receive` reports
            self.connection.send_bytes(content)

    def receive(self) -> tuple[int, Any]:
        """Receive a message and note what it says about the worker."""
        kind, content = self.connection.recv()
        self.ready, self.begun = True, kind == BEGUN
        if kind in (DONE, FAILED):
            self.task = None
        return kind, content

    def close(self) -> None:
        """Kill the process if it is at work; let it end otherwise."""
        if self.task or not self.ready:
            self._process.kill()
        self.connection.close()

    def join(self) -> None:
        """Wait for the end of the process, which `close` began."""
        self._process.join(_END_S)
        self._process.kill()
        self._process.join()
        code = self._process.exitcode or 0
        names = {number.value: number.name for number in signal.Signals}
        kind = "signal" if code < 0 else "exit code"
        self.reason = names.get(-code, f"{kind} {abs(code)}")
        self._process.close()


def can_fork() -> bool:
    """Return whether this process can be copied: on Linux, without a thread beside this one.

    A copy has the calling thread alone: a lock that another one holds would stay closed for ever.
    """
    return _FORK is not None and threading.active_count() == 1


def _serve(
    pipe: _Connection, inherited: Callable[[Any], Any] | None, copied: Sequence[_Connection]
) -> None:
    """Answer items in a worker until the other end of the pipe is closed."""
    for end in copied:
        end.close()
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):
        pipe.send((READY, None))
        while True:
            content = pipe.recv_bytes()
            pipe.send((BEGUN, None))
            pipe.send_bytes(_answer(content, inherited))


def _end_with_parent() -> None:
    """End this worker when its parent has ended, in the middle of an item too."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)


def _answer(content: bytes, inherited: Any) -> bytes:
    """Apply the function to the item of a message; gives the result or the error as a message."""
    try:
        function, item = pickle.loads(content)  # noqa: S301 - of the process that started this one
        return pickle.dumps((DONE, (function or inherited)(item)))
    except BaseException as error:
        error.add_note(f"In a worker process:\n{traceback.format_exc()}")
        return pickle.dumps((FAILED, _portable(error)))


def _portable(error: BaseException) -> BaseException:
    """Give the error, or its text where it cannot be pickled."""
    try:
        pickle.loads(pickle.dumps(error))  # noqa: S301 - made one line before
    except Exception:
        return SolverError(f"{type(error).__name__}: {error}")
    return error
