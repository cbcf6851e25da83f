"""Datasets as netCDF4 that other programs can read: complex numbers as pairs, text as ASCII."""

import errno
import os
from collections.abc import Hashable
from io import BytesIO
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.errors import StorageError
from ..base.heaps import check_heaps
from .hashed import MAXIMUM_RESULTS_BYTES

LARGE_BYTES: Final = 20_000_000
_PROBE_BYTES: Final = 2**20
ESCAPED: Final = "escaped_attributes"
"""Attribute that names the others that are not in ASCII."""
REAL_SUFFIX, IMAGINARY_SUFFIX = "_re", "_im"


def write_netcdf(results: xr.Dataset, path: Path) -> None:
    """Write a netCDF4 file; large variables one by one, as xarray copies all that it is given.

    Complex variables are stored as pairs `NAME_re`, `NAME_im`, each with a checksum.

    Raises
    ------
    OSError
        It cannot be written.
    """
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
    except (RuntimeError, OSError) as error:  # of a full disk: "HDF error", "Permission denied"
        raise _why_not_written(path, error) from None


def _why_not_written(path: Path, error: RuntimeError | OSError) -> OSError:
    """Words of the system when more is written to a file that netCDF could not write."""
    try:
        with path.open("ab") as file:
            file.write(bytes(_PROBE_BYTES))
            file.flush()
            os.fsync(file.fileno())
    except OSError as reason:
        return reason
    return error if isinstance(error, OSError) else OSError(errno.EIO, str(error))


def _encoding(part: xr.Dataset) -> dict[Hashable, dict[str, Any]]:
    numbers = {"fletcher32": True, "zlib": True, "complevel": 4}
    names = {"fletcher32": True, "dtype": "S1"}  # GNU Octave cannot read netCDF's strings
    return {
        name: numbers if variable.dtype.kind in "biuf" else names
        for name, variable in part.variables.items()
        if variable.ndim
    }


def from_bytes(content: bytes, path: Path) -> xr.Dataset:
    """The dataset from the bytes of a netCDF4 file; complex pairs are joined again.

    Raises
    ------
    StorageError
        They are no netCDF.
    """
    try:
        check_heaps(content)
        _check_size(content)
        read = _unescape_attributes(xr.load_dataset(content, engine="netcdf4"))
        return _plain_text(_join_complex(read))
    except StorageError as error:
        raise StorageError(f"{path}: {error}") from None
    except (OSError, ValueError, RuntimeError, LookupError, AttributeError, TypeError) as error:
        # RuntimeError is netCDF's; the others come of attributes that no result of ours has
        raise StorageError(f"{path}: is no result file: {error}") from None


def _check_size(content: bytes) -> None:
    """Refuse by what the file claims, before anything is allocated; groups may lead in circles."""
    import h5py

    size = 0.0
    with h5py.File(BytesIO(content), "r") as file:
        for name in file:
            dataset = file[name] if file.get(name, getclass=True) is h5py.Dataset else None
            if dataset is None or dataset.external or dataset.is_virtual:
                raise StorageError(f"is no result file: {name!r} is not stored in it as an array")
            size += np.prod(dataset.shape or (), dtype=float) * dataset.dtype.itemsize
            if size > MAXIMUM_RESULTS_BYTES:
                raise StorageError(
                    f"claims more than {MAXIMUM_RESULTS_BYTES / 2**30:g} GiB of values"
                )


def _ascii_attributes(results: xr.Dataset) -> xr.Dataset:
    """String attributes in ASCII, others escaped: not every reader knows netCDF's other strings.

    An attribute names the escaped ones, so that they are read as they were written.
    """
    for attrs in _attributes(results):
        texts = {name: value for name, value in attrs.items() if isinstance(value, str)}
        escaped = [name for name, text in texts.items() if not text.isascii()]
        for name in escaped:
            attrs[name] = texts[name].encode("unicode_escape").decode()
        if escaped:
            attrs[ESCAPED] = " ".join(map(str, escaped))
    return results


def _unescape_attributes(results: xr.Dataset) -> xr.Dataset:
    for attrs in _attributes(results):
        for name in str(attrs.pop(ESCAPED, "")).split():
            attrs[name] = attrs[name].encode().decode("unicode_escape")
            attrs[name].encode()  # refuses half a character, which nothing can write
    return results


def _attributes(results: xr.Dataset) -> list[dict[Any, Any]]:
    """Attributes of a dataset and of all that it holds."""
    return [results.attrs, *(results.variables[name].attrs for name in results.variables)]


def _split_complex(results: xr.Dataset) -> xr.Dataset:
    variables = {str(name): results.variables[name] for name in results.data_vars}
    complex_valued = {n: each for n, each in variables.items() if np.iscomplexobj(each.data)}
    parts = {}
    for name, variable in complex_valued.items():  # variables are not aligned, arrays are
        for suffix, part in (
            (REAL_SUFFIX, variable.values.real),
            (IMAGINARY_SUFFIX, variable.values.imag),
        ):
            parts[f"{name}{suffix}"] = xr.Variable(variable.dims, part, variable.attrs)
    return results.drop_vars(list(complex_valued)).assign(parts)


def _join_complex(split: xr.Dataset) -> xr.Dataset:
    names = [str(name) for name in split.data_vars]
    stems = [name.removesuffix(REAL_SUFFIX) for name in names if name.endswith(REAL_SUFFIX)]
    joined, parts = {}, []
    for stem in stems:
        pair = [f"{stem}{REAL_SUFFIX}", f"{stem}{IMAGINARY_SUFFIX}"]
        if pair[1] in split:
            joined[stem] = _joined(*(split.variables[name] for name in pair))
            parts += pair
    return split.drop_vars(parts).assign(joined)


def _joined(real: xr.Variable, imaginary: xr.Variable) -> xr.Variable:
    joined = np.empty(real.shape, dtype=complex)  # a sum would lose -0.0 and infinities
    joined.real, joined.imag = real.values, imaginary.values
    return real.copy(data=joined)


def _plain_text(results: xr.Dataset) -> xr.Dataset:
    """Text that was read as Python objects as arrays of `str`, as it was written."""
    texts = {name: text for name, text in results.variables.items() if text.dtype == object}
    return results.assign_coords({name: text.astype(str) for name, text in texts.items()})
