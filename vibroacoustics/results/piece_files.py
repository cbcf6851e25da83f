"""Pieces of work in a folder: files that appear whole or not at all.

A piece is known by a hash, so that it is computed once, whatever needs it. A file holds the pieces
of some seconds. One that is damaged is removed, and its pieces are computed again.
"""

import json
import re
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from operator import index
from typing import Any, Final

from ..base.errors import StorageError
from ..base.folder import Folder
from ..base.pieces import Item, Result, Stream
from ..base.plain_bytes import from_bytes, sha256, to_bytes
from .files import STAGING_NAME, replace_all, staging, write
from .hashed import hash_line, read_checked

_FIRST: Final = "pieces_"
_NAME: Final = re.compile(_FIRST + r"\d{8}\.bin")
BATCH_S: Final = 10.0
"""Longest time between two files, but for the piece that is in work."""
_BATCH_BYTES: Final = 64_000_000
"""Size of the pieces of a file, but for the last one."""


class PieceFiles:
    """Pieces, see `to_bytes`, in a folder that this process alone writes.

    Parameters
    ----------
    folder : folder of the files
    clock : function that gives the time, s
    """

    def __init__(self, folder: Folder, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder, self._clock = folder, clock
        self._batch: dict[str, bytes] = {}
        self._batch_bytes, self._written_s = 0, clock()
        self._files: dict[str, str] = {}
        self._last: tuple[str, dict[str, bytes]] = "", {}
        self._has_warned = False
        self._names = sorted(filter(_NAME.fullmatch, folder.files()))
        for name in self._names:
            self._take_in(name)

    def __contains__(self, key: object) -> bool:
        return key in self._batch or key in self._files

    def __len__(self) -> int:
        return len(self._batch) + len(self._files)

    def get(self, key: str) -> Any:
        """Return a piece that the store holds."""
        return from_bytes(self._content(key))

    def put(self, key: str, piece: Any) -> None:
        """Keep a piece; it is written with those of the last seconds; errors as of `write`."""
        self.keep(key, to_bytes(piece))

    def keep(self, key: str, content: bytes) -> None:
        """Keep a piece as bytes; errors as of `write`."""
        self._batch[key] = content
        self._batch_bytes += len(content)
        is_due = self._clock() >= self._written_s + BATCH_S
        if is_due or self._batch_bytes >= _BATCH_BYTES:
            self.write()

    def write(self) -> None:
        """Write the pieces that are not written yet."""
        if self._batch:
            last = self._names[-1].removeprefix(_FIRST).partition(".")[0] if self._names else "-1"
            name = f"{_FIRST}{int(last) + 1:08d}.bin"
            sizes = {key: len(content) for key, content in self._batch.items()}
            content = b"".join([json.dumps(sizes).encode(), b"\n", *self._batch.values()])
            with staging(self._folder, STAGING_NAME) as staged:
                write(staged, name, [content, hash_line(sha256(content))])
                replace_all(staged)
            self._names.append(name)
            self._files |= dict.fromkeys(self._batch, name)
        self._batch, self._batch_bytes, self._written_s = {}, 0, self._clock()

    def each_once(
        self,
        items: Iterable[Item],
        stream: Stream[Item, Result],
        key_of: Callable[[Item], str],
        fits: Callable[[Item, Any], bool] = lambda *_: True,
    ) -> Iterator[Result]:
        """Give the pieces of items in their order; a stream computes those that are not stored.

        Parameters
        ----------
        items : items
        stream : function that computes pieces, in the order of their items
        key_of : function that gives the key of an item
        fits : function that says whether an item may have a piece; others are computed again
        """
        waiting: deque[tuple[str, bool]] = deque()

        def missing() -> Iterator[Item]:
            for item in items:
                key = key_of(item)
                waiting.append((key, key in self and self._is_sound(key, item, fits)))
                if not waiting[-1][1]:
                    yield item

        def stored_next() -> Iterator[Result]:
            while waiting and waiting[0][1]:
                yield self.get(waiting.popleft()[0])

        for piece in stream(missing()):
            yield from stored_next()
            self.put(waiting.popleft()[0], piece)
            yield piece
        yield from stored_next()

    def _is_sound(self, key: str, item: Item, fits: Callable[[Item, Any], bool]) -> bool:
        """Whether the piece of an item can be read and fits; others are forgotten, with a warning.

        Any content may have the right hash.
        """
        with suppress(Exception):  # of bytes of any form
            if fits(item, from_bytes(self._content(key))):
                return True
        self.set_aside([key])
        return False

    def set_aside(self, keys: Iterable[str]) -> None:
        """Forget pieces that do not fit; one warning says that they are computed again."""
        if not self._has_warned:
            where = f"{self._folder.path}: stored results do not fit"
            warnings.warn(f"{where}; they are computed again", stacklevel=4)
        self._has_warned = True
        for key in list(keys):
            self._batch.pop(key, None)
            self._files.pop(key, None)

    def _content(self, key: str) -> bytes:
        if key in self._batch:
            return self._batch[key]
        name = self._files[key]
        if self._last[0] != name:
            self._last = name, self._read(name)
        return self._last[1][key]

    def _take_in(self, name: str) -> None:
        """Note the pieces of a file; remove it if it is damaged."""
        self._folder.check_file(name)
        try:
            self._files |= dict.fromkeys(self._read(name), name)
        except StorageError as error:
            warnings.warn(f"{error}; its pieces are computed again", stacklevel=4)
            self._folder.remove(name)

    def _read(self, name: str) -> dict[str, bytes]:
        content = read_checked(self._folder.path / name, self._folder).content
        begin = content.find(b"\n") + 1
        try:
            sizes = {key: index(size) for key, size in json.loads(content[:begin]).items()}
        except (ValueError, TypeError, AttributeError, RecursionError):
            sizes = {"": -1}
        if min(sizes.values(), default=0) < 0 or sum(sizes.values()) != len(content) - begin:
            raise StorageError(f"{self._folder.path / name}: holds no pieces")
        pieces = {}
        for key, size in sizes.items():
            pieces[key] = content[begin : begin + size]
            begin += size
        return pieces
