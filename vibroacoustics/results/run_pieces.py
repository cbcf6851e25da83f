"""Store of a run that may be interrupted: what it has computed, in a folder of the cache."""

import platform
import time
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any, Final

from ..base.errors import StorageError
from ..base.folder import Folder
from ..base.hashing import sha256
from ..base.pieces import hash_of_inputs, storing
from . import cache
from .files import naming
from .lock import taken
from .piece_files import PieceFiles
from .provenance import package_versions, software_version

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
    limit_bytes : size of all pieces; further ones are not kept
    """

    def __init__(self, folder: Folder, limit_bytes: int) -> None:
        super().__init__(folder)
        self._free_bytes = limit_bytes
        self._checksums: dict[str, int] = {}

    def __contains__(self, key: object) -> bool:
        return key not in self._checksums and super().__contains__(key)

    def get(self, key: str) -> Any:
        """Return a piece; errors as of `PieceFiles.get`."""
        self._checksums[key] = zlib.crc32(self._content(key))
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
        self._free_bytes -= len(content)
        if is_new and self._free_bytes >= 0:
            try:
                super().keep(key, content)
            except StorageError as error:
                self._free_bytes = -1
                cache.warn(error)


@contextmanager
def resumable(
    job: str, parameters: Mapping[str, Any], announce: Callable[[str], None]
) -> Iterator[None]:
    """Store what is computed, and read what an interrupted run of the same inputs has stored.

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
            yield
            return
        if len(store):
            announce(f"continues an interrupted run: {len(store)} of its results are read")
        with storing(store.each_once):
            try:
                yield
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
        below = stack.enter_context(folder.below(name, make=True))
    return RunPieces(below, cache.limit_bytes(folder))


def _hash_of_sources() -> str:
    """Hash of this package's files: a change of the code never meets older pieces."""
    files = sorted(Path(__file__).parent.parent.rglob("*"))
    return sha256(b"".join(file.read_bytes() for file in files if file.suffix in _SOURCES))
