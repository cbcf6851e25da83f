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
    folder = cache.folder()
    removed: list[cache.Entry] = []
    with naming(folder):
        if limit_gb is not None:
            cache.set_limit(folder, round(1e9 * limit_gb))
        if clear or limit_gb is not None:
            removed = cache.clear(folder) if clear else cache.tidy(folder)
    if removed:
        yield f"removed {len(removed)} results, {_megabytes(removed)}"
    left = cache.entries(folder)
    for entry in left:
        used = datetime.fromtimestamp(entry.used_s).isoformat(" ", "minutes")
        yield f"{used}  {entry.size_bytes / 1e6:9.1f} MB  {entry.path.name}"
    limit = cache.limit_bytes(folder)
    yield f"{folder}: {len(left)} results, {_megabytes(left)} of at most {limit / 1e6:g} MB"


def _megabytes(entries: list[cache.Entry]) -> str:
    return f"{sum(entry.size_bytes for entry in entries) / 1e6:.1f} MB"
