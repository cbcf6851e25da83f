"""Store of a run that may be interrupted: what it has computed, in a folder of the cache."""

import json
import platform
import time
import warnings
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any, Final

from ..base.errors import StorageError
from ..base.folder import Folder
from ..base.hashing import sha256
from ..base.pieces import hash_of_inputs, storing
from ..base.plain_bytes import from_bytes, to_bytes
from ..base.registry import plugins
from . import cache
from .files import Staging, naming, write
from .hashed import read_checked, with_hash
from .lock import taken
from .piece_files import PieceFiles
from .provenance import package_versions, software_version

_LOCK_S: Final = 2.0
"""Longest time in which the workers of a run that was killed end."""
_SOURCES: Final = (".py", ".toml", ".json", ".csv")
"""Files of the package that shape results."""


class RunPieces(PieceFiles[bytes]):
    """Pieces of a run as bytes; each is read at most once in a run, and then computed again.

    So two works of one name and equal items cannot get each other's results unnoticed.

    Parameters
    ----------
    folder : folder of the files
    study : title of the study
    limit_bytes : size of all pieces; further ones are not kept
    clock : function that gives the time, s
    """

    suffix, batch_bytes = ".pieces", 100_000_000

    def __init__(
        self,
        folder: Folder,
        study: str = "",
        limit_bytes: float = cache.DEFAULT_LIMIT_BYTES,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        super().__init__(folder, clock)
        self._study, self._free_bytes = study, limit_bytes
        self._checksums: dict[str, int] = {}

    def __contains__(self, key: object) -> bool:
        return key not in self._checksums and super().__contains__(key)

    def get(self, key: str) -> Any:
        """Return the value of a piece; errors as of `PieceFiles.get`."""
        content = super().get(key)
        self._checksums[key] = zlib.crc32(content)
        return from_bytes(content)

    def put(self, key: str, piece: Any) -> None:
        """Keep the value of a piece; a store that cannot be written costs one warning.

        Raises
        ------
        RuntimeError
            This run has another piece of the same key.
        """
        content = to_bytes(piece)
        checksum = zlib.crc32(content)
        if self._checksums.setdefault(key, checksum) != checksum:
            raise RuntimeError(f"two pieces of a run have the key {key}: name their work apart")
        self._free_bytes -= len(content)
        if not super().__contains__(key) and self._free_bytes >= 0:
            try:
                super().put(key, content)
            except StorageError as error:
                self._free_bytes = -1
                warnings.warn(f"{error}; an interrupted run will not resume", stacklevel=2)

    def _size_bytes(self, piece: bytes) -> int:
        return len(piece)

    def _stage(self, pieces: Mapping[str, bytes], staged: Staging, name: str) -> None:
        index = json.dumps({key: len(piece) for key, piece in pieces.items()}).encode()
        write(staged, cache.STUDY_NAME, self._study.encode())
        write(staged, name, with_hash([index, b"\n", *pieces.values()]))

    def _read(self, name: str) -> dict[str, bytes]:
        path = self._folder.path / name
        index, _, content = read_checked(path, self._folder).content.partition(b"\n")
        pieces, begin = {}, 0
        for key, size in json.loads(index).items():
            pieces[key] = content[begin : begin + size]
            begin += size
        return pieces


@contextmanager
def resumable(
    job: str, parameters: Mapping[str, Any], study: str, announce: Callable[[str], None]
) -> Iterator[None]:
    """Store what is computed, and read what an interrupted run of the same inputs has stored.

    The store is removed when the run has ended well. A second run of the same inputs at the same
    time, and one with code of third parties, stores nothing.

    Parameters
    ----------
    job : name of the job
    parameters : all parameters of the study, as JSON values
    study : title of the study
    announce : called with a line where a run is continued
    """
    inputs = [job, parameters, software_version(), package_versions(), _platform()]
    name = f"{cache.RUN}{sha256((hash_of_inputs(inputs) + _hash_of_sources()).encode())[:32]}"
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(cache.opened())
            store = None if plugins() else _opened(stack, folder, name, study)
        except StorageError as error:
            warnings.warn(f"cache {error}; an interrupted run will not resume", stacklevel=3)
            store = None
        if store is None:
            yield
            return
        if len(store):
            announce(f"continues an interrupted run: {len(store)} of its results are read")
        with storing(store):
            try:
                yield
            except BaseException:
                with suppress(StorageError):
                    store.write()
                raise
        folder.remove_tree(name)


def _opened(stack: ExitStack, folder: Folder, name: str, study: str) -> RunPieces | None:
    """Open the store of a run; None where another process holds it."""
    begin = time.monotonic()
    with naming(folder.path):
        while not stack.enter_context(taken(folder, cache.lock_of(name))):
            if time.monotonic() > begin + _LOCK_S:
                return None
            time.sleep(0.1)
        cache.tidy(folder)
        below = stack.enter_context(folder.below(name, make=True))
    return RunPieces(below, study, cache.limit_bytes(folder))


def _platform() -> list[str]:
    return [platform.python_version(), platform.machine(), platform.node()]


def _hash_of_sources() -> str:
    """Hash of this package's files: a change of the code never meets older pieces."""
    package = Path(__file__).parent.parent
    files = sorted(file for file in package.rglob("*") if file.suffix in _SOURCES)
    return sha256(b"".join(sha256(file.read_bytes()).encode() for file in files))
