"""MAT: up to 7.2 by SciPy, 7.3 as HDF5. Numbers, also in structs; signals of Testlab.

Cells are not read.
"""

import math
import warnings
from collections import Counter
from dataclasses import replace
from functools import cache, partial
from typing import Any, Final

import numpy as np

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..array_recording import recorded
from ..claims import DEFLATE_RATIO, check_claim
from ..named_arrays import NamedArray, Part, as_text
from ..reader import Reader
from ..recorded import Recorded, Request, check_size, listed
from ..testlab import Struct, recorded_signals
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
    """Vectors and tables of numbers, a time vector `t` or `time`, or a sample rate `fs`."""
    with request.path.open("rb") as file:
        head = file.read(_HDF5_OFFSET + len(_HDF5_MARK))
    is_hdf5 = head.startswith(_HDF5_MARK) or head[_HDF5_OFFSET:] == _HDF5_MARK
    return _read_hdf5(request) if is_hdf5 else _read_mat(request)


def _read_mat(request: Request) -> Recorded:
    from scipy.io import loadmat, whosmat

    variables = whosmat(request.path)
    times = Counter(name for name, _, _ in variables)

    for name, shape, kind in variables:
        if kind in _NUMBERS:  # of a byte each, compressed
            what = f"values in variable {name!r}"
            check_claim(request.path, math.prod(shape), 1, what, DEFLATE_RATIO)

    @cache
    def loaded(name: str) -> Any:
        wanted = [name] if times[name] == 1 else None  # by its name SciPy finds the first
        try:
            with warnings.catch_warnings(action="ignore"):
                return loadmat(request.path, variable_names=wanted, struct_as_record=False)[name]
        except Exception as error:  # on damaged bytes SciPy may raise anything
            shape = next(shape for each, shape, _ in variables if each == name)
            raise StorageError(
                f"variable {name!r} claims {shape} values that the file does not hold: {error}"
            ) from None

    def load(name: str, part: Part) -> Any:
        return loaded(name)[part]

    signals = [mat_struct(name, loaded(name)) for name, _, kind in variables if kind == "struct"]
    if signals := [struct for struct in signals if struct.is_signal]:
        return recorded_signals(signals, request)
    arrays: list[NamedArray] = []
    for name, shape, kind in {
        name: (name, *attributes) for name, *attributes in variables
    }.values():
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
    name : name of the struct
    struct : struct that SciPy reads: an array of objects with fields; of several each has its
        number
    depth : structs around it
    """
    if depth == _MAXIMUM_DEPTH:
        return []
    arrays = []
    for number, element in enumerate(struct.ravel(), 1):
        of_one = name if struct.size == 1 else f"{name}({number})"
        for field in getattr(element, "_fieldnames", ()):
            value = np.asarray(getattr(element, field))
            path = f"{of_one}.{field}"
            if value.dtype.kind in "iufc":
                arrays.append(NamedArray(path, value.shape, True, value.__getitem__))
            elif value.dtype.kind == "O":
                arrays += fields(path, value, depth + 1)
    return arrays


def mat_struct(name: str, struct: Any) -> Struct:
    """A struct as SciPy reads it, by the paths of its fields."""
    prefix = f"{name}."
    numbers = {array.name.removeprefix(prefix): array for array in fields(name, struct)}

    def texts(path: str) -> list[str]:
        value: Any = struct
        for field in path.split("."):
            items = np.asarray(value).ravel()
            value = getattr(items[0], field, "") if items.size else ""
        return [as_text(cell) for cell in np.asarray(_cells(value)).ravel()]

    return Struct(name, numbers, texts)


def _cells(value: Any) -> list[Any]:
    """Contents of a cell, and of the cells in it; of anything else itself."""
    array = np.asarray(value)
    if array.dtype.kind == "O":
        return [text for cell in array.ravel() for text in _cells(cell)]
    return array.ravel().tolist() if array.dtype.kind in "US" else []


def _read_hdf5(request: Request) -> Recorded:
    import h5py

    with h5py.File(request.path, "r", rdcc_nbytes=CHUNK_CACHE_BYTES) as file:
        arrays = [
            replace(named_dataset(name, dataset), name=name.replace("/", "."))
            for name, dataset in datasets(file)
            if not name.startswith("#")  # what cells refer to
            and as_text(dataset.attrs.get("MATLAB_class", "")) in _NUMBERS
        ]
        signals = [hdf5_struct(name, arrays, file) for name in file if not name.startswith("#")]
        if signals := [struct for struct in signals if struct.is_signal]:
            return recorded_signals(signals, request)
        _check_numbers(arrays, [name for name in file if not name.startswith("#")])
        return recorded(arrays, {}, request)


def hdf5_struct(name: str, arrays: list[NamedArray], file: Any) -> Struct:
    """A struct of a MAT file 7.3, by the paths of its fields."""
    prefix = f"{name}."
    numbers = {a.name.removeprefix(prefix): a for a in arrays if a.name.startswith(prefix)}

    def texts(path: str) -> list[str]:
        item = file.get(f"{name}/{path.replace('.', '/')}")
        return [] if not hasattr(item, "shape") else _hdf5_texts(item, file)

    return Struct(name, numbers, texts)


def _hdf5_texts(dataset: Any, file: Any) -> list[str]:
    """Texts of characters that MATLAB stores as numbers, or of a cell of references to them."""
    check_size(0, dataset.size)
    stored = dataset[()]
    if dataset.dtype.kind == "O":
        return [text for cell in stored.ravel() for text in _hdf5_texts(file[cell], file)]
    return ["".join(map(chr, stored.ravel()))] if dataset.dtype == np.uint16 else []


def _check_numbers(arrays: list[NamedArray], variables: list[str]) -> None:
    if not any(array.may_be_channels for array in arrays):
        raise ParameterError(
            f"holds no vector of numbers; its variables: {listed(variables)}; "
            "save the channels as vectors, tables or fields of a struct"
        )


register(Reader("mat", (".mat",), "MAT", read))
