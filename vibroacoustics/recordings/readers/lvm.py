"""LVM: LabVIEW measurement files, text with a header of the file and of each segment."""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import BinaryIO, Final

import numpy as np

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..claims import check_claim
from ..lvm_head import END, Segment, file_header, segment
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size, listed, numbered
from ..text_lines import last_lines, lines, may_be_cut, opened
from ..time_axis import even_rate_hz

_JOINT: Final = 0.5
"""Sampling intervals by which the start of a segment may differ from the end of the one before."""


@dataclass(frozen=True)
class _Rows:
    """Numbers of one segment, shape (row, column); the times come first where there are any."""

    head: Segment
    values: Samples


def read(request: Request) -> Recorded:
    """Channels of a LabVIEW measurement file; segments that follow one another are joined.

    Raises
    ------
    ParameterError
        The abscissa is not the time, channels differ in length, times are not even, or segments
        have gaps between them.
    StorageError
        The file is truncated or damaged.
    """
    with opened(request.path) as file:
        segments = list(_segments(file, request))
        if not segments:
            raise StorageError("has no segment")
        _check_end(file, segments[-1])
    first = segments[0].head
    _check_alike(segments)
    values = np.concatenate([part.values for part in segments])
    names = numbered(first.names)
    chosen = request.chosen(names)
    begin = int(first.time_column is not None)
    return Recorded(
        names=[names[c] for c in chosen],
        units=[first.units[c] for c in chosen],
        samples=[values[:, begin + number] for number in range(len(chosen))],
        sample_rate_hz=_rate_hz(first, values, request),
        start_time=first.start_time,
        remarks=_remarks(segments, request),
    )


def _remarks(segments: list[_Rows], request: Request) -> list[str]:
    head, rows = segments[0].head, len(segments[0].values)
    is_rounded = request.sample_rate_hz is None and head.time_column is None
    remarks = head.remarks if is_rounded else []
    if head.time_column is None and rows > max(head.samples):
        remarks.append(
            f"holds {rows} rows below a header of {max(head.samples)} samples: blocks without "
            "headers of their own are joined"
        )
    return remarks


def _segments(file: BinaryIO, request: Request) -> Iterator[_Rows]:
    file.seek(0)
    below = lines(file)
    above = file_header(below)
    while (head := segment(below, above)) is not None:
        chosen = request.chosen(numbered(head.names))
        columns = [head.columns[c] for c in chosen]
        claimed = [head.samples[c] for c in chosen]
        if len(set(claimed)) != 1:
            named = [f"{head.names[c]} {head.samples[c]}" for c in chosen]
            raise ParameterError(f"channels differ in length ({listed(named)}): choose some alike")
        check_claim(request.path, claimed[0], len(columns))  # of a byte each, the one behind it
        check_size(len(columns), claimed[0])
        times = [] if head.time_column is None else [head.time_column]
        values = _numbers(below, head, [*times, *columns])
        if len(values) < claimed[0]:
            raise StorageError(
                f"is truncated: a segment holds {len(values)} of {claimed[0]} samples"
            )
        yield _Rows(head, values)


def _numbers(below: Iterator[bytes], head: Segment, columns: list[int]) -> Samples:
    try:
        with warnings.catch_warnings(action="ignore"):  # no row at all is refused by the caller
            values: Samples = np.loadtxt(
                _row_texts(below, head, max(columns)),
                delimiter=head.separator, comments=None, ndmin=2, usecols=columns,
            )  # fmt: skip
    except ValueError as error:
        reason = str(error).split("; use `")[0]
        raise StorageError(f"below the header of a segment: {reason}") from None
    check_size(len(columns), len(values))
    return values.reshape(-1, len(columns))


def _row_texts(below: Iterator[bytes], head: Segment, last: int) -> Iterator[str]:
    """Rows up to a blank line, with decimal points and without what is behind the last column."""
    for line in below:
        fields = head.fields(line)
        if not any(fields):
            return
        if fields[0].startswith(END) or len(fields) <= last:
            raise ValueError(f"row {line[:40]!r} has {len(fields)} columns, not {last + 1}")
        yield head.separator.join(field or "nan" for field in fields[: last + 1])


def _check_end(file: BinaryIO, last: _Rows) -> None:
    """Refuse a last row without an end, unless it has all digits of the rows before."""
    rows, has_end = last_lines(file, 0)
    texts = [last.head.fields(line) for _, line in rows[-len(last.values) :]]
    if not has_end and any(texts[-1]) and may_be_cut(texts):
        raise StorageError(
            "is truncated: its last row has no end and may be cut short: if it is whole, add the "
            "end of the line"
        )


def _check_alike(segments: list[_Rows]) -> None:
    """Refuse segments of other channels or rates, and gaps between them."""
    first = segments[0].head
    for before, behind in pairwise(segments):
        head = behind.head
        if (head.names, head.units, head.interval_s) != (
            first.names, first.units, first.interval_s
        ):  # fmt: skip
            raise ParameterError(
                f"its {len(segments)} segments differ in channels, units or sample rate: save "
                "each as a file"
            )
        end_s = before.head.start_s + len(before.values) * first.interval_s
        if not abs(head.start_s - end_s) <= _JOINT * first.interval_s:
            raise ParameterError(
                f"its {len(segments)} segments are not one after the other: one starts "
                f"{head.start_s - end_s:.6g} s behind the end of another; save each as a file"
            )


def _rate_hz(head: Segment, values: Samples, request: Request) -> float:
    """Sample rate of `Delta_X`, which the times must agree with, or else that of the times."""
    if head.time_column is None or request.sample_rate_hz is not None:
        return request.sample_rate_hz or 1.0 / head.interval_s
    rate_hz = even_rate_hz(values[:, 0], request)
    stated_hz = 1.0 / head.interval_s
    agree = abs(stated_hz / rate_hz - 1.0) * len(values) <= 1.0
    return stated_hz if agree else rate_hz


register(Reader("lvm", (".lvm",), "LVM (LabVIEW measurement)", read))
