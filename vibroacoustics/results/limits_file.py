"""Limits from a CSV file, a line each: of orders, or of all that `compare` knows."""

import csv
from collections.abc import Iterator, Mapping, Sequence
from math import inf
from pathlib import Path
from typing import Final

from ..base.errors import ParameterError, StorageError
from ..base.regular_file import read_text
from .figure_limit import HIGHEST, FigureLimit
from .limit import Limit

REQUIRED: Final = ("channel", "order", "limit", "unit")
SPEEDS: Final = {"speed_from_rpm": 0.0, "speed_to_rpm": inf}
"""Columns that may be missing or empty, and what then holds."""
OF_FIGURES: Final = ("channel", "order", "band_hz", "criterion", "side", *SPEEDS)
"""Columns that a file for `compare` may have beside limit and unit."""
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
    return tuple(
        _limit(_fields(header, row, where), where)
        for header, number, row in _lines(path, REQUIRED, tuple(SPEEDS))
        for where in [f"{path}: line {number}"]
    )


def read_figure_limits(path: str | Path) -> tuple[tuple[Limit, ...], tuple[FigureLimit, ...]]:
    """Read limits of orders and of other figures from a CSV file, as `compare` takes them.

    Its header has `limit,unit` and, each once and as needed, `channel, order, band_hz, criterion,
    side, speed_from_rpm, speed_to_rpm`. A line without order, band and criterion limits a total.

    Parameters
    ----------
    path : CSV file; see `FigureLimit` for its columns. Limits of orders are RMS

    Returns
    -------
    highest values of orders, and all other limits

    Raises
    ------
    ParameterError
        A column is missing or unknown, or a value is outside its range.
    StorageError
        The file cannot be read, is no text, or is larger than a megabyte.

    Examples
    --------
    >>> rows = ["channel,order,band_hz,limit,unit", "front,1,,60,dB", "front,,500,45,dB"]
    >>> np.savetxt("limits.csv", rows, fmt="%s")
    >>> orders, figures = va.read_figure_limits("limits.csv")
    >>> orders[0].order, figures[0].subject
    (1.0, 'band 500 Hz of front')
    """
    orders, figures = [], []
    for header, number, row in _lines(path, ("limit", "unit"), OF_FIGURES):
        where = f"{path}: line {number}"
        fields = _fields(header, row, where)
        if fields.get("order") and fields.get("side", "") in ("", HIGHEST):
            _figure_limit(fields, where)  # refuses a band or a criterion beside the order
            orders.append(_limit(fields, where))
        else:
            figures.append(_figure_limit(fields, where))
    return tuple(orders), tuple(figures)


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


def _lines(
    path: str | Path, required: Sequence[str], optional: Sequence[str]
) -> Iterator[tuple[list[str], int, list[str]]]:
    """Header, number and fields of every limit of a file, at least one."""
    rows = _rows(_text(Path(path)), path)
    line, header = next(rows, (0, []))
    if not header:
        raise ParameterError(f"{path}: is empty: must begin with {','.join(required)}")
    _check_header(header, f"{path}: line {line}", required, optional)
    limits = [(header, number, row) for number, row in rows]
    if not limits:
        raise ParameterError(f"{path}: holds no limit below its header")
    yield from limits


def _check_header(
    header: Sequence[str], where: str, required: Sequence[str], optional: Sequence[str]
) -> None:
    allowed = f"must be {','.join(required)} and may be {','.join(optional)}, each once"
    for name in header:
        if name not in (*required, *optional) or header.count(name) > 1:
            raise ParameterError(f"{where}: column {name!r}: the header {allowed}")
    for name in required:
        if name not in header:
            raise ParameterError(f"{where}: column {name!r} is missing: the header {allowed}")


def _fields(header: Sequence[str], row: Sequence[str], where: str) -> dict[str, str]:
    if len(row) != len(header):
        raise ParameterError(f"{where}: has {len(row)} fields, the header {len(header)}")
    return dict(zip(header, row, strict=True))


def _limit(fields: Mapping[str, str], where: str) -> Limit:
    return Limit(
        fields["channel"],
        _number(fields, "order", where),
        _number(fields, "limit", where),
        fields["unit"],
        **_speeds(fields, where),
        origin=where,
    )


def _figure_limit(fields: Mapping[str, str], where: str) -> FigureLimit:
    order, band_hz = (
        _number(fields, name, where) if fields.get(name) else None for name in ("order", "band_hz")
    )
    return FigureLimit(
        _number(fields, "limit", where),
        fields["unit"],
        fields.get("channel", ""),
        order,
        band_hz,
        criterion=fields.get("criterion", ""),
        side=fields.get("side") or HIGHEST,
        **_speeds(fields, where),
        origin=where,
    )


def _speeds(fields: Mapping[str, str], where: str) -> dict[str, float]:
    return {
        name: _number(fields, name, where) if fields.get(name) else absent
        for name, absent in SPEEDS.items()
    }


def _number(fields: Mapping[str, str], name: str, where: str) -> float:
    try:
        return float(fields[name])
    except ValueError:
        raise ParameterError(f"{where}: {name} = {fields[name]!r}: must be a number") from None
