"""Limits from a CSV file, a line each: of orders, or of all that `compare` knows."""

from collections.abc import Iterator, Mapping, Sequence
from math import inf, isnan
from pathlib import Path
from typing import Any, Final

from ..base.column_file import read_layouts
from ..base.column_head import Layout
from .figure_limit import HIGHEST, FigureLimit, Limit

SPEEDS: Final = {"speed_from_rpm": 0.0, "speed_to_rpm": inf}
"""Columns that may be missing or empty, and what then holds."""
OF_ORDERS: Final = Layout(
    ("order", "limit"), tuple(SPEEDS), texts=("channel", "unit"), blank=tuple(SPEEDS)
)
OF_FIGURES: Final = Layout(
    ("limit",),
    ("order", "band_hz", *SPEEDS),
    ("channel", "criterion", "side"),
    texts=("unit",),
    blank=("order", "band_hz", *SPEEDS),
)
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
        The file cannot be read, is larger than a megabyte, lacks a column or has an unknown one,
        or a value is outside its range.

    Examples
    --------
    >>> rows = ["# test stand 2", "channel,order,limit,unit", "*,1,60,dB", "ring,2,0.5,m/s²"]
    >>> np.savetxt("limits.csv", rows, fmt="%s", encoding="utf-8")
    >>> limits = va.read_limits("limits.csv")
    >>> limits[1].channel, limits[1].order, limits[1].limit, limits[1].unit
    ('ring', 2.0, 0.5, 'm/s²')
    """
    return tuple(_limit(fields, origin) for fields, origin in _lines(path, OF_ORDERS))


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
        The file cannot be read, is larger than a megabyte, lacks a column or has an unknown one,
        or a value is outside its range.

    Examples
    --------
    >>> rows = ["channel,order,band_hz,limit,unit", "front,1,,60,dB", "front,,500,45,dB"]
    >>> np.savetxt("limits.csv", rows, fmt="%s")
    >>> orders, figures = va.read_figure_limits("limits.csv")
    >>> orders[0].order, figures[0].subject
    (1.0, 'band 500 Hz of front')
    """
    orders, figures = [], []
    for fields, origin in _lines(path, OF_FIGURES):
        if "order" in fields and fields.get("side", HIGHEST) == HIGHEST:
            _figure_limit(fields, origin)  # refuses a band or a criterion beside the order
            orders.append(_limit(fields, origin))
        else:
            figures.append(_figure_limit(fields, origin))
    return tuple(orders), tuple(figures)


def _lines(path: str | Path, layout: Layout) -> Iterator[tuple[dict[str, Any], str]]:
    """Values of each limit by column, without blank cells, and its line."""
    columns = read_layouts(path, [layout], MAXIMUM_BYTES)
    values: dict[str, Sequence[Any]] = dict(columns.texts)
    for name, numbers in columns.numbers.items():
        values[name] = [None if isnan(number) else number for number in numbers.tolist()]
    for row, cells in enumerate(zip(*values.values(), strict=True)):
        named = zip(values, cells, strict=True)
        yield {name: cell for name, cell in named if cell not in ("", None)}, columns.origin(row)


def _limit(fields: Mapping[str, Any], origin: str) -> Limit:
    return Limit(
        fields.get("channel", ""),
        fields["order"],
        fields["limit"],
        fields.get("unit", ""),
        **_speeds(fields),
        origin=origin,
    )


def _figure_limit(fields: Mapping[str, Any], origin: str) -> FigureLimit:
    return FigureLimit(
        fields["limit"],
        fields.get("unit", ""),
        fields.get("channel", ""),
        fields.get("order"),
        fields.get("band_hz"),
        criterion=fields.get("criterion", ""),
        side=fields.get("side", HIGHEST),
        **_speeds(fields),
        origin=origin,
    )


def _speeds(fields: Mapping[str, Any]) -> dict[str, float]:
    return {name: fields.get(name, absent) for name, absent in SPEEDS.items()}
