"""Headers of a LabVIEW measurement file: one of the file, one of each segment."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .text_lines import text

MARK: Final = "LabVIEW Measurement"
END: Final = "***End_of_Header***"
MAXIMUM_HEAD_LINES: Final = 200
_SEPARATORS: Final = {"Tab": "\t", "Comma": ","}
_TIMES: Final = ("", "time")
_DIGITS: Final = re.compile(r"\d[\deE+-]*")
_EXACT: Final = 1e-4
"""Relative rounding of `Delta_X` above which a remark is due."""


@dataclass(frozen=True)
class Segment:
    """Header of one segment.

    Attributes
    ----------
    names, units : names and units of the channels
    columns : columns of the channels among the fields of a row
    samples : number of samples of each channel, as the header claims
    interval : between samples of the first channel, as the header writes it
    intervals_s : intervals of the channels as numbers
    starts_s : time of the first sample of each channel, s since 1970 where the header states the
        date
    dates_s : date of each channel alone, s since 1970; 0 where the header states none
    start_time : ISO 8601; empty where it is not stated
    time_columns : column of the times of each channel; empty without any
    separator : separator of fields
    has_decimal_comma : whether numbers are written with one
    """

    names: Sequence[str]
    units: Sequence[str]
    columns: Sequence[int]
    samples: Sequence[int]
    interval: str
    intervals_s: Sequence[float]
    starts_s: Sequence[float]
    dates_s: Sequence[float]
    start_time: str
    time_columns: Sequence[int]
    separator: str
    has_decimal_comma: bool

    def fields(self, line: bytes) -> list[str]:
        """Fields of a row, with decimal points.

        Raises
        ------
        ValueError
            A number of a channel has another decimal sign than the header states, or may have one
            that separates fields too.
        """
        fields = text(line).strip("\r\n").split(self.separator)
        _check_columns(fields, self.columns, self.separator)
        if self.has_decimal_comma and any("." in field for field in fields[: self.columns[-1] + 1]):
            raise ValueError(
                f"row {line[:40]!r} has a decimal point, the header a comma: correct "
                "Decimal_Separator"
            )
        return [field.replace(",", ".") for field in fields] if self.has_decimal_comma else fields

    @property
    def interval_s(self) -> float:
        """Interval of the first channel."""
        return self.intervals_s[0]

    @property
    def start_s(self) -> float:
        """Time of the first sample of the first channel."""
        return self.starts_s[0]

    @property
    def remarks(self) -> list[str]:
        """Remarks for the user on the sampling interval."""
        digits = len(self.interval.lower().partition("e")[0].partition(".")[2])
        exponent = int(self.interval.lower().partition("e")[2] or 0)
        rounding = 0.5 * float(f"1e{exponent - digits}") / self.interval_s
        rate_hz = 1.0 / self.interval_s
        if rounding <= _EXACT or abs(rate_hz - round(rate_hz)) < 1e-6 * rate_hz:
            return []
        return [
            f"Delta_X = {self.interval} s is rounded: the sample rate of {rate_hz:.6g} Hz is "
            f"uncertain by {100.0 * rounding:.2g} %; give sample_rate_hz"
        ]


def file_header(lines: Iterator[bytes]) -> dict[str, str]:
    """Keys and values above the first segment.

    Raises
    ------
    StorageError
        The file does not begin as such a file does, or its header has no end.
    """
    first = text(next(lines, b""))
    if not first.startswith(MARK):
        raise StorageError(f"does not begin with {MARK!r}")
    rows = _rows_to_end(lines, "\t" if "\t" in first else None)
    return {row[0]: row[1] for row in rows if len(row) > 1}


def segment(lines: Iterator[bytes], above: dict[str, str]) -> Segment | None:
    """The header of the next segment; None at the end of the file.

    Parameters
    ----------
    lines : lines of the file, from behind the last row
    above : keys and values of the file's header

    Raises
    ------
    ParameterError
        The abscissa is not the time.
    StorageError
        The header is incomplete.
    """
    separator = _SEPARATORS.get(above.get("Separator", "Tab"), "\t")
    if separator == above.get("Decimal_Separator"):
        raise StorageError(
            "states the comma as Separator and as Decimal_Separator: fractions cannot be told from "
            "columns: save it with tabs"
        )
    rows = {row[0]: row for row in _rows_to_end(lines, separator) if any(row)}
    if not rows:
        return None
    names = [field.strip() for field in text(next(lines, b"")).rstrip("\r\n").split(separator)]
    columns = _columns(rows, names, above)
    head = _Cells(rows, columns)
    dimensions = {value.lower() for value in head.values("X_Dimension")}
    if not dimensions <= set(_TIMES):
        raise ParameterError(f"its abscissa is {sorted(dimensions)}, not Time")
    try:
        for key in ("Delta_X", "X0"):
            _check_columns(rows.get(key, []), columns, separator)
    except ValueError as error:
        raise StorageError(str(error)) from None
    is_comma = separator != "," and _is_comma(head, above)
    intervals = head.number_texts("Delta_X", is_comma)
    dates_s = [_date(head, channel)[1] for channel in range(len(columns))]
    offsets = head.number_texts("X0", is_comma)
    step = above.get("X_Columns", "One")
    return Segment(
        names=[names[column] for column in columns],
        units=head.values("Y_Unit_Label"),
        columns=columns,
        samples=[_count(value) for value in head.values("Samples")],
        interval=intervals[0],
        intervals_s=[_number("Delta_X", interval) for interval in intervals],
        starts_s=[
            date_s + _number("X0", offset or "0")
            for date_s, offset in zip(dates_s, offsets, strict=True)
        ],
        dates_s=dates_s,
        start_time=_date(head, 0)[0],
        time_columns=[] if step == "No" else [c - 1 if step == "Multi" else 0 for c in columns],
        separator=separator,
        has_decimal_comma=is_comma,
    )


@dataclass(frozen=True)
class _Cells:
    """Rows of a header, by their key, and the columns of the channels in them."""

    rows: dict[str, list[str]]
    columns: Sequence[int]

    def values(self, key: str) -> list[str]:
        """One text a channel; empty where the header has none."""
        row = self.rows.get(key, [])
        return [row[c].strip() if c < len(row) else "" for c in self.columns]

    def number_texts(self, key: str, is_comma: bool) -> list[str]:
        """Number of each channel; of one that states none that of the first that does."""
        values = self.values(key)
        shared = next((value for value in values if value), "")
        texts = [value or shared for value in values]
        return [text.replace(",", ".") for text in texts] if is_comma else texts


def _rows_to_end(lines: Iterator[bytes], separator: str | None) -> list[list[str]]:
    rows: list[list[str]] = []
    for number, line in enumerate(lines):
        plain = text(line).strip("\r\n")
        if plain.startswith(END):
            return rows
        if number == MAXIMUM_HEAD_LINES:
            break
        cells = re.split(r"[\t,]", plain, maxsplit=1) if separator is None else None
        rows.append(cells or plain.split(separator))
    if any(any(row) for row in rows):
        raise StorageError(f"its header has no end ({END})")
    return []


def _check_columns(fields: Sequence[str], columns: Sequence[int], separator: str) -> None:
    """Refuse digits behind the columns of the channels, where a comma separates."""
    behind = fields[columns[-1] + 1 :]
    if separator == "," and any(_DIGITS.fullmatch(field.strip()) for field in behind):
        raise ValueError(
            f"row {','.join(fields)[:40]!r} has digits behind its channels: commas seem to be both "
            "separators and decimal signs: save it with tabs"
        )


def _columns(rows: dict[str, list[str]], names: list[str], above: dict[str, str]) -> list[int]:
    """Columns of the channels in rows of the header and of the table alike."""
    channels = _count(rows.get("Channels", ["", ""])[1])
    step = 2 if above.get("X_Columns") == "Multi" else 1
    if not 0 < step * (channels - 1) + 1 < len(names):
        raise StorageError(f"claims {channels} channels and names {max(len(names) - 1, 0)}")
    return list(range(1, 1 + step * channels, step))


def _is_comma(head: _Cells, above: dict[str, str]) -> bool:
    """Whether numbers have a decimal comma; old files do not state it."""
    stated = above.get("Decimal_Separator")
    return "," in "".join(head.values("Delta_X")) if stated is None else stated == ","


def _count(value: str) -> int:
    if not value.isascii() or not value.isdigit() or len(value) > 18:
        raise StorageError(f"{value!r} is no number of channels or samples")
    return int(value)


def _number(key: str, value: str) -> float:
    try:
        number = float(value)
    except ValueError:
        raise StorageError(f"{key} {value!r} is no number") from None
    if not np.isfinite(number) or (key == "Delta_X" and not number > 0.0):
        raise StorageError(f"{key} = {value} s: must be above zero and finite")
    return number


def _date(head: _Cells, channel: int) -> tuple[str, float]:
    """Date and time of a channel in a segment: ISO 8601, and s since 1970."""
    dates, clocks = head.values("Date"), head.values("Time")
    date, clock = dates[channel] or dates[0], (clocks[channel] or clocks[0]).replace(",", ".")
    seconds, _, fraction = clock.partition(".")
    stamp = f"{date.replace('/', '-')}T{seconds}" + (f".{fraction[:6]}" if fraction else "")
    try:
        return stamp, float(np.datetime64(stamp, "us").astype(np.int64)) * 1e-6
    except ValueError:  # neither is needed to read the samples
        return "", 0.0
