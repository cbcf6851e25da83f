"""HDF5 and netCDF: datasets with the attributes `units` and `sample_rate_hz`, or our own form."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from itertools import count, product
from pathlib import Path
from typing import Any, Final

import numpy as np

from ...base.errors import StorageError
from ...base.registry import register
from ..array_recording import recorded
from ..claims import DEFLATE_RATIO, check_claim
from ..counts import is_factor
from ..named_arrays import UNIT_NAMES, NamedArray, Part, as_text, is_rate, is_start
from ..packing import PACKING_NAMES
from ..reader import Reader
from ..recorded import MAXIMUM_READING_BYTES, Recorded, Request, check_size

MAXIMUM_DATASETS: Final = 10_000
MAXIMUM_NAME: Final = 4096
"""Characters of a path: a chain of groups is not followed further."""
CHUNK_CACHE_BYTES: Final = 2**29
"""A chunk that does not fit is read value by value where one channel of several is wanted."""
_RATIOS: Final = {1: DEFLATE_RATIO, 2: 1, 3: 1, 5: 64, 32000: 88}
"""Most bytes by a byte, by filter: deflate, shuffle, checksum, n bits, LZF (264 bytes by 3)."""
_ANY_RATIO: Final = 2**16
"""Ratio of a filter that stores a constant in a few bytes."""
_NO_VARIABLE: Final = b"This is a netCDF dimension but not a netCDF variable"
_CLASSIC: Final = b"CDF"


def read(request: Request) -> Recorded:
    """Vectors and tables of numbers anywhere in an HDF5 or netCDF file."""
    with request.path.open("rb") as file:
        is_classic = file.read(3) == _CLASSIC
    return _read_classic(request) if is_classic else _read_hdf5(request)


def _read_hdf5(request: Request) -> Recorded:
    import h5py

    with h5py.File(request.path, "r", rdcc_nbytes=CHUNK_CACHE_BYTES) as file:
        arrays = [a for name, dataset in datasets(file) for a in _named_arrays(name, dataset)]
        return recorded(arrays, _plain(file.attrs), request)


def _named_arrays(name: str, dataset: Any) -> list[NamedArray]:
    """A dataset, or of one of records its fields, as `table.field`."""
    records = named_dataset(name, dataset)
    if dataset.dtype.names is None:
        return [records]
    fields = {field: dataset.dtype[field] for field in dataset.dtype.names}
    return [
        replace(
            records,
            name=f"{name}.{field}",
            shape=records.shape + kind.shape,
            is_number=kind.base.kind in "iuf",
            is_whole=kind.base.kind in "iu",
            load=partial(_field, records.load, field, len(records.shape)),
            check=partial(_check_field, records.check, len(records.shape)),
            dimensions=(),
        )
        for field, kind in fields.items()
    ]


def _field(load: Any, field: str, sides: int, part: Part) -> Any:
    return load(part[:sides])[field][(..., *part[sides:]) if part[sides:] else ...]


def _check_field(check: Any, sides: int, part: Part) -> None:
    check(part[:sides])


def datasets(file: Any) -> list[tuple[str, Any]]:
    """Path and dataset of all that an HDF5 file holds itself; links to others are not followed."""
    collected: list[tuple[str, Any]] = []
    visited = count()

    def collect(name: str, item: Any) -> None:
        if next(visited) == MAXIMUM_DATASETS or len(name) > MAXIMUM_NAME:
            raise StorageError(
                f"holds more than {MAXIMUM_DATASETS} datasets and groups, or too deep"
            )
        if hasattr(item, "shape") and not _is_dimension(item):
            collected.append((name, item))

    file.visititems(collect)
    return collected


def _is_dimension(dataset: Any) -> bool:
    """Whether it is a dimension of netCDF without values, such as a time that only has a length."""
    name = dataset.attrs.get("NAME", b"")
    return isinstance(name, bytes) and name.startswith(_NO_VARIABLE)


def named_dataset(name: str, dataset: Any) -> NamedArray:
    """An HDF5 dataset, whose values are read only if it is stored in full in this file.

    A dataset may claim any shape and store nothing of it: what is not stored would be read as its
    fill value. One that is stored elsewhere would make the file read another.
    """
    shape = tuple(int(side) for side in dataset.shape or ())

    def check(part: Part) -> None:
        if dataset.external or dataset.is_virtual:
            raise StorageError(f"dataset {name!r} is stored in another file: copy it into this one")
        if dataset.chunks is not None:
            _check_chunks(name, dataset, part)
        elif dataset.size:
            _check_piece(name, dataset)

    def load(part: Part) -> Any:
        check_size(0, int(np.prod([side.stop - side.start for side in part], dtype=float)))
        check(part)
        return dataset[part]

    kind = dataset.dtype.kind
    return NamedArray(
        name, shape, kind in "iuf", load, _attributes(dataset), check, _dimensions(dataset),
        kind in "iu",
    )  # fmt: skip


def _dimensions(dataset: Any) -> tuple[str, ...]:
    """Names of the coordinates of the dimensions; a dimension without one is empty."""
    if "DIMENSION_LIST" not in dataset.attrs:
        return ()
    return tuple(
        next((scale.name.lstrip("/") for scale in axis.values()), "") for axis in dataset.dims
    )


def _check_piece(name: str, dataset: Any) -> None:
    """Refuse a dataset in one piece of which some lies behind the end of the file."""
    if not dataset.id.get_storage_size():
        raise StorageError(f"dataset {name!r} claims {dataset.shape} values and stores none")
    _check_bytes(f"values in dataset {name!r}", dataset, dataset.size)


def _check_bytes(what: str, dataset: Any, values: int) -> None:
    plist = dataset.id.get_create_plist()
    filters = [plist.get_filter(number)[0] for number in range(plist.get_nfilters())]
    ratio = float(np.prod([_RATIOS.get(number, _ANY_RATIO) for number in filters]))
    check_claim(Path(dataset.file.filename), values, dataset.dtype.itemsize, what, ratio)


def _check_chunks(name: str, dataset: Any, part: Part) -> None:
    """Refuse a part of which not every chunk is stored."""
    if np.prod(dataset.chunks, dtype=float) * dataset.dtype.itemsize > MAXIMUM_READING_BYTES:
        raise StorageError(f"dataset {name!r} has chunks of {dataset.chunks}: too large")
    sides = list(zip(part, dataset.chunks, strict=True))
    needed = [range(s.start // c, -(-s.stop // c)) for s, c in sides]
    number = int(np.prod([len(along) for along in needed], dtype=float))
    stored = dataset.id.get_num_chunks()
    if stored >= number and number < _count_of_chunks(dataset):
        corners = product(
            *([n * c for n in along] for along, (_, c) in zip(needed, sides, strict=True))
        )
        stored = sum(dataset.id.get_chunk_info_by_coord(corner).size > 0 for corner in corners)
    if stored < number:
        raise StorageError(f"dataset {name!r} is incomplete: {stored} of {number} chunks stored")
    values = number * int(np.prod(dataset.chunks, dtype=float))
    _check_bytes(f"values in the chunks of dataset {name!r}", dataset, values)


def _count_of_chunks(dataset: Any) -> int:
    sides = zip(dataset.shape, dataset.chunks, strict=True)
    return int(np.prod([-(-side // chunk) for side, chunk in sides], dtype=float))


def _attributes(dataset: Any) -> Mapping[str, Any]:
    """Attributes of a dataset, and the sample rate of its group where it has none itself."""
    of_dataset = _plain(dataset.attrs)
    if any(map(is_rate, of_dataset)) or dataset.parent.name == "/":
        return of_dataset
    of_group = _plain(dataset.parent.attrs)
    return {name: value for name, value in of_group.items() if is_rate(name)} | dict(of_dataset)


def _plain(attributes: Any) -> Mapping[str, Any]:
    """The attributes that we know; others may be of types that cannot be read."""
    wanted = (*UNIT_NAMES, *PACKING_NAMES, "start_time", "wf_increment", "wf_start_time")
    return {
        name: attributes[name]
        for name in attributes
        if name in wanted or is_rate(name) or is_start(name) or is_factor(name)
    }


def _read_classic(request: Request) -> Recorded:
    """Netcdf up to version 3, which is no HDF5; the file is mapped, so nothing is allocated."""
    from scipy.io import netcdf_file

    try:
        classic = netcdf_file(request.path, "r", mmap=True, maskandscale=False)
    except ValueError as error:
        size = request.path.stat().st_size
        raise StorageError(f"claims more values than its {size} bytes can hold: {error}") from None
    with classic as file:
        arrays = [
            NamedArray(
                as_text(name),
                tuple(variable.data.shape),
                variable.data.dtype.kind in "iuf",
                partial(_part_of, variable.data),
                variable._attributes,
                dimensions=tuple(map(as_text, variable.dimensions)),
                is_whole=variable.data.dtype.kind in "iu",
            )
            for name, variable in file.variables.items()
        ]
        return recorded(arrays, file._attributes, request)


def _part_of(values: Any, part: Part) -> Any:
    return np.array(values[part])


register(Reader("hdf5", (".h5", ".hdf5", ".nc", ".nc4"), "HDF5 and netCDF", read))
