"""Results on disk: atomic netCDF with a hash, and a content-addressed cache.

A netCDF file that is killed while it is written opens cleanly with variables missing. So the
content is written beside its name, synced and moved into place; `NAME.sha256` follows. A file
counts as done only if the hash matches.
"""

import errno
import hashlib
import os
import tempfile
from collections.abc import Callable, Hashable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np
import platformdirs
import xarray as xr
from filelock import FileLock

from ..base.errors import StorageError
from ..base.hashing import canonical_json, sha256

LARGE_BYTES: Final = 20_000_000
ESCAPED: Final = "escaped_attributes"
"""Attribute that names the others that are not in ASCII."""
REAL_SUFFIX, IMAGINARY_SUFFIX = "_re", "_im"


def write_results(results: xr.Dataset, path: str | Path) -> Path:
    """Write a dataset as netCDF4, whole or not at all, and its hash beside it.

    Complex variables are stored as pairs `NAME_re`, `NAME_im`, each with a checksum. An older
    hash goes first, so that at no moment does a file stand beside the hash of another.
    """
    path = Path(path)
    with _appearing(path) as temporary:
        _write_netcdf(results, temporary)
        with temporary.open("rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        _hash_path(path).unlink(missing_ok=True)
    write_bytes(_hash_path(path), f"{digest}  {path.name}\n".encode())
    return path


def open_results(path: str | Path) -> xr.Dataset:
    """Read a dataset that `write_results` wrote, into memory.

    Raises
    ------
    StorageError
        The file is missing, has no hash, does not match it, or is no netCDF.
    """
    path = Path(path)
    content = _read(path)
    expected = _read(_hash_path(path)).split(b" ")[0].decode("ascii", "replace")
    if sha256(content) != expected:
        raise StorageError(f"{path}: content does not match its hash; run the study again")
    return from_bytes(content, path)


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file so that it appears whole or not at all.

    Raises
    ------
    StorageError
        The folder cannot be written.
    """
    with _appearing(path) as temporary:
        temporary.write_bytes(content)


@contextmanager
def _appearing(path: Path) -> Iterator[Path]:
    """A name beside the file's to write to; then it is synced and takes the file's place."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
        os.close(handle)
        temporary = Path(name)
        try:
            yield temporary
            _sync(temporary)
            os.chmod(temporary, 0o644)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
        _sync(path.parent)
    except OSError as error:
        raise _not_writable(path, error) from None


def _not_writable(path: Path, error: OSError) -> StorageError:
    return StorageError(f"{path}: cannot be written: {error.strerror}")


def _write_netcdf(results: xr.Dataset, path: Path) -> None:
    """Write a netCDF4 file; large variables one by one, as xarray copies all that it is given."""
    split = _ascii_attributes(_split_complex(results))
    large = [str(name) for name, array in split.data_vars.items() if array.nbytes > LARGE_BYTES]
    parts = [split.drop_vars(large)]
    parts += [split[[name]].drop_vars(list(split.coords), errors="ignore") for name in large]
    try:
        for number, part in enumerate(parts):
            part.to_netcdf(
                path,
                mode="a" if number else "w",
                engine="netcdf4",
                format="NETCDF4",
                encoding=_encoding(part),
            )
    except RuntimeError as error:  # netCDF's word for a full disk
        raise OSError(errno.EIO, str(error)) from None


def _encoding(part: xr.Dataset) -> dict[Hashable, dict[str, Any]]:
    numbers = {"fletcher32": True, "zlib": True, "complevel": 4}
    names = {"fletcher32": True, "dtype": "S1"}  # GNU Octave cannot read netCDF's strings
    return {
        name: numbers if variable.dtype.kind in "fiu" else names
        for name, variable in part.variables.items()
        if variable.ndim
    }


def from_bytes(content: bytes, path: Path) -> xr.Dataset:
    """The dataset from the bytes of a netCDF4 file; complex pairs are joined again."""
    try:
        read = _unescape_attributes(xr.load_dataset(content, engine="netcdf4"))
        return _plain_text(_join_complex(read))
    except (OSError, ValueError) as error:
        raise StorageError(f"{path}: is no result file: {error}") from None


def cache_folder() -> Path:
    """Folder of the cache of expensive results."""
    return Path(platformdirs.user_cache_dir("vibroacoustics"))


def cached(
    kind: str, material: Mapping[str, Any], compute: Callable[[], xr.Dataset]
) -> tuple[xr.Dataset, bool]:
    """Result from the cache, or computed and put there.

    Parameters
    ----------
    kind : first part of the file name
    material : everything that shapes the result, as JSON values; its hash is the address
    compute : makes the result

    Returns
    -------
    result, whether it came from the cache
    """
    path = cache_folder() / f"{kind}-{sha256(canonical_json(material).encode())[:32]}.nc"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock = FileLock(f"{path}.lock").acquire()
    except OSError as error:
        raise _not_writable(path, error) from None
    with lock:
        try:
            return open_results(path), True
        except StorageError:
            result = compute()
            write_results(result, path)
            return result, False


def _ascii_attributes(results: xr.Dataset) -> xr.Dataset:
    """String attributes in ASCII, others escaped: not every reader knows netCDF's other strings.

    Which ones are escaped stands beside them, so that they are read as they were written.
    """
    for attrs in _attributes(results):
        escaped = [
            name for name, value in attrs.items() if isinstance(value, str) and not value.isascii()
        ]
        for name in escaped:
            attrs[name] = attrs[name].encode("unicode_escape").decode()
        if escaped:
            attrs[ESCAPED] = " ".join(map(str, escaped))
    return results


def _unescape_attributes(results: xr.Dataset) -> xr.Dataset:
    for attrs in _attributes(results):
        for name in str(attrs.pop(ESCAPED, "")).split():
            attrs[name] = attrs[name].encode().decode("unicode_escape")
    return results


def _attributes(results: xr.Dataset) -> list[dict[Any, Any]]:
    """Attributes of a dataset and of all that it holds."""
    return [results.attrs, *(results.variables[name].attrs for name in results.variables)]


def _split_complex(results: xr.Dataset) -> xr.Dataset:
    split = results.copy()
    for name, array in results.data_vars.items():
        if np.iscomplexobj(array.data):
            split = split.drop_vars(str(name))
            split[f"{name}{REAL_SUFFIX}"] = array.real.assign_attrs(array.attrs)
            split[f"{name}{IMAGINARY_SUFFIX}"] = array.imag.assign_attrs(array.attrs)
    return split


def _join_complex(split: xr.Dataset) -> xr.Dataset:
    results = split.copy()
    for name in map(str, split.data_vars):
        stem = name.removesuffix(REAL_SUFFIX)
        if stem == name or stem + IMAGINARY_SUFFIX not in split:
            continue
        real, imaginary = split[name], split[stem + IMAGINARY_SUFFIX]
        results = results.drop_vars([name, stem + IMAGINARY_SUFFIX])
        joined = np.empty(real.shape, dtype=complex)  # a sum would lose -0.0 and infinities
        joined.real, joined.imag = real.values, imaginary.values
        results[stem] = real.copy(data=joined)
    return results


def _plain_text(results: xr.Dataset) -> xr.Dataset:
    """Text that was read as Python objects as arrays of `str`, as it was written."""
    texts = [name for name, variable in results.variables.items() if variable.dtype == object]
    return results.assign_coords(
        {name: results[name].astype(str).assign_attrs(results[name].attrs) for name in texts}
    )


def _hash_path(path: Path) -> Path:
    return path.with_name(path.name + ".sha256")


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise StorageError(f"{path}: no such file") from None
    except OSError as error:
        raise StorageError(f"{path}: cannot be read: {error.strerror}") from None


def _sync(path: Path) -> None:
    """Carry a file, or the names in a folder, to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
