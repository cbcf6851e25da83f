"""What `vibroacoustics cache` does and says."""

from collections.abc import Iterator
from datetime import datetime

from ..results import cache
from ..results.files import naming


def lines(clear: bool, limit_gb: float | None) -> Iterator[str]:
    """Clear the cache or limit its size, then one line for each entry that is left.

    Raises
    ------
    StorageError
        The folder cannot be written.
    """
    path = cache.folder()
    removed: list[cache.Entry] = []
    if limit_gb is not None or (clear and path.exists()):
        with cache.opened() as folder, naming(path):
            if limit_gb is not None:
                cache.set_limit(folder, round(1e9 * limit_gb))
            removed = cache.clear(folder) if clear else cache.tidy(folder)
    if removed:
        yield f"removed {len(removed)} results, {_megabytes(removed)}"
    left, limit = cache.contents()
    for entry in left:
        used = datetime.fromtimestamp(entry.used_s).isoformat(" ", "minutes")
        yield f"{used}  {entry.size_bytes / 1e6:9.1f} MB  {entry.name}"
    yield f"{path}: {len(left)} results, {_megabytes(left)} of at most {limit / 1e6:g} MB"


def _megabytes(entries: list[cache.Entry]) -> str:
    return f"{sum(entry.size_bytes for entry in entries) / 1e6:.1f} MB"
