"""MAT: up to 7.2 by SciPy, 7.3 as HDF5. Numbers, also in structs; cells are not read."""

import warnings
from collections import Counter
from dataclasses import replace
from functools import cache, partial
from typing import Any, Final

import numpy as np

from ...base.errors import ParameterError
from ...base.registry import register
from ..array_recording import recorded
from ..named_arrays import NamedArray, Part, as_text
from ..reader import Reader
from ..recorded import Recorded, Request, listed
from .hdf5 import CHUNK_CACHE_BYTES, datasets, named_dataset

_HDF5_MARK: Final = b"\x89HDF\r\n\x1a\n"
_HDF5_OFFSET: Final = 512  # a MATLAB header stands before it
_NUMBERS: Final = frozenset(
    {"double", "single"} | {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
)
"""MATLAB's classes of numbers."""
_MAXIMUM_DEPTH: Final = 8
"""Structs in structs that are looked into."""


def read(request: Request) -> Recorded:
    """Vectors and tables of numbers, a time vector `t` or `time`, or a sample rate `fs`.

    Raises
    ------
    ParameterError
        There is no channel, no sample rate, or the channels differ in length.
    StorageError
        The file claims more samples than the cap allows.
    """
    with request.path.open("rb") as file:
        head = file.read(_HDF5_OFFSET + len(_HDF5_MARK))
    is_hdf5 = head.startswith(_HDF5_MARK) or head[_HDF5_OFFSET:] == _HDF5_MARK
    return _read_hdf5(request) if is_hdf5 else _read_mat(request)


def _read_mat(request: Request) -> Recorded:
    from scipy.io import loadmat, whosmat

    variables = whosmat(request.path)
    times = Counter(name for name, _, _ in variables)

    @cache
    def loaded(name: str) -> Any:
        wanted = [name] if times[name] == 1 else None  # by its name SciPy finds the first
        with warnings.catch_warnings(action="ignore"):
            return loadmat(request.path, variable_names=wanted, struct_as_record=False)[name]

    def load(name: str, part: Part) -> Any:
        return loaded(name)[part]

    arrays: list[NamedArray] = []
    for name, shape, kind in {name: (name, *rest) for name, *rest in variables}.values():
        if kind == "struct":
            arrays += fields(name, loaded(name))
        else:
            arrays.append(NamedArray(name, shape, kind in _NUMBERS, partial(load, name)))
    _check_numbers(arrays, [f"{name} ({kind})" for name, _, kind in variables])
    recording = recorded(arrays, {}, request)
    twice = [
        f"holds the variable {name!r} {number} times: the last counts, as in MATLAB"
        for name, number in times.items()
        if number > 1
    ]
    return replace(recording, remarks=[*recording.remarks, *twice])


def fields(name: str, struct: Any, depth: int = 0) -> list[NamedArray]:
    """Arrays of numbers in a struct and the structs in it, as `struct.field`.

    Parameters
    ----------
    name : of the struct
    struct : as SciPy reads it: an array of objects with fields; of several each has its number
    depth : structs around it
    """
    if depth == _MAXIMUM_DEPTH:
        return []
    arrays = []
    for number, one in enumerate(struct.ravel(), 1):
        of_one = name if struct.size == 1 else f"{name}({number})"
        for field in getattr(one, "_fieldnames", ()):
            value = np.asarray(getattr(one, field))
            path = f"{of_one}.{field}"
            if value.dtype.kind in "iufc":
                arrays.append(NamedArray(path, value.shape, True, value.__getitem__))
            elif value.dtype.kind == "O":
                arrays += fields(path, value, depth + 1)
    return arrays


def _read_hdf5(request: Request) -> Recorded:
    import h5py

    with h5py.File(request.path, "r", rdcc_nbytes=CHUNK_CACHE_BYTES) as file:
        arrays = [
            replace(named_dataset(name, dataset), name=name.replace("/", "."))
            for name, dataset in datasets(file)
            if not name.startswith("#")  # what cells refer to
            and as_text(dataset.attrs.get("MATLAB_class", "")) in _NUMBERS
        ]
        _check_numbers(arrays, [name for name in file if not name.startswith("#")])
        return recorded(arrays, {}, request)


def _check_numbers(arrays: list[NamedArray], variables: list[str]) -> None:
    if not any(array.may_be_channels for array in arrays):
        raise ParameterError(
            f"holds no vector of numbers; its variables: {listed(variables)}; "
            "save the channels as vectors, tables or fields of a struct"
        )


register(Reader("mat", (".mat",), "MAT", read))
