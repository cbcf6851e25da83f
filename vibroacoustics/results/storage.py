"""Datasets on disk: netCDF with its hash, whole or not at all, and a cache that is only a help.

A netCDF file that is killed while it is written opens cleanly with variables missing. So it is
written beside its name, gets its hash as the last line, and then takes its name in one step.
"""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Final

import xarray as xr

from ..base.errors import StorageError
from ..base.folder import Folder
from ..base.pieces import following_from
from ..base.plain_bytes import canonical_json, sha256
from . import cache, hashed
from .files import Staging, naming, only_writer, replace_all, staging, write
from .lock import locked
from .netcdf import from_bytes, write_netcdf
from .provenance import RECORDING_SCHEMA_VERSION, SCHEMA_VERSION

_ENTRY: Final = "cache_entry"
"""Attribute of a cached result: the name of its entry."""
_CACHE_IS_USED: Final = ContextVar("_CACHE_IS_USED", default=True)


def write_results(results: xr.Dataset, path: str | Path) -> Path:
    """Write a dataset as netCDF4 with its hash, whole or not at all.

    What was there before stays readable until then. A folder has one writer at a time: another is
    waited for.
    """
    path = Path(path)
    with only_writer(path.parent) as staged:
        stage_results(results, staged, path.name)
        replace_all(staged)
    return path


def stage_results(results: xr.Dataset, staged: Staging, name: str) -> str:
    """Write a dataset into a hidden folder; returns its hash."""
    with naming(staged.path / name):
        write_netcdf(results, staged.library_path(name))
        with open(name, "r+b", opener=staged.open) as file:
            digest = hashed.append_hash(file)
            file.flush()
            os.fsync(file.fileno())
    return digest


def open_results(path: str | Path) -> xr.Dataset:
    """Read a dataset that `write_results` wrote, into memory.

    Parameters
    ----------
    path : file that a command or `write_report` wrote

    Raises
    ------
    StorageError
        The file is missing, has no hash, does not match it, is no netCDF, or is of another
        version.

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
    results = from_bytes(content, path)
    if "schema_version" in results.attrs:
        versions = (SCHEMA_VERSION, RECORDING_SCHEMA_VERSION)
        check_version(results, path, () if "criterion_value" in results else versions)
    return results, digest


def check_version(results: xr.Dataset, path: str | Path, further: Sequence[str] = ()) -> None:
    """Refuse results that another version of the package wrote.

    Parameters
    ----------
    results : orders of a recording, or other results
    path : file that they are from
    further : versions of the schema that are allowed beside that of such results

    Raises
    ------
    StorageError
        The attribute `schema_version` is missing or another.
    """
    recorded = "channel_order" in results
    allowed = RECORDING_SCHEMA_VERSION if recorded else SCHEMA_VERSION
    version = results.attrs.get("schema_version")
    if version not in (allowed, *further):
        again = "orders RECORDING" if recorded else "run STUDY.toml"
        raise StorageError(
            f"{path}: schema_version = {version}: is no result of this version, {allowed}; make it "
            f"again: vibroacoustics {again}"
        )


def results_in(folder: Folder, name: str) -> xr.Dataset:
    """`open_results` of a file of a folder, which is no link to another."""
    path = folder.path / name
    return from_bytes(hashed.read_checked(path, folder).content, path)


@contextmanager
def without_cache() -> Iterator[None]:
    """Neither read the cache nor write it."""
    before = _CACHE_IS_USED.set(False)
    try:
        yield
    finally:
        _CACHE_IS_USED.reset(before)


def cached(
    kind: str, material: Mapping[str, Any], compute: Callable[[], xr.Dataset], study: str = ""
) -> tuple[xr.Dataset, bool]:
    """Result from the cache, or computed and put there.

    A cache that cannot be written costs one warning. Another process that computes the same is
    waited for, and named in a warning.

    Parameters
    ----------
    kind : first part of the file name
    material : everything that shapes the result, as JSON values; its hash is the address
    compute : makes the result
    study : title of the study that the result is computed for, which `vibroacoustics cache` lists

    Returns
    -------
    result, whether it came from the cache
    """
    if not _CACHE_IS_USED.get():
        return compute(), False
    name = _entry(kind, material)
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(cache.opened())
        except StorageError as error:
            cache.warn(error)
            return compute(), False
        if (result := _known(folder, name)) is not None:
            return result, True
        can_be_written = _locked_entry(stack, folder, name)
        if (result := _known(folder, name)) is not None:
            return result, True
        with following_from(lambda: [kind, material]):
            result = compute()
        if can_be_written:
            _keep(result, folder, name, study)
    return result, False


def is_cached(kind: str, material: Mapping[str, Any]) -> bool:
    """Whether `cached` would find a result, if it is whole."""
    if not _CACHE_IS_USED.get() or not cache.folder().exists():
        return False
    try:
        with cache.opened() as folder:
            return folder.holds_file(_entry(kind, material))
    except StorageError:
        return False


def _entry(kind: str, material: Mapping[str, Any]) -> str:
    return f"{kind}-{sha256(canonical_json(material).encode())[:32]}.nc"


def _known(folder: Folder, name: str) -> xr.Dataset | None:
    """The cached result, where it is there, whole and stored for this entry.

    A file of another entry has a right hash, too; it is named in a warning.
    """
    try:
        result = results_in(folder, name)
    except StorageError:
        return None
    stored_for = result.attrs.pop(_ENTRY, None)
    if stored_for is None:  # of an earlier version
        return None
    if stored_for != name:
        cache.warn(StorageError(f"{folder.path / name}: is no result of this entry"))
        return None
    cache.mark_used(folder, name)
    return result


def _locked_entry(stack: ExitStack, folder: Folder, name: str) -> bool:
    """Hold the lock of an entry; False where the cache cannot be written."""
    what = f"cache {name}: computed by another (--no-cache does not wait)"
    try:
        with naming(folder.path):
            stack.enter_context(locked(folder, cache.lock_of(name), what))
    except StorageError as error:
        cache.warn(error)
        return False
    return True


def _keep(result: xr.Dataset, folder: Folder, name: str, study: str) -> None:
    try:
        with staging(folder, cache.staging_of(name)) as staged:
            stage_results(result.assign_attrs({_ENTRY: name}), staged, name)
            if study:
                write(staged, cache.study_of(name), study.encode())
            size = staged.size_bytes()
            with naming(folder.path):
                if not cache.make_room(folder, size, written=size):
                    cache.warn_of_limit(folder)
                    return
            replace_all(staged)
    except StorageError as error:
        cache.warn(error)
