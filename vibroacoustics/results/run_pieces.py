"""Store of a run that may be interrupted: what it has computed, in a folder of the cache."""

import platform
import time
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any, Final, TypeVar

from ..base.errors import SchemaError, StorageError, VibroacousticsError
from ..base.folder import Folder
from ..base.pieces import hash_of_inputs, storing
from ..base.plain_bytes import sha256
from . import cache
from .files import naming
from .lock import taken
from .piece_files import PieceFiles
from .provenance import package_versions, software_version

Result = TypeVar("Result")
_HEAD_BYTES: Final = 200
"""Bound of what a piece, and a file, takes beside its content: key, size and hash."""
_LOCK_S: Final = 2.0
"""Longest time in which the workers of a run that was killed end."""
_SOURCES: Final = (".py", ".toml", ".json", ".csv")
"""Files of the package that shape results."""


class RunPieces(PieceFiles):
    """Pieces of a run; each is read once and, where it is needed again, computed again.

    So two works of one name and equal items cannot get each other's results unnoticed.

    Parameters
    ----------
    folder : folder of the files
    limit_bytes : size of all files; further pieces are not kept
    make_room : called with the size of files to come, bytes; whether the cache has room for them
    """

    def __init__(self, folder: Folder, limit_bytes: int, make_room: Callable[[int], bool]) -> None:
        super().__init__(folder)
        self._free_bytes = limit_bytes - folder.size_bytes() - _HEAD_BYTES
        self._make_room = make_room
        self._checksums: dict[str, int] = {}
        self._has_read = False

    def __contains__(self, key: object) -> bool:
        return key not in self._checksums and super().__contains__(key)

    def get(self, key: str) -> Any:
        """Return a piece; errors as of `PieceFiles.get`."""
        self._checksums[key] = zlib.crc32(self._content(key))
        self._has_read = True
        return super().get(key)

    def keep(self, key: str, content: bytes) -> None:
        """Keep a piece; where it cannot be written, one warning says so.

        Raises
        ------
        RuntimeError
            This run has another piece of the same key.
        """
        checksum, is_new = zlib.crc32(content), not super().__contains__(key)
        if self._checksums.setdefault(key, checksum) != checksum:
            raise RuntimeError(f"two pieces of a run have the key {key}: name their work apart")
        self._free_bytes -= len(content) + _HEAD_BYTES
        if is_new and self._free_bytes >= 0:
            try:
                super().keep(key, content)
            except StorageError as error:
                self._free_bytes = -1
                cache.warn(error)

    def write(self) -> None:
        """Write the pieces that are not written yet, where the cache has room for them."""
        size = self._batch_bytes + _HEAD_BYTES * (len(self._batch) + 1)
        if self._batch and not self._make_room(size):
            self._free_bytes, self._batch, self._batch_bytes = -1, {}, 0
        super().write()

    @property
    def has_read(self) -> bool:
        """Whether a piece of an earlier run was read."""
        return self._has_read

    def forget(self) -> None:
        """Set all pieces aside, and what this run knows of them."""
        self.set_aside([*self._batch, *self._files])
        self._checksums, self._has_read = {}, False


def resumed(
    job: str,
    parameters: Mapping[str, Any],
    announce: Callable[[str], None],
    work: Callable[[], Result],
) -> Result:
    """Do work whose results are stored; where stored ones do not fit it, do it again without them.

    A piece of the right type may have a shape that only the work knows to be wrong.

    Parameters
    ----------
    job, parameters, announce : arguments of `resumable`
    work : function that does the work
    """
    with resumable(job, parameters, announce) as store:
        try:
            return work()
        except Exception as error:
            is_of_user = isinstance(error, VibroacousticsError | MemoryError)
            is_fault = isinstance(error, SchemaError) or not is_of_user
            if store is None or not store.has_read or not is_fault:
                raise
            store.forget()
        return work()


@contextmanager
def resumable(
    job: str, parameters: Mapping[str, Any], announce: Callable[[str], None]
) -> Iterator[RunPieces | None]:
    """Store what is computed, and read what an interrupted run of the same inputs has stored.

    Gives the store; None where there is none.

    The store is removed when the run has ended well. A second run of the same inputs at the same
    time stores nothing.

    Parameters
    ----------
    job : name of the job
    parameters : all parameters of the study, as JSON values
    announce : called with a line where a run is continued
    """
    here = [platform.python_version(), platform.machine(), platform.node()]
    inputs = [job, parameters, software_version(), package_versions(), here, _hash_of_sources()]
    name = f"{cache.RUN}{hash_of_inputs(inputs)[:32]}"
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(cache.opened())
            store = _opened(stack, folder, name)
        except StorageError as error:
            cache.warn(error)
            store = None
        if store is None:
            yield None
            return
        if len(store):
            announce(f"continues an interrupted run: {len(store)} of its results are read")
        with storing(store.each_once):
            try:
                yield store
            except BaseException:
                with suppress(StorageError):
                    store.write()
                if not len(store):
                    folder.remove_tree(name)
                raise
        folder.remove_tree(name)


def _opened(stack: ExitStack, folder: Folder, name: str) -> RunPieces | None:
    """Open the store of a run; None where another process holds it."""
    begin = time.monotonic()
    with naming(folder.path):
        while not stack.enter_context(taken(folder, cache.lock_of(name))):
            if time.monotonic() > begin + _LOCK_S:
                return None
            time.sleep(0.1)
        cache.tidy(folder)
        if cache.size_bytes(folder) > cache.limit_bytes(folder):  # which is lower now
            folder.remove_tree(name)
        below = stack.enter_context(folder.below(name, make=True))
    return RunPieces(below, cache.limit_bytes(folder), partial(cache.make_room, folder))


def _hash_of_sources() -> str:
    """Hash of this package's files: a change of the code never meets older pieces."""
    files = sorted(Path(__file__).parent.parent.rglob("*"))
    return sha256(b"".join(file.read_bytes() for file in files if file.suffix in _SOURCES))
