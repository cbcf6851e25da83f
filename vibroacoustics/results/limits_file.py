"""Limits of orders from a CSV file, a line each."""

import csv
from collections.abc import Iterator, Mapping, Sequence
from math import inf
from pathlib import Path
from typing import Final

from ..base.errors import ParameterError, StorageError
from ..base.regular_file import read_text
from .limit import Limit

REQUIRED: Final = ("channel", "order", "limit", "unit")
SPEEDS: Final = {"speed_from_rpm": 0.0, "speed_to_rpm": inf}
"""Columns that may be missing or empty, and what then holds."""
COMMENT: Final = "#"
MAXIMUM_BYTES: Final = 1_000_000


def read_limits(path: str | Path) -> tuple[Limit, ...]:
    """Read limits of orders from a CSV file.

    Its header is `channel,order,limit,unit`, further columns may be
    `speed_from_rpm,speed_to_rpm`. Lines that begin with `#` are comments.

    Parameters
    ----------
    path : CSV file; see `Limit` for its columns. Limits are RMS

    Returns
    -------
    a limit for each line, for `check_limits`

    Raises
    ------
    ParameterError
        A column is missing or unknown, or a value is outside its range.
    StorageError
        The file cannot be read, is no text, or is larger than a megabyte.

    Examples
    --------
    >>> rows = ["# test stand 2", "channel,order,limit,unit", "*,1,60,dB", "ring,2,0.5,m/s²"]
    >>> np.savetxt("limits.csv", rows, fmt="%s", encoding="utf-8")
    >>> limits = va.read_limits("limits.csv")
    >>> limits[1].channel, limits[1].order, limits[1].limit, limits[1].unit
    ('ring', 2.0, 0.5, 'm/s²')
    """
    rows = _rows(_text(Path(path)), path)
    line, header = next(rows, (0, []))
    if not header:
        raise ParameterError(f"{path}: is empty: must begin with {','.join(REQUIRED)}")
    _check_header(header, f"{path}: line {line}")
    limits = tuple(_limit(header, row, f"{path}: line {number}") for number, row in rows)
    if not limits:
        raise ParameterError(f"{path}: holds no limit below its header")
    return limits


def _text(path: Path) -> str:
    try:
        return read_text(path, MAXIMUM_BYTES)
    except FileNotFoundError:
        raise StorageError(f"{path}: no such file") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "is no text in UTF-8"
        raise StorageError(f"{path}: cannot be read: {reason}") from None


def _rows(text: str, path: str | Path) -> Iterator[tuple[int, list[str]]]:
    """Number and fields of each line that is neither empty nor a comment."""
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() and not line.startswith(COMMENT):
            try:
                (fields,) = csv.reader([line], strict=True)
            except csv.Error as error:
                raise ParameterError(f"{path}: line {number}: cannot be split: {error}") from None
            yield number, [field.strip() for field in fields]


def _check_header(header: Sequence[str], where: str) -> None:
    allowed = f"must be {','.join(REQUIRED)} and may be {','.join(SPEEDS)}, each once"
    for name in header:
        if name not in (*REQUIRED, *SPEEDS) or header.count(name) > 1:
            raise ParameterError(f"{where}: column {name!r}: the header {allowed}")
    for name in REQUIRED:
        if name not in header:
            raise ParameterError(f"{where}: column {name!r} is missing: the header {allowed}")


def _limit(header: Sequence[str], row: Sequence[str], where: str) -> Limit:
    if len(row) != len(header):
        raise ParameterError(f"{where}: has {len(row)} fields, the header {len(header)}")
    fields = dict(zip(header, row, strict=True))
    speeds = {
        name: _number(fields, name, where) if fields.get(name) else absent
        for name, absent in SPEEDS.items()
    }
    return Limit(
        fields["channel"],
        _number(fields, "order", where),
        _number(fields, "limit", where),
        fields["unit"],
        **speeds,
        origin=where,
    )


def _number(fields: Mapping[str, str], name: str, where: str) -> float:
    try:
        return float(fields[name])
    except ValueError:
        raise ParameterError(f"{where}: {name} = {fields[name]!r}: must be a number") from None
