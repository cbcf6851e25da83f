"""Datasets on disk: netCDF with its hash, whole or not at all, and a cache that is only a help.

A netCDF file that is killed while it is written opens cleanly with variables missing. So it is
written beside its name, gets its hash as the last line, and then takes its name in one step.
"""

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Final

import xarray as xr

from ..base.errors import StorageError
from ..base.hashing import canonical_json, sha256
from . import cache, hashed
from .files import naming, only_writer, replace_all, staging, sync
from .lock import locked
from .netcdf import from_bytes, write_netcdf

_CACHE_IS_USED: Final = ContextVar("_CACHE_IS_USED", default=True)


def write_results(results: xr.Dataset, path: str | Path) -> Path:
    """Write a dataset as netCDF4 with its hash, whole or not at all.

    What was there before stays readable until then. A folder has one writer at a time: another is
    waited for.

    Raises
    ------
    StorageError
        It cannot be written.
    """
    path = Path(path)
    with only_writer(path.parent) as staged:
        stage_results(results, staged / path.name)
        replace_all(staged, path.parent)
        hashed.hash_path(path).unlink(missing_ok=True)  # of an earlier version
    return path


def stage_results(results: xr.Dataset, path: Path) -> str:
    """Write a dataset into a hidden folder; returns its hash.

    Raises
    ------
    StorageError
        It cannot be written.
    """
    with naming(path):
        write_netcdf(results, path)
        digest = hashed.append_hash(path)
        sync(path)
    return digest


def open_results(path: str | Path) -> xr.Dataset:
    """Read a dataset that `write_results` wrote, into memory.

    Parameters
    ----------
    path : file that a command or `write_report` wrote; its hash lies beside it

    Raises
    ------
    StorageError
        The file is missing, has no hash, does not match it, or is no netCDF.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> results["force_amplitude"].dims
    ('speed', 'option', 'order')
    """
    return open_with_hash(path)[0]


def open_with_hash(path: str | Path) -> tuple[xr.Dataset, str]:
    """`open_results`, and the hash of what was read."""
    path = Path(path)
    content, digest = hashed.read_checked(path)
    return from_bytes(content, path), digest


@contextmanager
def without_cache() -> Iterator[None]:
    """Neither read the cache nor write it."""
    before = _CACHE_IS_USED.set(False)
    try:
        yield
    finally:
        _CACHE_IS_USED.reset(before)


def cached(
    kind: str, material: Mapping[str, Any], compute: Callable[[], xr.Dataset]
) -> tuple[xr.Dataset, bool]:
    """Result from the cache, or computed and put there.

    A cache that cannot be written costs one warning. Another process that computes the same is
    waited for, and named in a warning.

    Parameters
    ----------
    kind : first part of the file name
    material : everything that shapes the result, as JSON values; its hash is the address
    compute : makes the result

    Returns
    -------
    result, whether it came from the cache
    """
    if not _CACHE_IS_USED.get():
        return compute(), False
    path = _entry(kind, material)
    if (result := _known(path)) is not None:
        return result, True
    with ExitStack() as stack:
        can_be_written = _locked_entry(stack, path)
        if (result := _known(path)) is not None:
            return result, True
        result = compute()
        if can_be_written:
            _keep(result, path)
    return result, False


def is_cached(kind: str, material: Mapping[str, Any]) -> bool:
    """Whether `cached` would find a result, if it is whole."""
    return _CACHE_IS_USED.get() and _entry(kind, material).exists()


def _entry(kind: str, material: Mapping[str, Any]) -> Path:
    return cache.folder() / f"{kind}-{sha256(canonical_json(material).encode())[:32]}.nc"


def _known(path: Path) -> xr.Dataset | None:
    """The cached result, where it is there and whole."""
    try:
        result = open_results(path)
    except StorageError:
        return None
    cache.mark_used(path)
    return result


def _locked_entry(stack: ExitStack, path: Path) -> bool:
    """Hold the lock of an entry; False where the cache cannot be written."""
    what = f"cache {path.name}: computed by another (--no-cache does not wait)"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        stack.enter_context(locked(cache.lock_of(path), what))
    except OSError as error:
        _warn(f"{error.strerror}")
        return False
    return True


def _keep(result: xr.Dataset, path: Path) -> None:
    try:
        with staging(cache.staging_of(path)) as staged:
            stage_results(result, staged / path.name)
            replace_all(staged, path.parent)
            hashed.hash_path(path).unlink(missing_ok=True)
        cache.tidy(path.parent)
    except (StorageError, OSError) as error:
        _warn(str(error).rpartition("cannot be written: ")[2])


def _warn(reason: str) -> None:
    text = f"cache {cache.folder()}: cannot be written: {reason}; the run goes on without it"
    warnings.warn(text, stacklevel=4)
