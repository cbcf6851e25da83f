"""Headers of datasets 58 and 58b of a universal file, and where their values are.

Source: SDRC, "Universal dataset number 58, function at nodal DOF", and 58b. Lines may lack their
trailing blanks and end in CR LF, as many programs write them.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import BinaryIO, Final

from ..base.errors import StorageError
from .claims import check_claim

LONGEST_LINE: Final = 2**12
SINGLE, DOUBLE, SINGLE_COMPLEX, DOUBLE_COMPLEX = 2, 4, 5, 6
"""Ordinate data types, record 7, field 1: real; 5 and 6 are complex."""
EVEN_SPACING: Final = 1
"""Abscissa spacing, record 7, field 3."""
_FUNCTION: Final = 58
_MARK: Final = re.compile(rb" {4}-1\s*")
_NUMBER: Final = re.compile(rb" {0,5}\d{1,6}(b.*)?\s*", re.DOTALL)
"""Line with the number of a dataset."""
_IEEE: Final = 2
"""Floating point format, record 1, field 4 of a dataset 58b."""
_BYTE_ORDERS: Final = {1: "<", 2: ">"}
_LABEL, _UNIT = slice(26, 46), slice(47, 67)
"""Columns of record 9: format I10, 3I5, 2(1X, 20A1)."""
_MINIMUM, _INCREMENT = slice(30, 43), slice(43, 56)
"""Columns of record 7: format 3I10, 3E13.5."""


@dataclass(frozen=True)
class Header:
    """Header of a dataset 58.

    Attributes
    ----------
    function_type : 1 for a time response
    name : id line 1, else response entity, else label of the ordinate; may be empty
    start_time : id line 3
    unit : unit of the ordinate
    ordinate_type : 2 and 4 real, 5 and 6 complex, single and double precision
    points : number of points of the abscissa
    is_even : whether the abscissa has even spacing
    increment : increment of the abscissa, where it has one
    minimum : first value of an even abscissa
    byte_order : `<` or `>`; empty for text
    start : place of the first value in the file
    abscissa_bytes : bytes of each abscissa of binary values; 0 where there is none
    records : the eleven lines as they are
    pair_columns : columns of a line of text of uneven abscissas, where they are all as wide as the
        ordinates, as some programs write them; 0 where they are narrower, as specified
    """

    function_type: int
    name: str
    start_time: str
    unit: str
    ordinate_type: int
    points: int
    is_even: bool
    increment: float
    minimum: float
    byte_order: str
    start: int
    abscissa_bytes: int
    records: tuple[str, ...]
    pair_columns: int = 0

    @property
    def axis_type(self) -> int:
        """Specific data type of the abscissa, record 8, field 1."""
        return _integer(self.records[7][:10].strip() or "0", "abscissa data type")

    @property
    def axis_unit(self) -> str:
        """Unit label of the abscissa; empty where there is none."""
        return _given(self.records[7][_UNIT])

    @property
    def numbers(self) -> int:
        """Numbers that the dataset holds: x too where the abscissa is uneven."""
        return self.points * (self.parts if self.is_even else self.parts + 1)

    @property
    def parts(self) -> int:
        """Numbers of an ordinate: two where it is complex."""
        return 1 if self.ordinate_type in (SINGLE, DOUBLE) else 2

    @property
    def ordinate_bytes(self) -> int:
        """Bytes of each number of a binary ordinate."""
        return 4 if self.ordinate_type in (SINGLE, SINGLE_COMPLEX) else 8

    @property
    def binary_bytes(self) -> int:
        """Bytes of all binary values."""
        return self.points * (self.abscissa_bytes + self.parts * self.ordinate_bytes)

    @property
    def widths(self) -> tuple[int, ...]:
        """Columns of a line of text: 6E13.5, 4E20.12, 2(E13.5, E20.12) or E13.5, 2E20.12."""
        if self.ordinate_type in (SINGLE, SINGLE_COMPLEX):
            return (13,) * 6
        if self.is_even:
            return (20,) * 4
        if self.pair_columns:
            return (20,) * (self.pair_columns // 20)
        return (13, 20) * 2 if self.parts == 1 else (13, 20, 20)

    @property
    def per_line(self) -> int:
        """Numbers in a line of text."""
        return len(self.widths)


@dataclass(frozen=True)
class Datasets:
    """Datasets of a universal file.

    Attributes
    ----------
    functions : headers of the datasets 58
    kinds : numbers of all datasets
    remarks : a line for each -1 that is missing or too many
    """

    functions: list[Header]
    kinds: list[int]
    remarks: list[str]


def datasets(file: BinaryIO) -> Datasets:
    """Datasets of a universal file, each between two lines -1.

    The number of a dataset follows the -1 that opens it, so that a -1 too many or a missing one is
    recognised.

    Raises
    ------
    StorageError
        There is no dataset, or the last one is not closed: the file is truncated.
    """
    functions: list[Header] = []
    kinds: list[int] = []
    remarks, is_open = [], False
    file.seek(0)
    while is_open or _goes_on_to_mark(file):
        kind = next((line for line in _lines(file) if line.strip()), b"")
        is_open = _MARK.fullmatch(kind) is not None
        if is_open or not kind:
            remarks.append(_orphan(kinds))
            continue
        kinds.append(_integer(kind[:6], "dataset"))
        if kinds[-1] == _FUNCTION:
            functions.append(_header(file, kind))
            _skip_values(file, functions[-1], kind)
        if not _goes_on_to_mark(file):
            raise StorageError(f"its last dataset, {kinds[-1]}, has no end: truncated")
        is_open = _number_follows(file)
        if is_open:
            remarks.append(_orphan(kinds))
    if not kinds:
        raise StorageError("is no universal file: it holds no dataset")
    return Datasets(functions, kinds, remarks)


def _orphan(kinds: list[int]) -> str:
    where = f"after dataset number {len(kinds)} ({kinds[-1]})" if kinds else "before all datasets"
    return f"{where} there is a line -1 without its pair: a function may be missing"


def _number_follows(file: BinaryIO) -> bool:
    """Whether the next line is the number of a dataset, which stays to be read."""
    here = file.tell()
    line = file.readline(LONGEST_LINE)
    file.seek(here)
    return _NUMBER.fullmatch(line) is not None


def _lines(file: BinaryIO) -> Iterator[bytes]:
    return iter(lambda: file.readline(LONGEST_LINE), b"")


def _goes_on_to_mark(file: BinaryIO) -> bool:
    return any(_MARK.fullmatch(line) for line in _lines(file))


def _header(file: BinaryIO, kind: bytes) -> Header:
    records = [_text(file.readline(LONGEST_LINE)) for _ in range(11)]
    numbers = records[6]
    header = Header(
        function_type=_integer(records[5][:5], "function type"),
        name=_given(records[0]) or _given(records[5][31:41]) or _given(records[8][_LABEL]),
        start_time=_given(records[2]),
        unit=_given(records[8][_UNIT]),
        ordinate_type=_integer(numbers[:10], "ordinate data type"),
        points=_integer(numbers[10:20], "number of points"),
        is_even=_integer(numbers[20:30], "abscissa spacing") == EVEN_SPACING,
        increment=_number(numbers[_INCREMENT], "abscissa increment"),
        minimum=_number(numbers[_MINIMUM], "abscissa minimum"),
        byte_order=_byte_order(kind),
        start=file.tell(),
        abscissa_bytes=0,
        records=tuple(record.rstrip("\r\n") for record in records),
    )
    least = header.parts * header.ordinate_bytes if header.byte_order else 2 * header.parts
    check_claim(Path(file.name), header.points, least, f"points in dataset {header.name!r}")
    if header.is_even:
        return header
    return _with_abscissas(file, header) if header.byte_order else _with_pairs(file, header)


def _with_pairs(file: BinaryIO, header: Header) -> Header:
    """Header with the width of a line where the columns are all of E20.12."""
    if header.ordinate_type != DOUBLE:
        return header
    columns = len(file.readline(LONGEST_LINE).rstrip())
    file.seek(header.start)
    return replace(header, pair_columns=columns) if columns in (40, 80) else header


def _with_abscissas(file: BinaryIO, header: Header) -> Header:
    """Header with abscissas of the precision that ends at the mark; programs differ in it."""
    header = replace(header, abscissa_bytes=4)
    double = replace(header, abscissa_bytes=8)
    file.seek(header.start + double.binary_bytes)
    ends = _MARK.match(file.read(16).lstrip(b"\r\n"))
    file.seek(header.start)
    return double if ends else header


def _byte_order(kind: bytes) -> str:
    """Order of the bytes of a dataset 58b, empty for text; format I6, A1, 2I6, 2I12."""
    if kind[6:7] != b"b":
        return ""
    order, form = (
        _integer(kind[7:13], "byte ordering"),
        _integer(kind[13:19], "floating point format"),
    )
    if order not in _BYTE_ORDERS or form != _IEEE:
        raise StorageError(f"dataset 58b: byte ordering {order}, format {form}: only IEEE is known")
    return _BYTE_ORDERS[order]


def _skip_values(file: BinaryIO, header: Header, kind: bytes) -> None:
    """Go to the last line of the values, or stay where the lines are not of one length."""
    if header.byte_order:
        stated = _integer(kind[31:43], "number of bytes")  # some programs count half
        file.seek(header.start + max(stated, header.binary_bytes))
        return
    length = len(file.readline(LONGEST_LINE))
    last = header.start + (-(-header.numbers // header.per_line) - 1) * length
    file.seek(max(header.start, last - 1))
    if file.read(1) != b"\n" or _MARK.fullmatch(file.readline(LONGEST_LINE)):
        file.seek(header.start)


def _integer(field: str | bytes, what: str) -> int:
    try:
        return int(field)
    except ValueError:
        raise StorageError(f"{what} {field!r}: is no number: damaged") from None


def _number(field: str, what: str) -> float:
    try:
        return float(field.replace("D", "E") or 0.0)
    except ValueError:
        raise StorageError(f"{what} {field!r}: is no number: damaged") from None


def _text(record: bytes) -> str:
    try:
        return record.decode("utf-8")
    except UnicodeDecodeError:
        return record.decode("latin-1")


def _given(text: str) -> str:
    """The text, empty where the file says NONE."""
    return "" if text.strip().upper() == "NONE" else text.strip()
