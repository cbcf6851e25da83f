"""Lines of a text file: of any Unicode, its unfinished end, the line with a value."""

import os
import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, Final

from ..base.csv_form import narrow_text, wide_encoding
from ..base.errors import StorageError

MAXIMUM_LINE_BYTES: Final = 2**16
_PIECE: Final = 2**20
_LAST_LINES: Final = 20


@contextmanager
def opened(path: Path) -> Iterator[BinaryIO]:
    """A text file as bytes of which a line feed is one; UTF-16 is put into UTF-8."""
    with path.open("rb") as file:
        encoding = wide_encoding(file.read(64))
        if encoding is None:
            file.seek(0)
            yield file
            return
    with path.open(encoding=encoding, newline="") as wide, tempfile.TemporaryFile() as narrow:
        while piece := wide.read(_PIECE):
            narrow.write(piece.encode())
        narrow.seek(0)
        yield narrow


def lines(file: BinaryIO) -> Iterator[bytes]:
    """Lines from where the file is.

    Raises
    ------
    StorageError
        A line is longer than any table has.
    """
    number = 0
    while line := file.readline(MAXIMUM_LINE_BYTES):
        number += 1
        if len(line) == MAXIMUM_LINE_BYTES:
            raise StorageError(f"line {number} is longer than {MAXIMUM_LINE_BYTES} bytes")
        yield line


def text(line: bytes) -> str:
    """A line as text."""
    return narrow_text(line)


def last_lines(file: BinaryIO, begin: int) -> tuple[list[tuple[int, bytes]], bool]:
    """Places and content of the last lines, and whether the last one has its end.

    Parameters
    ----------
    file : to look at
    begin : place of the first line that counts
    """
    size = file.seek(0, os.SEEK_END)
    start = max(begin, size - 2 * MAXIMUM_LINE_BYTES)
    file.seek(start)
    content = file.read()
    placed, position = [], start
    for line in content.splitlines(keepends=True):
        placed.append((position, line))
        position += len(line)
    return placed[-_LAST_LINES:], content.endswith((b"\n", b"\r"))


def may_be_cut(rows: Sequence[Sequence[str]]) -> bool:
    """Whether the last row, which has no end, may lack columns, or digits of its last number.

    It is whole where every row has as many digits behind the decimal point, and of an exponent.

    Parameters
    ----------
    rows : cells of the last rows, numbers with decimal points
    """
    if len(rows) < 2 or len({len(row) for row in rows}) > 1:
        return True
    forms = {re.sub(r"\d", "0", row[-1].partition(".")[2]) for row in rows}
    return len(forms) > 1 or not forms.pop()


def reached(
    file: BinaryIO, begin: int, end: int, value: Callable[[bytes], float], wanted: float
) -> int:
    """Place of the first line whose value is not below the wanted one; values must grow.

    Parameters
    ----------
    file : to look at, by halving
    begin, end : places of the first line, and behind the last
    value : value of a line
    wanted : least value
    """
    low, high = begin, end
    while low < high:
        middle = (low + high) // 2
        start, line = _line_at(file, middle, begin)
        if not line or start >= high:
            high = middle
        elif value(line) < wanted:
            low = start + len(line)
        else:
            high = middle if start > middle else start
    return low


def _line_at(file: BinaryIO, position: int, begin: int) -> tuple[int, bytes]:
    """The first line that begins at a place or behind it."""
    if position > begin:
        file.seek(position - 1)
        file.readline()
    else:
        file.seek(begin)
    start = file.tell()
    return start, file.readline(MAXIMUM_LINE_BYTES)
