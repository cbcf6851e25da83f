"""Files whose last line is the hash of what stands before it.

So content and hash change in one step. HDF5 keeps its own length and does not read the line; what
rewrites the file in place loses or breaks it, and that is seen.
"""

import os
import re
from contextlib import AbstractContextManager
from pathlib import Path
from typing import BinaryIO, Final, NamedTuple

from ..base.errors import StorageError
from ..base.folder import Folder
from ..base.plain_bytes import file_sha256, sha256
from ..base.regular_file import opened

_LINE: Final = re.compile(rb"\nvibroacoustics sha256 ([0-9a-f]{64})\n")
MAXIMUM_RESULTS_BYTES: Final = 2 * 2**30
"""Largest size of a results file, and of what it holds once it is read."""
_LENGTH: Final = len(b"\nvibroacoustics sha256 \n") + 64


class Checked(NamedTuple):
    """Content of a file without its last line, and the hash of it."""

    content: bytes
    sha256: str


def append_hash(file: BinaryIO) -> str:
    """Hash of an open file's content, which becomes its last line."""
    digest = file_sha256(file)
    file.seek(0, os.SEEK_END)
    file.write(hash_line(digest))
    return digest


def hash_line(digest: str) -> bytes:
    """Last line of a file with this hash of its content."""
    return f"\nvibroacoustics sha256 {digest}\n".encode()


def read_checked(path: Path, folder: Folder | None = None) -> Checked:
    """Content of a file that fits its hash; below a folder no link to another is followed.


    Raises
    ------
    StorageError
        The file is missing, has no hash, or does not match it.
    """
    body, end = _read(path, folder)
    line = _LINE.fullmatch(end)
    if line is None:
        raise StorageError(f"{path}: has no hash: it is damaged or no result; run the study again")
    stored = line[1].decode()
    if sha256(body) != stored:
        raise StorageError(f"{path}: content does not match its hash; run the study again")
    return Checked(body, stored)


def stored_hash(path: Path, folder: Folder | None = None) -> str | None:
    """Hash that a file holds; None where it has none."""
    try:
        with _opened(path, folder, MAXIMUM_RESULTS_BYTES) as file:
            file.seek(-min(_LENGTH, os.fstat(file.fileno()).st_size), os.SEEK_END)
            line = _LINE.fullmatch(file.read())
    except (OSError, StorageError):
        return None
    return line[1].decode() if line else None


def _opened(
    path: Path, folder: Folder | None, maximum_bytes: int
) -> AbstractContextManager[BinaryIO]:
    if folder is None:
        return opened(path, maximum_bytes)
    return folder.opened(str(path.relative_to(folder.path)), maximum_bytes)


def _read(path: Path, folder: Folder | None) -> tuple[bytes, bytes]:
    """Content and what may be its last line, apart."""
    try:
        with _opened(path, folder, MAXIMUM_RESULTS_BYTES) as file:
            body = file.read(max(os.fstat(file.fileno()).st_size - _LENGTH, 0))
            return body, file.read()
    except FileNotFoundError:
        raise StorageError(f"{path}: no such file") from None
    except OSError as error:
        raise StorageError(f"{path}: cannot be read: {error.strerror}") from None
