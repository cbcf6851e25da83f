"""The folder of the cache: what is in it, how large it may get, and what the dead left in it."""

import os
import stat
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from fnmatch import fnmatch
from pathlib import Path
from typing import Final, NamedTuple

import platformdirs

from ..base.errors import StorageError
from ..base.folder import Folder, make_folder, opened_folder
from .files import naming, replace_all, staging, write
from .lock import is_held, locked, taken

DEFAULT_LIMIT_BYTES: Final = 2_000_000_000
LIMIT_NAME: Final = "limit_bytes"
_MAXIMUM_LIMIT_BYTES: Final = 100
_MAXIMUM_STUDY_BYTES: Final = 10_000
RUN: Final = "run-"
"""First part of the name of a folder that holds what an interrupted run has computed."""
_LEFTOVERS: Final = ("*.nc.lock", ".*.nc*", "*.nc.study", f"{RUN}*.lock")


class Entry(NamedTuple):
    """A cached result: file, size with those beside it, last use, s since 1970, title of its study.

    The title is empty where it is unknown. A folder of an interrupted run is an entry, too.
    """

    name: str
    size_bytes: int
    used_s: float
    study: str = ""


def folder() -> Path:
    """Folder of the cache of expensive results."""
    return Path(platformdirs.user_cache_dir("vibroacoustics"))


@contextmanager
def opened() -> Iterator[Folder]:
    """Open the folder of the cache, which no other user can write; it is made if missing."""
    path = folder()
    with ExitStack() as stack:
        with naming(path):
            make_folder(path, 0o700)
            cache_folder = stack.enter_context(opened_folder(path))
            _make_private(cache_folder)
        yield cache_folder


def _make_private(cache_folder: Folder) -> None:
    """Refuse a folder that others may have written to; take the rights of its group away."""
    status = os.fstat(cache_folder.descriptor)
    if status.st_uid != os.geteuid():
        raise StorageError(
            f"{cache_folder.path}: belongs to another user: set XDG_CACHE_HOME, or remove it"
        )
    if status.st_mode & stat.S_IWOTH:
        raise StorageError(f"{cache_folder.path}: is writable by all users: remove it")
    if status.st_mode & stat.S_IWGRP:
        os.fchmod(cache_folder.descriptor, 0o700)


def contents() -> tuple[list[Entry], int]:
    """Return the entries of the cache, and its size limit, bytes; the folder is not made."""
    if not os.path.exists(folder()):
        return [], DEFAULT_LIMIT_BYTES
    with opened() as cache_folder:
        return entries(cache_folder), limit_bytes(cache_folder)


def lock_of(name: str) -> str:
    """Lock of an entry."""
    return f"{name}.lock"


def staging_of(name: str) -> str:
    """Hidden folder to write an entry to; who holds its lock owns it."""
    return f".{name}.writing"


def mark_used(cache_folder: Folder, name: str) -> None:
    """Note that an entry is used now, where that can be noted and changes no other file."""
    status = cache_folder.status(name)
    if status is not None and status.st_nlink == 1:
        with suppress(OSError):
            os.utime(name, dir_fd=cache_folder.descriptor, follow_symlinks=False)


def entries(cache_folder: Folder) -> list[Entry]:
    """Return the entries of the cache, the least recently used first."""
    listed = []
    for name in os.listdir(cache_folder.descriptor):
        status = cache_folder.status(name)  # none where another process takes it away
        if name.endswith(".nc") and status is not None and stat.S_ISREG(status.st_mode):
            size = sum(_size(cache_folder, each) for each in _files_of(name))
            listed.append(Entry(name, size, status.st_mtime, _study(cache_folder, name)))
        if name.startswith(RUN) and status is not None and stat.S_ISDIR(status.st_mode):
            size = _size(cache_folder, name)
            listed.append(Entry(name, size, status.st_mtime, "interrupted run"))
    return sorted(listed, key=lambda entry: entry.used_s)


def size_bytes(cache_folder: Folder) -> int:
    """Size of all that is in the cache, unfinished files too, but locks and its limit, bytes."""
    names = os.listdir(cache_folder.descriptor)
    kept = (name for name in names if name != LIMIT_NAME and not name.endswith(".lock"))
    return sum(_size(cache_folder, name) for name in kept)


def _size(cache_folder: Folder, name: str) -> int:
    """Size of a file, or of those in a folder, bytes; 0 where another process takes it away."""
    status = cache_folder.status(name)
    if status is None or not stat.S_ISDIR(status.st_mode):
        return 0 if status is None else status.st_size
    with suppress(OSError, StorageError), cache_folder.below(name) as folder:
        return folder.size_bytes()
    return 0


def _files_of(name: str) -> tuple[str, ...]:
    """Files of an entry."""
    return name, study_of(name)


def study_of(name: str) -> str:
    """File beside an entry that names its study."""
    return f"{name}.study"


def _study(cached: Folder, name: str) -> str:
    with suppress(OSError, StorageError):
        content = cached.read_bytes(study_of(name), _MAXIMUM_STUDY_BYTES)
        return " ".join(content.decode(errors="replace").split())
    return ""


def limit_bytes(cache_folder: Folder) -> int:
    """Return the size limit of the cache: as set, else 2 GB."""
    try:
        return max(int(cache_folder.read_bytes(LIMIT_NAME, _MAXIMUM_LIMIT_BYTES)), 0)
    except (OSError, StorageError, ValueError):
        return DEFAULT_LIMIT_BYTES


def set_limit(cache_folder: Folder, limit: int) -> None:
    """Set how large the cache may get, bytes, from now on."""
    with (
        locked(cache_folder, lock_of(LIMIT_NAME), f"cache {LIMIT_NAME}"),
        staging(cache_folder, staging_of(LIMIT_NAME)) as staged,
    ):
        write(staged, LIMIT_NAME, f"{limit}\n".encode())
        replace_all(staged)


def tidy(cache_folder: Folder) -> list[Entry]:
    """Remove what the dead left, and the least recently used entries above the limit.

    Returns
    -------
    entries that were removed
    """
    _remove_leftovers(cache_folder)
    return _shrink(cache_folder, limit_bytes(cache_folder))


def make_room(cache_folder: Folder, size: int, written: int = 0) -> bool:
    """Remove what `tidy` removes, so that a further entry keeps the limit; whether it does.

    Parameters
    ----------
    cache_folder : folder of the cache
    size : size of the entry, bytes
    written : bytes of the entry that are in the cache already, hidden
    """
    limit = limit_bytes(cache_folder)
    fits = size <= limit
    others = limit + written - (size if fits else 0)
    _remove_leftovers(cache_folder)
    _shrink(cache_folder, others)
    return fits and size_bytes(cache_folder) <= others


def clear(cache_folder: Folder) -> list[Entry]:
    """Remove every entry and what the dead left; returns the entries."""
    _remove_leftovers(cache_folder)
    return _shrink(cache_folder, 0)


def _shrink(cache_folder: Folder, limit: int) -> list[Entry]:
    size = size_bytes(cache_folder)
    removed = []
    for entry in entries(cache_folder):
        if size <= limit:
            break
        with ExitStack() as stack:
            lock = lock_of(entry.name)
            if entry.name.startswith(RUN) and not stack.enter_context(taken(cache_folder, lock)):
                continue  # the run goes on
            for name in _files_of(entry.name):
                _remove_any(cache_folder, name)
        size -= entry.size_bytes
        removed.append(entry)
    return removed


def _remove_leftovers(cache_folder: Folder) -> None:
    """Locks, hidden files and hashes without an entry, of processes that are gone."""
    for name in os.listdir(cache_folder.descriptor):
        if not any(fnmatch(name, pattern) for pattern in _LEFTOVERS):
            continue
        entry = name.removeprefix(".").partition(".nc")[0] + ".nc"
        if name.startswith(RUN):
            entry = name.removesuffix(".lock")
        lock = lock_of(entry)
        if name == lock and is_held(cache_folder, lock):
            continue
        if name == study_of(entry) and cache_folder.holds_file(entry):
            continue
        with taken(cache_folder, lock) as held:
            if held and name != lock:
                _remove_any(cache_folder, name)


def _remove_any(cache_folder: Folder, name: str) -> None:
    cache_folder.remove_tree(name)
    with suppress(IsADirectoryError):  # not all in it could be removed
        cache_folder.remove(name)


def warn_of_limit(cache_folder: Folder) -> None:
    """Warn that a result is not kept, in one text for all; not where the limit is 0."""
    limit = limit_bytes(cache_folder)
    if limit:
        warnings.warn(
            f"cache {folder()}: a result does not fit its limit of {limit / 1e6:g} MB and is not "
            "kept; raise it by: vibroacoustics cache --limit GB",
            stacklevel=4,
        )


def warn(error: StorageError) -> None:
    """Warn that a run goes on without the cache, in one text for all entries not written."""
    _, failure, reason = str(error).rpartition("cannot be written: ")
    words = f"{folder()}: {failure}{reason}" if failure else str(error)
    warnings.warn(f"cache {words}; the run goes on without it", stacklevel=4)
