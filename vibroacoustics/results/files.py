"""Files that appear whole or not at all, several of them together.

They are written to a hidden folder, synced, and moved to their names; until then, what was there
before stays as it is. A folder has one writer at a time. Nothing outside the folder is changed.
"""

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Final

from ..base.errors import StorageError
from ..base.folder import Content, Folder, make_folder, missing_folders, opened_folder
from .interruption import cleared, cleared_in, uninterrupted
from .lock import locked

STAGING_NAME: Final = ".writing"
LOCK_NAME: Final = ".lock"


@dataclass(frozen=True)
class Staging(Folder):
    """A hidden folder to write to.

    Attributes
    ----------
    target : where `replace_all` moves the files
    """

    target: Folder


@contextmanager
def only_writer(path: Path) -> Iterator[Staging]:
    """Be the only writer of a folder, with an empty hidden folder in it to write to.

    A folder that was made for it goes again on failure.
    """
    with ExitStack() as stack:
        stack.enter_context(cleared(partial(_remove_empty, missing_folders(path))))
        with naming(path):
            make_folder(path)
            folder = stack.enter_context(opened_folder(path))
            stack.enter_context(locked(folder, LOCK_NAME, str(path)))
        with staging(folder, STAGING_NAME) as staged:
            yield staged


def _remove_empty(folders: Iterable[Path]) -> None:
    with suppress(OSError):  # written to
        for path in folders:
            path.rmdir()


@contextmanager
def staging(target: Folder, name: str) -> Iterator[Staging]:
    """An empty folder in another, which is gone in the end; its lock is held.

    Nobody else can write in it, so that a library may write there by name.

    Raises
    ------
    StorageError
        It cannot be made, or its name is taken.
    """
    target.check_folder(name)
    target.remove_tree(name)  # of a writer that was killed
    if target.status(name) is not None:
        raise StorageError(f"{target.path / name}: is of another user's run: remove it")
    with cleared_in(target, partial(_remove_tree, name)), ExitStack() as stack:
        with naming(target.path):
            os.mkdir(name, 0o700, dir_fd=target.descriptor)
            folder = stack.enter_context(target.below(name))
        yield Staging(folder.path, folder.descriptor, target)


def _remove_tree(name: str, folder: Folder) -> None:
    folder.remove_tree(name)


def write(staged: Folder, name: str, content: Content) -> None:
    """Write a file and carry it to the disk; folders on the way to it are made."""
    with naming(staged.path / name):
        staged.write(name, content)


def write_together(folder: Path, files: Mapping[str, Content]) -> None:
    """Write files into a folder, together or not at all."""
    with only_writer(folder) as staged:
        for name, content in files.items():
            write(staged, name, content)
        replace_all(staged)


def replace_all(staged: Staging, first: str = "") -> None:
    """Move all that was written to its names, one before all others; no signal comes between."""
    names = sorted(map(PurePosixPath, staged.files()), key=lambda name: str(name) != first)
    for name in names:
        staged.target.check_file(str(name))
    with ExitStack() as stack:
        folders = {}
        for parent in {name.parent for name in names}:
            with naming(staged.target.path / parent):
                source = stack.enter_context(staged.below(parent))
                target = stack.enter_context(staged.target.below(parent, make=True))
                folders[parent] = source, target
        with uninterrupted():
            for name in names:
                source, target = folders[name.parent]
                with naming(target.path / name.name):
                    ends = {"src_dir_fd": source.descriptor, "dst_dir_fd": target.descriptor}
                    os.replace(name.name, name.name, **ends)
            for _, target in folders.values():
                with naming(target.path):
                    target.sync()


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Report what the system refuses as one line that names the file."""
    try:
        yield
    except OSError as error:
        name = Path(*(part for part in path.parts if part != STAGING_NAME))
        raise StorageError(f"{name}: cannot be written: {error.strerror or error}") from None
