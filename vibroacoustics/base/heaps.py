"""Global heaps of an HDF5 file, checked before HDF5 reads them.

HDF5 File Format Specification, version 3.0, III.E: a collection `GCOL` of a size, with objects of
index (2 bytes), count (2), nothing (4), size (8) and content in steps of 8 bytes; index 0 is free
space, whose size counts the 16 bytes before it.
"""

import re
import struct
from typing import Final

from .errors import StorageError

_COLLECTION: Final = re.compile(rb"GCOL\x01\0\0\0(.{8})", re.DOTALL)
_HEAD: Final = struct.Struct("<HHIQ")


def check_heaps(content: bytes) -> None:
    """Refuse a heap in which HDF5 would go round for ever: its free space has no size.

    Raises
    ------
    StorageError
        The file is damaged there.
    """
    for collection in _COLLECTION.finditer(content):
        (size,) = struct.unpack("<Q", collection[1])
        end = min(collection.start() + size, len(content))
        offset = collection.end()
        while offset + _HEAD.size <= end:
            index, _, _, length = _HEAD.unpack_from(content, offset)
            step = length if index == 0 else _HEAD.size + 8 * -(-length // 8)
            if step < _HEAD.size:
                raise StorageError("is no result file: a heap in it is damaged")
            offset += step
