"""MAT: up to 7.2 by SciPy, 7.3 as HDF5. Variables are numbers; cells and structs are not read."""

from functools import cache, partial
from typing import Any, Final

from ...base.errors import ParameterError
from ...base.registry import register
from ..named_arrays import NamedArray, Part, as_text, recorded
from ..reader import Reader
from ..recorded import Recorded, Request, listed
from .hdf5 import datasets, named_dataset

_HDF5_MARK: Final = b"\x89HDF\r\n\x1a\n"
_HDF5_OFFSET: Final = 512  # a MATLAB header stands before it
_NUMBERS: Final = frozenset(
    {"double", "single"} | {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
)
"""MATLAB's classes of numbers."""


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

    @cache
    def loaded(name: str) -> Any:
        return loadmat(request.path, variable_names=[name])[name]

    def load(name: str, part: Part) -> Any:
        return loaded(name)[part]

    arrays = [
        NamedArray(name, shape, kind in _NUMBERS, partial(load, name))
        for name, shape, kind in variables
    ]
    _check_numbers(arrays, [f"{name} ({kind})" for name, _, kind in variables])
    return recorded(arrays, {}, request)


def _read_hdf5(request: Request) -> Recorded:
    import h5py

    with h5py.File(request.path, "r") as file:
        arrays = [
            named_dataset(name, dataset)
            for name, dataset in datasets(file)
            if "/" not in name and as_text(dataset.attrs.get("MATLAB_class", "")) in _NUMBERS
        ]
        _check_numbers(arrays, [name for name in file if not name.startswith("#")])
        return recorded(arrays, {}, request)


def _check_numbers(arrays: list[NamedArray], variables: list[str]) -> None:
    if not any(array.may_be_channels for array in arrays):
        raise ParameterError(
            f"holds no vector of numbers; its variables: {listed(variables)}; "
            "save the channels as plain vectors"
        )


register(Reader("mat", (".mat",), "MAT", read))
