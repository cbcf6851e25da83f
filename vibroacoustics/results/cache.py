"""The folder of the cache: what is in it, how large it may get, and what the dead left in it."""

import os
import shutil
from contextlib import suppress
from pathlib import Path
from typing import Final, NamedTuple

import platformdirs

from .hashed import hash_path
from .lock import is_held, taken

DEFAULT_LIMIT_BYTES: Final = 2_000_000_000
LIMIT_NAME: Final = "limit_bytes"


class Entry(NamedTuple):
    """A cached result: file, size, and when it was last used, in seconds since 1970."""

    path: Path
    size_bytes: int
    used_s: float


def folder() -> Path:
    """Folder of the cache of expensive results."""
    return Path(platformdirs.user_cache_dir("vibroacoustics"))


def lock_of(path: Path) -> Path:
    """Lock of an entry."""
    return path.with_name(f"{path.name}.lock")


def staging_of(path: Path) -> Path:
    """Hidden folder to write an entry to; who holds its lock owns it."""
    return path.with_name(f".{path.name}.writing")


def mark_used(path: Path) -> None:
    """Note that an entry is used now, where that can be noted."""
    with suppress(OSError):
        os.utime(path)


def entries(at: Path) -> list[Entry]:
    """What is cached, the least recently used first."""
    listed = []
    for path in at.glob("*.nc"):
        with suppress(FileNotFoundError):  # another process takes it away
            status = path.stat()
            listed.append(Entry(path, status.st_size, status.st_mtime))
    return sorted(listed, key=lambda entry: entry.used_s)


def limit_bytes(at: Path) -> int:
    """How large the cache may get: as set, else 2 GB."""
    try:
        return max(int((at / LIMIT_NAME).read_text()), 0)
    except (OSError, ValueError):
        return DEFAULT_LIMIT_BYTES


def set_limit(at: Path, limit: int) -> None:
    """Set how large the cache may get, bytes, from now on."""
    at.mkdir(parents=True, exist_ok=True)
    (at / LIMIT_NAME).write_text(f"{limit}\n")


def tidy(at: Path) -> list[Entry]:
    """Remove what the dead left, and the least recently used entries above the limit.

    Returns
    -------
    entries that were removed
    """
    _remove_leftovers(at)
    return _shrink(at, limit_bytes(at))


def clear(at: Path) -> list[Entry]:
    """Remove every entry and what the dead left; returns the entries."""
    _remove_leftovers(at)
    return _shrink(at, 0)


def _shrink(at: Path, limit: int) -> list[Entry]:
    present = entries(at)
    size = sum(entry.size_bytes for entry in present)
    removed = []
    for entry in present:
        if size <= limit:
            break
        entry.path.unlink(missing_ok=True)
        hash_path(entry.path).unlink(missing_ok=True)
        size -= entry.size_bytes
        removed.append(entry)
    return removed


def _remove_leftovers(at: Path) -> None:
    """Locks, hidden files and hashes without an entry, of processes that are gone."""
    for path in [*at.glob("*.nc.lock"), *at.glob(".*.nc*"), *at.glob("*.nc.sha256")]:
        entry = path.with_name(path.name.removeprefix(".").partition(".nc")[0] + ".nc")
        lock = lock_of(entry)
        if path == lock and is_held(lock):
            continue
        if path == hash_path(entry) and entry.exists():
            continue
        with taken(lock) as held:
            if held and path.is_dir():
                shutil.rmtree(path, ignore_errors=True)
            elif held and path != lock:
                path.unlink(missing_ok=True)
