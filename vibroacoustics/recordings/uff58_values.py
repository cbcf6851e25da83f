"""Values of a dataset 58 or 58b: of the points that are wanted alone."""

from typing import BinaryIO, Final

import numpy as np
from numpy.typing import NDArray

from ..base.errors import StorageError
from .recorded import Samples
from .uff58 import LONGEST_LINE, Header

_EXPONENTS: Final = bytes.maketrans(b"Dd", b"EE")
_TRUNCATED: Final = "a dataset 58 holds fewer samples than its header says: truncated"


def values(file: BinaryIO, header: Header, first: int, last: int) -> tuple[Samples, Samples | None]:
    """Ordinates from one point up to, but not with, another, and their abscissas where uneven."""
    if header.byte_order:
        return _binary(file, header, first, last)
    per_point = 1 if header.is_even else 2
    numbers = _text(file, header, first * per_point, last * per_point)
    return (numbers, None) if header.is_even else (numbers[1::2], numbers[::2])


def ordinates(file: BinaryIO, header: Header) -> tuple[Samples, Samples | None]:
    """All ordinates, complex where they are, and their abscissas where uneven."""
    if header.byte_order:
        numbers_of_points, abscissa = _binary(file, header, 0, header.points)
    else:
        numbers = _text(file, header, 0, header.numbers).reshape(header.points, -1)
        abscissa = None if header.is_even else numbers[:, 0]
        numbers_of_points = numbers[:, -header.parts :]
    if header.parts == 1:
        return numbers_of_points.astype(float).reshape(-1), abscissa
    pairs = numbers_of_points.astype(float)
    return pairs[:, 0] + 1j * pairs[:, 1], abscissa


def _binary(
    file: BinaryIO, header: Header, first: int, last: int
) -> tuple[Samples, Samples | None]:
    order, shape = header.byte_order, () if header.parts == 1 else (header.parts,)
    ordinate = ("y", f"{order}f{header.ordinate_bytes}", shape)
    abscissa = ("x", f"{order}f{header.abscissa_bytes}", ())
    kind = np.dtype([ordinate] if header.is_even else [abscissa, ordinate])
    file.seek(header.start + first * kind.itemsize)
    content = file.read((last - first) * kind.itemsize)
    if len(content) != (last - first) * kind.itemsize:
        raise StorageError(_TRUNCATED)
    points = np.frombuffer(content, kind)
    return points["y"], None if header.is_even else points["x"].astype(float)


def _text(file: BinaryIO, header: Header, first: int, last: int) -> Samples:
    """Numbers of a text; lines have one length, but where they have not all are read."""
    skipped = first // header.per_line
    lines = -(-last // header.per_line)
    file.seek(header.start)
    length = len(file.readline(LONGEST_LINE))
    file.seek(header.start + max(0, skipped * length - 1))
    if skipped and file.read(1) != b"\n":
        file.seek(header.start)
        skipped = 0
    elif not skipped:
        file.seek(header.start)
    content = [file.readline(LONGEST_LINE).rstrip() for _ in range(lines - skipped)]
    before = skipped * header.per_line
    return _numbers(content, header, last - before)[first - before :]


def _numbers(lines: list[bytes], header: Header, count: int) -> Samples:
    """The first numbers of some lines, in columns or else apart by blanks."""
    widths = header.widths
    ends = np.cumsum(widths)
    table = np.array([line.ljust(int(ends[-1])) for line in lines], dtype=f"S{ends[-1]}")
    table = table.reshape(-1, 1).view("S1")
    columns = [
        np.ascontiguousarray(table[:, end - width : end]).view(f"S{width}")[:, 0]
        for width, end in zip(widths, ends, strict=True)
    ]
    texts = np.stack([column.astype("S20") for column in columns], axis=1).ravel()[:count]
    try:
        return _floats(texts)
    except ValueError:
        texts = np.array(b" ".join(lines).split()[:count])
    try:
        numbers = _floats(texts)
    except ValueError:
        raise StorageError(_TRUNCATED) from None
    if numbers.size < count:
        raise StorageError(_TRUNCATED)
    return numbers


def _floats(texts: NDArray[np.bytes_]) -> Samples:
    """Numbers, whose exponents may be written with Fortran's D."""
    try:
        return texts.astype(float)
    except ValueError:
        pass
    return np.array([text.translate(_EXPONENTS) for text in texts], dtype=float)
