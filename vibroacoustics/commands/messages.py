"""Warnings as single lines on stderr, at the moment when they come up; a log besides."""

import sys
import time
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Final, TextIO

from ..base.errors import StorageError, VibroacousticsError, shortened
from ..base.folder import Folder, opened_folder
from ..base.visible import visible

_MAXIMUM_BYTES: Final = 1_000_000_000
_LONGEST_LINE: Final = 600
"""Length of a message: a path alone may have 4096 characters."""

_LOG: Final[ContextVar[TextIO | None]] = ContextVar("_LOG", default=None)
_WARNED: Final[ContextVar[list[str] | None]] = ContextVar("_WARNED", default=None)
_QUIET: Final = ContextVar("_QUIET", default=False)


@contextmanager
def logged(path: Path | None) -> Iterator[None]:
    """Append what is noted to a file, each line with its time; nothing without one.

    Raises
    ------
    StorageError
        The file cannot be written.
    """
    if path is None:
        yield
        return
    try:
        with opened_folder(path.parent) as folder:
            file = _appending(folder, path.name)
    except OSError as error:
        raise StorageError(f"{path}: cannot be written: {error.strerror}") from None
    with file:
        token = _LOG.set(file)
        try:
            yield
        except VibroacousticsError as error:
            for line in lines_of(error):
                note(line)
            raise
        finally:
            _LOG.reset(token)


def _appending(folder: Folder, name: str) -> TextIO:
    """Open a log; one with several hard links is replaced by a copy."""
    status = folder.status(name)
    if status is not None and status.st_nlink > 1:
        folder.write(name, folder.read_bytes(name, _MAXIMUM_BYTES))
    return open(name, "a", encoding="utf-8", buffering=1, opener=folder.open)


def note(line: str) -> None:
    """Write a line to the log, where there is one."""
    file = _LOG.get()
    if file is not None:
        file.write(f"{time.strftime('%Y-%m-%d %H:%M:%S')} {line}\n")


def lines_of(error: VibroacousticsError) -> list[str]:
    """An error as it is printed."""
    return [f"error: {_in_one_line(line)}" for line in map(str, error.args)]


def _in_one_line(line: str) -> str:
    return visible(shortened(" ".join(line.split()), _LONGEST_LINE))


def warn(lines: Iterable[str]) -> None:
    """Print each as a warning."""
    for line in lines:
        words = _in_one_line(line)
        collecting = _WARNED.get()
        if collecting is not None:
            collecting.append(words)
        note(f"warning: {words}")
        print(f"warning: {words}", file=sys.stderr, flush=True)


def warned() -> list[str]:
    """Warnings that this command has printed."""
    return list(_WARNED.get() or ())


def inform(line: str) -> None:
    """Write a line to the log and, unless the command is quiet, on stderr."""
    note(line)
    if not _QUIET.get():
        print(line, file=sys.stderr, flush=True)


@contextmanager
def hushed(quiet: bool) -> Iterator[None]:
    """Let a command that is quiet print nothing else than warnings and errors on stderr."""
    token = _QUIET.set(quiet)
    try:
        yield
    finally:
        _QUIET.reset(token)


@contextmanager
def warnings_in_one_line() -> Iterator[None]:
    """Print and collect Python's warnings as single lines; one that says the same comes once."""
    said: set[str] = set()
    _WARNED.set([])

    def show(message: Warning | str, *_: Any, **__: Any) -> None:
        if str(message) not in said:
            said.add(str(message))
            warn([str(message)])

    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)  # "once" is once for each module
        warnings.showwarning = show
        yield
