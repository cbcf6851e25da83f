"""Locks between processes: a file with who holds it, which goes when it is released.

The operating system releases the lock of a process that is killed; its file is then taken over by
the next who wants it.
"""

import errno
import fcntl
import json
import os
import socket
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Final

from .interruption import cleared, uninterrupted

PATIENCE_S: Final = 0.3
"""A wait that is shorter is not worth a line."""
_PAUSE_S: Final = 0.02
_NO_LOCKS: Final = (errno.ENOLCK, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS)
"""Of file systems without locks. There, each file still appears whole or not at all."""


@contextmanager
def locked(path: Path, what: str) -> Iterator[None]:
    """Hold a lock; another's is waited for, and named in one warning.

    Parameters
    ----------
    path : file of the lock, in a folder that exists
    what : what is locked, in words for who waits

    Raises
    ------
    OSError
        The file cannot be made.
    """
    begin, announced = time.monotonic(), False
    while True:
        with taken(path) as held:
            if held:
                yield
                return
        if not announced and time.monotonic() - begin > PATIENCE_S:
            warnings.warn(f"{what}: waiting for {holder(path)}", stacklevel=3)
            announced = True
        time.sleep(_PAUSE_S)


@contextmanager
def taken(path: Path) -> Iterator[bool]:
    """Hold a lock where no other holds it; whether it is held."""
    descriptors: list[int] = []
    with cleared(partial(_release, path, descriptors)):
        _acquire(path, descriptors)
        yield bool(descriptors)


def _acquire(path: Path, descriptors: list[int]) -> None:
    """Add the descriptor of the lock, but while another holds it."""
    with uninterrupted():
        while True:
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
            if not _take(descriptor):
                os.close(descriptor)
                return
            if _is_at(path, descriptor):
                break
            os.close(descriptor)  # who held it has taken the file away meanwhile
        descriptors.append(descriptor)
        with suppress(OSError):  # a full disk: who waits then learns less
            os.truncate(descriptor, 0)
            os.write(descriptor, json.dumps(_this_process()).encode())


def _release(path: Path, descriptors: list[int]) -> None:
    """Take the file away, then give the lock back."""
    while descriptors:
        path.unlink(missing_ok=True)
        os.close(descriptors.pop())


def is_held(path: Path) -> bool:
    """Whether some process holds the lock now; never makes a file."""
    try:
        descriptor = os.open(path, os.O_RDONLY)
    except OSError:
        return False
    try:
        return not _take(descriptor)
    finally:
        os.close(descriptor)


def holder(path: Path) -> str:
    """Who holds the lock, in words."""
    try:
        by = json.loads(path.read_bytes())
        return f"process {by['process']} on {by['host']}, since {by['since']}"
    except (OSError, ValueError, KeyError, TypeError):
        return "another process"


def _take(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in _NO_LOCKS:
            raise
    return True


def _is_at(path: Path, descriptor: int) -> bool:
    try:
        return os.path.samestat(path.stat(), os.fstat(descriptor))
    except FileNotFoundError:
        return False


def _this_process() -> dict[str, object]:
    since = datetime.now().astimezone().isoformat(" ", "seconds")
    return {"process": os.getpid(), "host": socket.gethostname(), "since": since}
