"""LVM: LabVIEW measurement files, text with a header of the file and of each segment."""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import BinaryIO, Final

import numpy as np

from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ..axes import Axis, line_of
from ..claims import check_claim
from ..lvm_head import END, Segment, file_header, segment
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size, numbered
from ..text_lines import last_lines, lines, may_be_cut, opened
from ..time_axis import Times

_JOINT: Final = 0.5
"""Sampling intervals by which the start of a segment may differ from the end of the one before."""


@dataclass(frozen=True)
class _Rows:
    """Numbers of one segment.

    Attributes
    ----------
    head : its header
    values : numbers, shape (row, column); the times come first where there are any
    channels : places of the channels among those of the header
    times : columns of their times in the file, each once
    rows : rows of each channel
    """

    head: Segment
    values: Samples
    channels: Sequence[int]
    times: Sequence[int]
    rows: Sequence[int]


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
    _check_alike(segments)
    head, rows = segments[0].head, segments[0].rows
    names = numbered(head.names)
    chosen = segments[0].channels
    values = np.concatenate([part.values for part in segments])
    axes = _axes(segments, values, request)
    line = line_of([names[c] for c in chosen], axes, request.every)
    stored = [
        values[: rows[n] if len(segments) == 1 else None, len(segments[0].times) + n][slice(*part)]
        for n, part in enumerate(line.parts)
    ]
    units = [head.units[c] for c in chosen]
    omissions = request.omissions(names, head.units)
    remarks = [*_remarks(segments, request), *omissions]
    every = line.recorded([names[c] for c in chosen], units, stored, head.start_time, remarks)
    return replace(every, first_sample=None, total_samples=None)  # the part is cut later


def _axes(segments: list[_Rows], values: Samples, request: Request) -> list[Axis]:
    """Time axis of each channel, from the numbers of all segments, shape (row, column).

    The interval of the header counts where the times agree with it.
    """
    first = segments[0]
    head, chosen = first.head, first.channels
    if not first.times:
        origin_s = min(head.starts_s)
        made: dict[tuple[float, float, int], Axis] = {}
        axes = []
        for number, channel in enumerate(chosen):
            rate_hz = request.sample_rate_hz or 1.0 / head.intervals_s[channel]
            count = first.rows[number] if len(segments) == 1 else len(values)
            key = (rate_hz, head.starts_s[channel] - origin_s, count)
            axes.append(made.setdefault(key, Axis(count, rate_hz, key[1])))
        return axes
    origin_s = min(head.dates_s)
    by_column: dict[tuple[int, float, int], Axis] = {}
    axes = []
    for number, channel in enumerate(chosen):
        count = first.rows[number] if len(segments) == 1 else len(values)
        key = (head.time_columns[channel], head.dates_s[channel] - origin_s, count)
        if key not in by_column:
            times = values[:count, first.times.index(key[0])]
            stated_hz = _stated_hz(times, 1.0 / head.intervals_s[channel], request)
            by_column[key] = Axis(count, stated_hz, key[1], _slices(times))
        axes.append(by_column[key])
    return axes


def _slices(times: Samples) -> Times:
    return lambda first, last: times[first:last]


def _stated_hz(times: Samples, stated_hz: float, request: Request) -> float | None:
    """Sample rate of `Delta_X` where the times agree with it; else None."""
    if request.sample_rate_hz is not None or len(times) < 2 or not times[-1] > times[0]:
        return request.sample_rate_hz
    rate_hz = (len(times) - 1) / (times[-1] - times[0])
    return stated_hz if abs(stated_hz / rate_hz - 1.0) * len(times) <= 1.0 else None


def _remarks(segments: list[_Rows], request: Request) -> list[str]:
    head, rows = segments[0].head, len(segments[0].values)
    is_rounded = request.sample_rate_hz is None and not head.time_columns
    remarks = head.remarks if is_rounded else []
    if not head.time_columns and rows > max(head.samples):
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
        chosen = request.chosen(numbered(head.names), head.units)
        columns = [head.columns[c] for c in chosen]
        claimed = [head.samples[c] for c in chosen]
        check_claim(request.path, max(claimed), len(columns))  # of a byte each, the one behind it
        check_size(len(columns), max(claimed))
        times = sorted({head.time_columns[c] for c in chosen} if head.time_columns else ())
        values = _numbers(below, head, [*times, *columns])
        if len(values) < max(claimed):
            raise StorageError(
                f"is truncated: a segment holds {len(values)} of {max(claimed)} samples"
            )
        is_alike = len(set(claimed)) == 1
        yield _Rows(
            head, values, chosen, times, [len(values)] * len(claimed) if is_alike else claimed
        )


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
    if len(segments) > 1 and len(set(segments[0].rows)) > 1:
        raise ParameterError("has several segments of channels that differ in length")
    for before, behind in pairwise(segments):
        head = behind.head
        if (head.names, head.units, head.intervals_s) != (
            first.names, first.units, first.intervals_s
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


register(Reader("lvm", (".lvm",), "LVM (LabVIEW measurement)", read))
