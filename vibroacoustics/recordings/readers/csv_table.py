"""CSV: columns `name [unit]`, one of them the time; comma, semicolon or tab; decimal comma."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any, BinaryIO, Final

import numpy as np

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..axes import line_of_times
from ..csv_head import BLANK, MISSING_TIME, Head, read_head, time_column
from ..quantities import time_factor
from ..reader import Reader
from ..recorded import MissingError, Recorded, Request, Samples, check_rate, check_size
from ..text_lines import MAXIMUM_LINE_BYTES, last_lines, lines, may_be_cut, opened, reached, text
from ..time_stamps import DAY_NS, stamp_ns, stamp_text

MAXIMUM_HEAD_LINES: Final = 200
_FREQUENCIES: Final = {"frequency", "freq", "freq.", "f", "frequenz", "fréquence"}
_HERTZ: Final = {"Hz", "kHz"}


@dataclass(frozen=True)
class _Table:
    """Rows of numbers: from a place in the file up to another."""

    file: BinaryIO
    head: Head
    begin: int
    end: int


def read(request: Request) -> Recorded:
    """Columns of a table; its time column gives the sample rate."""
    with opened(request.path) as file:
        head = read_head([text(line) for line in islice(lines(file), MAXIMUM_HEAD_LINES)], True)
        table, remarks = _complete(_Table(file, head, *_rows(file, head)))
        time = time_column(head)
        if time is None and head.names[0].lower() in _FREQUENCIES and head.units[0] in _HERTZ:
            raise ParameterError(
                f"column {head.names[0]!r} is in {head.units[0]}: a spectrum is no recording"
            )
        if time is not None and time != head.stamps and not head.units[time]:
            if head.is_headless and head.is_count and request.sample_rate_hz is None:
                raise MissingError("its first column counts the rows: give sample_rate_hz")
            remarks.append(f"{head.names[time]!r} states no unit and is taken as the time in s")
        names = [n for c, n in enumerate(head.names) if c not in (time, head.stamps)]
        columns = [c for c in range(len(head.names)) if c not in (time, head.stamps)]
        units = [head.units[column] for column in columns]
        remarks += request.omissions(names, units)
        columns = [columns[index] for index in request.chosen(names, units)]
        if time is None:
            part = _without_time(table, columns, request)
        else:
            part = _with_time(table, time, columns, request)
        start = "" if head.stamps is None else _field(_first_line(table), table, head.stamps)
    return Recorded(
        names=[head.names[column] for column in columns],
        units=[head.units[column] for column in columns],
        samples=part.samples,
        sample_rate_hz=part.rate_hz,
        start_time=stamp_text(start) if start else "",
        first_sample=part.first,
        remarks=[*remarks, *part.remarks],
    )


@dataclass(frozen=True)
class _Part:
    samples: list[Samples]
    rate_hz: float
    first: int | None
    remarks: Sequence[str] = ()


def _rows(file: BinaryIO, head: Head) -> tuple[int, int]:
    """Places of the first row of numbers, and behind the last."""
    file.seek(0)
    for _ in range(head.lines):
        file.readline(MAXIMUM_LINE_BYTES)
    begin = file.tell()
    return begin, file.seek(0, 2)


def _complete(table: _Table) -> tuple[_Table, list[str]]:
    """The table without a last row that was cut short, and a remark on it."""
    rows, has_end = last_lines(table.file, table.begin)
    if has_end or len(rows) < 2:
        return table, []
    begin, last = rows[-1]
    if not may_be_cut([_split(line, table.head) for _, line in rows if line.strip()]):
        return table, []
    remark = (
        f"its last row ({text(last)[:60]!r}) has no end and may be cut short: the file is "
        "truncated; that row is omitted"
    )
    return _Table(table.file, table.head, table.begin, begin), [remark]


def _split(line: bytes, head: Head) -> list[str]:
    try:
        return head.cells(text(line))
    except ValueError as error:
        raise StorageError(f"row {text(line)[:60]!r}: {error}") from None


def _field(line: bytes, table: _Table, column: int) -> str:
    fields = _split(line, table.head)
    if column >= len(fields):
        raise StorageError(f"row {text(line)[:60]!r}: has {len(fields)} columns")
    return fields[column]


def _first_line(table: _Table) -> bytes:
    table.file.seek(table.begin)
    return table.file.readline(MAXIMUM_LINE_BYTES)


def _with_time(table: _Table, time: int, columns: Sequence[int], request: Request) -> _Part:
    """The rows from one time to another, which are found by halving."""
    seconds = _clock(table, time)
    start = seconds(_field(_first_line(table), table, time))
    wanted = table
    if request.from_s is not None or request.to_s is not None:
        wanted = _between(table, lambda line: seconds(_field(line, table, time)), start, request)
    is_stamped = time == table.head.stamps
    values = _numbers(wanted, [time, *columns], {time: seconds} if is_stamped else {}, None)
    times: Samples = values[:, 0] * (
        1.0 if is_stamped else time_factor(table.head.units[time] or "s")
    )
    if is_stamped and stamp_ns(_field(_first_line(table), table, time)) < DAY_NS:
        times = np.unwrap(times, period=1e-9 * DAY_NS)  # a clock alone begins again at midnight
    names = [table.head.names[column] for column in columns]
    line = line_of_times(names, times, request, start)
    first = round((times[0] - start) * line.rate_hz)
    stored = [values[part[0] : part[1], n + 1] for n, part in enumerate(line.parts)]
    remarks = line.remarks([table.head.units[column] for column in columns], stored)
    first_or_all = first if request.samples is None else None
    return _Part(line.on_grid(stored), line.rate_hz, first_or_all, remarks)


def _between(
    table: _Table, seconds: Callable[[bytes], float], start: float, request: Request
) -> _Table:
    first_with = partial(reached, table.file, table.begin, table.end, seconds)
    table.file.seek(table.begin)
    two = [table.file.readline(MAXIMUM_LINE_BYTES) for _ in range(2)]
    half = 0.5 * (seconds(two[1]) - seconds(two[0]))  # the nearest sample counts
    first = table.begin if request.from_s is None else first_with(start + request.from_s - half)
    last = table.end if request.to_s is None else first_with(start + request.to_s - half)
    if first >= last:
        raise ParameterError(
            f"from_s = {request.from_s or 0.0:g} s: holds no samples; the recording ends before"
        )
    return _Table(table.file, table.head, first, last)


def _without_time(table: _Table, columns: Sequence[int], request: Request) -> _Part:
    rate_hz = request.sample_rate_hz
    if rate_hz is None:
        raise MissingError(MISSING_TIME)
    check_rate(rate_hz)
    rows = None if request.wants_all else request.part(2**62, rate_hz)
    values = _numbers(table, columns, {}, rows)
    first = None if rows is None else rows[0]
    return _Part([values[:, n] for n in range(len(columns))], rate_hz, first)


def _clock(table: _Table, time: int) -> Callable[[str], float]:
    """Seconds of a field of the time column; of time stamps since the first."""
    if time != table.head.stamps:
        factor = time_factor(table.head.units[time] or "s")
        return lambda field: float(field) * factor
    origin = stamp_ns(_field(_first_line(table), table, time))
    return lambda field: 1e-9 * (stamp_ns(field) - origin)


def _numbers(
    table: _Table,
    columns: Sequence[int],
    converters: Mapping[int | str, Callable[[str], Any]],
    rows: tuple[int, int] | None,
) -> Samples:
    """Numbers of some columns, shape (row, column)."""
    chosen = _row_texts(table) if rows is None else islice(_row_texts(table), *rows)
    try:
        values: Samples = np.loadtxt(
            chosen, delimiter=_joint(table.head), comments=None, ndmin=2, usecols=list(columns),
            converters=dict(converters) or None,
        )  # fmt: skip
    except ValueError as error:
        reason = str(error).split("; use `")[0]
        raise StorageError(f"below its {table.head.lines} header lines: {reason}") from None
    check_size(len(columns), len(values))
    return values


def _joint(head: Head) -> str:
    """Separator of the cells that are read; a date and its clock have a blank between them."""
    return "\t" if head.separator == BLANK and not head.is_plain else head.separator


def _row_texts(table: _Table) -> Iterator[str]:
    """Rows with a decimal point, all of the same number of columns."""
    table.file.seek(table.begin)
    position, row = table.begin, 0
    separator, separators = table.head.separator, len(table.head.names) - 1
    decimal = table.head.form.decimal
    other = {",": ".", ".": "," if separator != "," else "\0"}[decimal]
    while position < table.end and (line := table.file.readline(MAXIMUM_LINE_BYTES)):
        position += len(line)
        row += 1
        plain = line.decode("latin-1")
        if separator == BLANK and table.head.is_plain:
            plain = BLANK.join(plain.split())
        if not plain.strip():
            continue
        is_plain = table.head.is_plain and plain.count(separator) == separators
        if not is_plain or '"' in plain or other in plain:
            cells = table.head.cells(text(line))
            if len(cells) != separators + 1:
                raise ValueError(f"row {row} has {len(cells)} columns, not {separators + 1}")
            plain = _joint(table.head).join(cells)
        elif decimal == ",":
            plain = plain.replace(",", ".")
        yield plain


register(Reader("csv", (".csv", ".txt", ".tsv", ".prn"), "CSV", read))
