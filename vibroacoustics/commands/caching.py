"""Content of the cache, and its limit."""

from datetime import datetime
from typing import Any

from ..results import cache
from ..results.files import naming
from .outcome import Outcome, columns


def managed(clear: bool, limit_gb: float | None) -> Outcome:
    """Clear the cache or limit its size, then list its entries, the least recently used first.

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
    entries, limit = cache.contents()
    rows: list[dict[str, Any]] = [
        {
            "used": datetime.fromtimestamp(entry.used_s).isoformat(" ", "minutes"),
            "size_mb": entry.size_bytes / 1e6,
            "name": entry.name,
            "study": entry.study or "unknown study",
        }
        for entry in entries
    ]
    lines = [f"removed {len(removed)} results, {_megabytes(removed)}"] if removed else []
    lines += ["{used}  {size_mb:9.1f} MB  {name}  {study}".format(**row) for row in rows]
    total = f"{len(entries)} results, {_megabytes(entries)} of at most {limit / 1e6:g} MB"
    return Outcome("\n".join([*lines, f"{path}: {total}"]), tables={"entries": columns(rows)})


def _megabytes(entries: list[cache.Entry]) -> str:
    return f"{sum(entry.size_bytes for entry in entries) / 1e6:.1f} MB"
