"""Locks between processes: a file with who holds it, which goes when it is released.

The operating system releases the lock of a process that is killed; its file is then taken over by
the next who wants it.
"""

import errno
import json
import os
import socket
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from functools import partial
from typing import Final

from ..base.errors import StorageError
from ..base.folder import Folder
from ..base.posix import fcntl
from .interruption import cleared_in, uninterrupted

PATIENCE_S: Final = 0.3
"""A wait that is shorter is not worth a line."""
_PAUSE_S: Final = 0.02
_MAXIMUM_BYTES: Final = 4096
_NO_LOCKS: Final = (errno.ENOLCK, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS)
"""Errors of file systems without locks. There, each file still appears whole or not at all."""


@contextmanager
def locked(folder: Folder, name: str, what: str) -> Iterator[None]:
    """Hold a lock; another's is waited for, and named in one warning."""
    begin, announced = time.monotonic(), False
    while True:
        with taken(folder, name) as held:
            if held:
                yield
                return
        if not announced and time.monotonic() - begin > PATIENCE_S:
            warnings.warn(f"{what}: waiting for {holder(folder, name)}", stacklevel=3)
            announced = True
        time.sleep(_PAUSE_S)


@contextmanager
def taken(folder: Folder, name: str) -> Iterator[bool]:
    """Hold a lock where no other holds it; whether it is held."""
    descriptors: list[int] = []
    with cleared_in(folder, partial(_release, name, descriptors)):
        _acquire(folder, name, descriptors)
        yield bool(descriptors)


def _acquire(folder: Folder, name: str, descriptors: list[int]) -> None:
    """Add the descriptor of the lock, but while another holds it."""
    with uninterrupted():
        while True:
            descriptor = folder.open(name, os.O_RDWR | os.O_CREAT)
            if not _take(descriptor):
                os.close(descriptor)
                return
            if _is_only(folder, name, descriptor):
                break
            os.close(descriptor)
        descriptors.append(descriptor)
        with suppress(OSError):  # a full disk: who waits then learns less
            os.truncate(descriptor, 0)
            os.write(descriptor, json.dumps(_this_process()).encode())


def _release(name: str, descriptors: list[int], folder: Folder) -> None:
    """Take the file away, then give the lock back."""
    while descriptors:
        folder.remove(name)
        os.close(descriptors.pop())


def is_held(folder: Folder, name: str) -> bool:
    """Whether some process holds the lock now; never makes a file."""
    try:
        descriptor = folder.open(name, os.O_RDONLY)
    except (OSError, StorageError):
        return False
    try:
        return not _take(descriptor)
    finally:
        os.close(descriptor)


def holder(folder: Folder, name: str) -> str:
    """Name the holder of the lock, in words."""
    try:
        by = json.loads(folder.read_bytes(name, _MAXIMUM_BYTES))
        return f"process {by['process']} on {by['host']}, since {by['since']}"
    except (OSError, StorageError, ValueError, KeyError, TypeError):
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


def _is_only(folder: Folder, name: str, descriptor: int) -> bool:
    """Whether an open file is that of the name, and of no other; other links to it are cut off."""
    status = folder.status(name)
    if status is None or not os.path.samestat(status, os.fstat(descriptor)):
        return False  # who held it has taken the file away meanwhile
    if status.st_nlink > 1:
        folder.remove(name)
    return status.st_nlink == 1


def _this_process() -> dict[str, object]:
    since = datetime.now().astimezone().isoformat(" ", "seconds")
    return {"process": os.getpid(), "host": socket.gethostname(), "since": since}
