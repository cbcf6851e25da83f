"""Folders by descriptor: what is opened, written or removed below one never leads out of it.

Names are opened relative to the descriptor. Symbolic links below the folder are not followed, and
only regular files are opened: a link changes nothing elsewhere, and no pipe or device is waited
for. The folder itself may be reached through links, as its user names it.
"""

import os
import shutil
import stat
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import BinaryIO, Final, TypeAlias

from .errors import StorageError
from .regular_file import opened

_KINDS: Final = {
    stat.S_IFLNK: "a symbolic link",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFDIR: "a folder",
    stat.S_IFREG: "a file",
}
Content: TypeAlias = bytes | Iterable[bytes]
"""Content of a file, or parts of it in their order."""
_FOLDER: Final = os.O_RDONLY | os.O_DIRECTORY | os.O_NONBLOCK


@dataclass(frozen=True)
class Folder:
    """A folder that is open; made by `opened_folder`.

    Attributes
    ----------
    path : its name, for messages
    descriptor : file descriptor of the folder
    """

    path: Path
    descriptor: int

    def open(self, name: str, flags: int) -> int:
        """Descriptor of a regular file in this folder; an `opener` for Python's `open`.

        Raises
        ------
        StorageError
            The name is that of a link, folder, pipe, socket or device.
        OSError
            It cannot be opened.
        """
        self._check(name, stat.S_ISREG)
        flags |= os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY
        descriptor = os.open(name, flags, 0o666, dir_fd=self.descriptor)
        mode = os.fstat(descriptor).st_mode
        if not stat.S_ISREG(mode):  # it took the name meanwhile
            os.close(descriptor)
            raise self._refusal(name, mode, "regular file")
        return descriptor

    @contextmanager
    def opened(self, name: str, maximum_bytes: int) -> Iterator[BinaryIO]:
        """Open a file of a limited size, also in a folder below, for reading; errors as `open`."""
        with (
            self._holding(name) as (folder, last),
            opened(Path(last), maximum_bytes, folder.open) as file,
        ):
            yield file

    def read_bytes(self, name: str, maximum_bytes: int) -> bytes:
        """Content of a file of a limited size; errors as of `open`."""
        with self.opened(name, maximum_bytes) as file:
            return file.read(maximum_bytes)

    def write(self, name: str, content: Content) -> None:
        """Write a new file in the place of any other, and carry it to the disk.

        Folders on the way to it are made. Other hard links of an older file keep its content.

        Parameters
        ----------
        name : name of the file
        content : all of it, or parts that are written one after another
        """
        with self._holding(name, make=True) as (folder, last):
            folder.remove(last)
            with open(last, "xb", opener=folder.open) as file:
                file.writelines([content] if isinstance(content, bytes) else content)
                file.flush()
                os.fsync(file.fileno())

    def remove(self, name: str) -> None:
        """Remove a file, or a link itself; nothing where there is none."""
        with suppress(FileNotFoundError), self._holding(name) as (folder, last):
            os.unlink(last, dir_fd=folder.descriptor)

    def remove_tree(self, name: str) -> None:
        """Remove a folder in this one with all that is in it, as far as that can be."""
        status = self.status(name)
        if status is not None and stat.S_ISDIR(status.st_mode):
            shutil.rmtree(name, ignore_errors=True, dir_fd=self.descriptor)

    def status(self, name: str) -> os.stat_result | None:
        """Status of a name, of a link itself; None where there is none below this folder."""
        try:
            with self._holding(name) as (folder, last):
                return os.stat(last, dir_fd=folder.descriptor, follow_symlinks=False)
        except (FileNotFoundError, StorageError):
            return None

    def holds_file(self, name: str) -> bool:
        """Whether a name is that of a regular file."""
        status = self.status(name)
        return status is not None and stat.S_ISREG(status.st_mode)

    def check_file(self, name: str) -> None:
        """Refuse a name that is taken by anything but a regular file."""
        path = _inner(name)
        for folder in [*reversed(path.parents)][1:]:
            self.check_folder(str(folder))
        self._check(name, stat.S_ISREG)

    def check_folder(self, name: str) -> None:
        """Refuse a name that is taken by anything but a folder."""
        self._check(name, stat.S_ISDIR)

    def files(self) -> list[str]:
        """Names of all files below, `/` between the parts."""
        walk = os.fwalk(".", dir_fd=self.descriptor)
        return sorted(
            PurePosixPath(root, name).as_posix() for root, _, names, _ in walk for name in names
        )

    def size_bytes(self) -> int:
        """Size of all files below, bytes; 0 of those that go meanwhile."""
        return sum(status.st_size for name in self.files() if (status := self.status(name)))

    def sync(self) -> None:
        """Carry the names in this folder to the disk."""
        os.fsync(self.descriptor)

    def library_path(self, name: str) -> Path:
        """Path of a file for libraries that open by name.

        It begins at the descriptor where the system can do that.
        """
        link = Path(f"/proc/self/fd/{self.descriptor}")
        try:
            by_descriptor = os.path.samestat(link.stat(), os.fstat(self.descriptor))
        except OSError:
            by_descriptor = False
        return (link if by_descriptor else self.path) / name

    def duplicate(self) -> "Folder":
        """The folder with a descriptor of its own, which the caller closes."""
        return Folder(self.path, os.dup(self.descriptor))

    @contextmanager
    def below(self, name: str | PurePosixPath, make: bool = False) -> Iterator["Folder"]:
        """Open a folder at any depth below; `.` is this one."""
        folder = self
        with ExitStack() as stack:
            for part in () if str(name) == "." else _inner(str(name)).parts:
                if make:
                    with suppress(FileExistsError):
                        os.mkdir(part, dir_fd=folder.descriptor)
                folder.check_folder(part)
                flags = _FOLDER | os.O_NOFOLLOW
                descriptor = os.open(part, flags, dir_fd=folder.descriptor)
                stack.callback(os.close, descriptor)
                folder = Folder(folder.path / part, descriptor)
            yield folder

    @contextmanager
    def _holding(self, name: str, make: bool = False) -> Iterator[tuple["Folder", str]]:
        """The folder that holds a file, and the last part of its name."""
        path = _inner(name)
        with self.below(path.parent, make) as folder:
            yield folder, path.name

    def _check(self, name: str, right: Callable[[int], bool]) -> None:
        status = self.status(name)
        if status is not None and not right(status.st_mode):
            wanted = "folder" if right is stat.S_ISDIR else "regular file"
            raise self._refusal(name, status.st_mode, wanted)

    def _refusal(self, name: str, mode: int, wanted: str) -> StorageError:
        kind = _KINDS.get(stat.S_IFMT(mode), "of another kind")
        return StorageError(f"{self.path / name}: is {kind}, no {wanted}: remove it")


@contextmanager
def opened_folder(path: Path) -> Iterator[Folder]:
    """Open a folder that exists."""
    descriptor = os.open(path, _FOLDER)
    try:
        yield Folder(path, descriptor)
    finally:
        os.close(descriptor)


def missing_folders(path: Path) -> list[Path]:
    """Folders that have to be made for a path, the innermost first."""
    return [folder for folder in (path, *path.parents) if not os.path.exists(folder)]


def make_folder(path: Path, mode: int = 0o777) -> None:
    """Make a folder and those above it, where they are missing.


    Raises
    ------
    StorageError
        A link on the way to it leads to nothing.
    OSError
        It cannot be made.
    """
    for folder in reversed(missing_folders(path)):
        if folder.is_symlink():
            raise StorageError(f"{folder}: is a symbolic link to nothing: remove it")
        folder.mkdir(mode, exist_ok=True)


def leads_out(name: str) -> bool:
    """Whether a name is not that of a file below a folder."""
    path = PurePosixPath(name)
    return path.is_absolute() or ".." in path.parts or not path.parts or "\0" in name


def _inner(name: str) -> PurePosixPath:
    if leads_out(name):
        raise StorageError(f"{name!r}: leads out of the folder")
    return PurePosixPath(name)
