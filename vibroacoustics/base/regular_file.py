"""Files of the user, read only where they are regular and not too large.

A pipe waits for ever and a device has no end; neither holds a study, a table or results.
"""

import errno
import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0))


@contextmanager
def opened(
    path: Path, maximum_bytes: int, opener: Callable[[str, int], int] = _without_waiting
) -> Iterator[BinaryIO]:
    """Open a regular file of a limited size for reading.


    Raises
    ------
    OSError
        It is missing, unreadable, a folder, pipe or device, or larger; `strerror` says which.
    ValueError
        The name cannot be that of a file.
    """
    with open(path, "rb", opener=opener) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "no regular file", str(path))
        if status.st_size > maximum_bytes:
            raise OSError(errno.EFBIG, f"larger than {maximum_bytes} bytes", str(path))
        yield file


def read_bytes(path: Path, maximum_bytes: int) -> bytes:
    """Content of a regular file of a limited size; errors as of `opened`."""
    with opened(path, maximum_bytes) as file:
        content = file.read(maximum_bytes + 1)  # it may have grown
    if len(content) > maximum_bytes:
        raise OSError(errno.EFBIG, f"larger than {maximum_bytes} bytes", str(path))
    return content


def read_text(path: Path, maximum_bytes: int) -> str:
    """Text of a regular file in UTF-8, with or without a byte-order mark; errors as of `opened`."""
    return read_bytes(path, maximum_bytes).decode("utf-8-sig")
