"""Pieces of work in a folder: files that appear whole or not at all.

A piece is known by a hash, so that it is computed once, whatever needs it. A file holds the pieces
of some seconds. One that is damaged is removed, and its pieces are computed again.
"""

import time
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import ClassVar, Final, Generic, TypeVar

from ..base.errors import StorageError
from ..base.folder import Folder
from .files import STAGING_NAME, Staging, replace_all, staging

Piece = TypeVar("Piece")
_FIRST: Final = "pieces_"
_BATCH_S: Final = 10.0
"""Longest time between two files, but for the piece that is in work."""


class PieceFiles(ABC, Generic[Piece]):
    """Pieces in a folder that this process alone writes.

    Parameters
    ----------
    folder : folder of the files
    clock : function that gives the time, s
    """

    suffix: ClassVar[str]
    batch_bytes: ClassVar[int]
    """Size of the pieces of a file, at most by the last one."""
    pieces: ClassVar[str] = "pieces"
    """Noun of the pieces in messages."""

    def __init__(self, folder: Folder, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder, self._clock = folder, clock
        self._batch: dict[str, Piece] = {}
        self._batch_bytes, self._written_s = 0, clock()
        self._files: dict[str, str] = {}
        self._last: tuple[str, Mapping[str, Piece]] | None = None
        self._names = sorted(name for name in folder.files() if name.startswith(_FIRST))
        for name in self._names:
            self._take_in(name)

    def __contains__(self, key: object) -> bool:
        return key in self._batch or key in self._files

    def __len__(self) -> int:
        return len(self._batch) + len(self._files)

    def get(self, key: str) -> Piece:
        """Return a piece that the store holds.

        Raises
        ------
        StorageError
            Its file cannot be read any more.
        """
        if key in self._batch:
            return self._batch[key]
        name = self._files[key]
        if self._last is None or self._last[0] != name:
            self._last = name, self._read(name)
        return self._last[1][key]

    def put(self, key: str, piece: Piece) -> None:
        """Keep a piece; it is written with those of the last seconds.

        Raises
        ------
        StorageError
            They cannot be written.
        """
        self._batch[key] = piece
        self._batch_bytes += self._size_bytes(piece)
        if self._clock() >= self._written_s + _BATCH_S or self._batch_bytes >= self.batch_bytes:
            self.write()

    def write(self) -> None:
        """Write the pieces that are not written yet.

        Raises
        ------
        StorageError
            They cannot be written.
        """
        if self._batch:
            last = self._names[-1].removeprefix(_FIRST).partition(".")[0] if self._names else "-1"
            name = f"{_FIRST}{int(last) + 1:08d}{self.suffix}"
            with staging(self._folder, STAGING_NAME) as staged:
                self._stage(self._batch, staged, name)
                replace_all(staged)
            self._names.append(name)
            self._files |= dict.fromkeys(self._batch, name)
        self._batch, self._batch_bytes, self._written_s = {}, 0, self._clock()

    def _take_in(self, name: str) -> None:
        """Note the pieces of a file; remove it if it is damaged."""
        self._folder.check_file(name)
        try:
            self._files |= dict.fromkeys(self._read(name), name)
        except StorageError as error:
            warnings.warn(f"{error}; its {self.pieces} are evaluated again", stacklevel=4)
            self._folder.remove(name)

    @abstractmethod
    def _size_bytes(self, piece: Piece) -> int:
        """Size of a piece in memory."""

    @abstractmethod
    def _stage(self, pieces: Mapping[str, Piece], staged: Staging, name: str) -> None:
        """Write pieces to a file of a hidden folder."""

    @abstractmethod
    def _read(self, name: str) -> Mapping[str, Piece]:
        """Read the pieces of a file.

        Raises
        ------
        StorageError
            It is damaged.
        """
