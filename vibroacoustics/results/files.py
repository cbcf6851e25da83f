"""Files that appear whole or not at all, several of them together.

They are written to a hidden folder, synced, and moved to their names; until then, what was there
before stays as it is. A folder has one writer at a time.
"""

import os
import shutil
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Final

from ..base.errors import StorageError
from .interruption import cleared, uninterrupted
from .lock import locked

STAGING_NAME: Final = ".writing"
LOCK_NAME: Final = ".lock"


@contextmanager
def only_writer(folder: Path) -> Iterator[Path]:
    """Be the only writer of a folder, with an empty hidden folder in it to write to.

    A folder that was made for it goes again on failure.

    Raises
    ------
    StorageError
        The folder cannot be written.
    """
    made = [path for path in (folder, *folder.parents) if not path.exists()]
    with ExitStack() as stack:
        stack.enter_context(cleared(partial(_remove_empty, made)))
        with naming(folder):
            folder.mkdir(parents=True, exist_ok=True)
            stack.enter_context(locked(folder / LOCK_NAME, str(folder)))
        with staging(folder / STAGING_NAME) as staged:
            yield staged


def _remove_empty(folders: Iterable[Path]) -> None:
    with suppress(OSError):  # written to
        for path in folders:
            path.rmdir()


@contextmanager
def staging(staged: Path) -> Iterator[Path]:
    """An empty folder, which is gone in the end; its lock is held."""
    remove = partial(shutil.rmtree, staged, ignore_errors=True)
    remove()  # of a writer that was killed
    with cleared(remove):
        with naming(staged.parent):
            staged.mkdir()
        yield staged


def write(path: Path, content: bytes) -> None:
    """Write a file and carry it to the disk, into a folder that is made for it.

    Raises
    ------
    StorageError
        It cannot be written.
    """
    with naming(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        sync(path)


def files_in(folder: Path) -> list[str]:
    """Names of all files below a folder, `/` between the parts."""
    return sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file())


def replace_all(staged: Path, folder: Path, first: str = "") -> None:
    """Move all that was written to its names; no signal comes between.

    Parameters
    ----------
    staged : where it was written, each file synced
    folder : where it goes
    first : the file that goes first

    Raises
    ------
    StorageError
        A name is taken by a folder, which is seen before any file is replaced, or the disk fails.
    """
    names = sorted(files_in(staged), key=lambda name: name != first)
    for name in names:
        if (folder / name).is_dir():
            raise StorageError(f"{folder / name}: cannot be written: a folder has this name")
    for parent in {(folder / name).parent for name in names}:
        with naming(parent):
            parent.mkdir(exist_ok=True)
    with uninterrupted():
        for name in names:
            with naming(folder / name):
                os.replace(staged / name, folder / name)
        for parent in {(folder / name).parent for name in names}:
            with naming(parent):
                sync(parent)


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """What the system refuses as one line that names the file."""
    try:
        yield
    except OSError as error:
        name = Path(*(part for part in path.parts if part != STAGING_NAME))
        raise StorageError(f"{name}: cannot be written: {error.strerror or error}") from None


def sync(path: Path) -> None:
    """Carry a file, or the names in a folder, to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
