"""Orders and other figures against their limits: tables, and a line for each that is broken."""

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_amplitude
from ..results.bands import percent
from ..results.figure_limits import CheckedFigure
from ..results.order_limits import NOT_CHECKED
from .blocks import Block, Bullets, Text
from .tables import DataTable, Record, Table, amplitude, cell, columns_of, data_table, records

_OF_RESULT: Final = ("channel", "speed_rpm", "value", "margin_db")
_OF_ONE: Final = {"": ("channel", "speed", "channel_order_rms", "limit_margin")}
_OF_TWO: Final = {
    "A": ("channel", "speed", "channel_order_rms", "limit_margin"),
    "B": ("compared_channel", "compared_speed", "compared_order_rms", "compared_limit_margin"),
}
"""Names of the channel, speed, RMS and margin by result, and the columns that it has alone."""
_FIELDS: Final = (
    "result", "figure", "speed_rpm", "value", "limit", "unit", "side", "margin", "probability",
)  # fmt: skip


class _Checked(NamedTuple):
    """A row of the CSV; the fields are its head. Value and limit are RMS, of Pa their level."""

    result: str
    channel: str
    unit: str
    order: float
    speed_rpm: float
    value: float
    limit: float
    margin_db: float
    within: str

    @property
    def subject(self) -> str:
        """Subject in a sentence."""
        of = f" in {self.result}" if self.result else ""
        return f"order {self.order:g} of {self.channel} at {self.speed_rpm:.0f} rpm{of}"


def limits_data(checked: xr.Dataset) -> DataTable:
    """Every order that has a limit, at every speed; of two results with a column for which."""
    first = 0 if "compared_limit_margin" in checked else 1
    return columns_of(_Checked._fields[first:], [row[first:] for row in _rows(checked)])


def limits_words(checked: xr.Dataset) -> list[str]:
    """Say how many orders exceed their limit, and what was not checked."""
    left_out = checked.attrs.get(NOT_CHECKED)
    not_checked = [f"not checked, no such order or speed: {left_out}"] if left_out else []
    return [_verdict(_worst(checked)), *not_checked]


def order_limits_table(checked: xr.Dataset) -> Table:
    """The worst margin of each channel and order."""
    caption = "Limits: the least margin of each order over the speeds, above 0 below the limit"
    head = ("Channel", "Order", "at rpm", "RMS", "limit", "unit", "margin, dB", "")
    return Table(caption, head, tuple(map(_cells, _worst(checked))), frozenset({0, 5, 7}))


def broken_orders(checked: xr.Dataset) -> list[str]:
    """A line for each order of a channel that exceeds its limit, with its worst speed."""
    return [
        f"{row.subject}: {_shown(row.value, row.unit)} {row.unit} is above "
        f"{_shown(row.limit, row.unit)} {row.unit}"
        for row in _worst(checked)
        if row.margin_db < 0.0
    ]


def _cells(row: _Checked) -> tuple[str, ...]:
    return (
        f"{row.result}: {row.channel}" if row.result else row.channel,
        f"{row.order:g}",
        f"{row.speed_rpm:.0f}",
        _shown(row.value, row.unit),
        _shown(row.limit, row.unit),
        row.unit,
        rounding.signed(row.margin_db),
        "" if row.margin_db >= 0.0 else "exceeds",
    )


def _verdict(worst: list[_Checked]) -> str:
    """Say how many exceed, and which one most."""
    if not worst:
        return "No order with a limit is known."
    least = min(worst, key=lambda row: row.margin_db)
    exceeding = sum(row.margin_db < 0.0 for row in worst)
    if not exceeding:
        return (
            f"None of {len(worst)} orders exceeds its limit; the least margin is "
            f"{rounding.fixed(least.margin_db)} dB: {least.subject}."
        )
    verb = "exceeds its limit" if exceeding == 1 else "exceed their limits"
    return (
        f"{exceeding} of {len(worst)} orders {verb}, the worst by "
        f"{rounding.fixed(-least.margin_db)} dB: {least.subject}."
    )


def _worst(checked: xr.Dataset) -> list[_Checked]:
    """The row of least margin of each result, channel and order."""
    worst: dict[tuple[str, str, float], _Checked] = {}
    for row in _rows(checked):
        key = (row.result, row.channel, row.order)
        worst[key] = min(worst.get(key, row), row, key=lambda each: each.margin_db)
    return list(worst.values())


def _rows(checked: xr.Dataset) -> Iterator[_Checked]:
    """Rows of each channel, speed and order with a limit, one for each result that has a value."""
    names = _OF_TWO if "compared_limit_margin" in checked else _OF_ONE
    shared = {"unit": "channel_unit", "order": "order", "limit": "order_limit"}
    tables = []
    for of_result in names.values():
        columns = shared | dict(zip(_OF_RESULT, of_result, strict=True))
        arrays = {column: checked[name] for column, name in columns.items()}
        tables.append(records(data_table(("channel", "speed", "order"), arrays)))
    for rows in zip(*tables, strict=True):
        for result, row in zip(names, rows, strict=True):
            if np.isfinite(row["limit"]) and np.isfinite(row["margin_db"]):
                within = "yes" if row["margin_db"] >= 0.0 else "no"
                yield _Checked(result=result, within=within, **_in_unit(row))


def _in_unit(row: Record) -> Record:
    """Sound pressure as its level, all else as it is."""
    if row["unit"] != "Pa":
        return row
    rms = np.array([row["value"], row["limit"]])
    value, limit = level_of_amplitude(rms / REFERENCE_PRESSURE_PA).tolist()
    return {**row, "unit": "dB", "value": value, "limit": limit}


def _shown(value: float, unit: str) -> str:
    return rounding.fixed(value) if unit == "dB" else amplitude(value)


def broken_lines(checked: xr.Dataset, figures: Sequence[CheckedFigure]) -> list[str]:
    """Name what is broken, a line each; none where all limits hold."""
    orders = broken_orders(checked) if "order_limit" in checked else []
    return [*orders, *(_broken(row) for row in figures if not row.is_within)]


def limit_blocks(checked: xr.Dataset, figures: Sequence[CheckedFigure]) -> list[Block]:
    """Return what is broken, and every limit with its margin; nothing without limits."""
    if not figures and "order_limit" not in checked:
        return []
    broken = broken_lines(checked, figures)
    blocks: list[Block] = [Text(limits_sentence(checked, figures), "strong")]
    if broken:
        blocks.append(Bullets(tuple(broken)))
    if "order_limit" in checked:
        blocks.append(order_limits_table(checked))
    return [*blocks, figure_limits_table(figures)] if figures else blocks


def limits_sentence(checked: xr.Dataset, figures: Sequence[CheckedFigure]) -> str:
    """Say how many limits are broken."""
    count = len(broken_lines(checked, figures))
    if not count:
        return "Every limit holds."
    return f"{count} limit{'s are' if count > 1 else ' is'} broken."


def figure_limits_table(figures: Sequence[CheckedFigure]) -> Table:
    """Every figure that has a limit."""
    rows = [
        (
            f"{row.result}: {row.figure}",
            _speed(row),
            value,
            f"{row.side} {limit}",
            row.unit,
            rounding.fixed(row.margin) if _is_level(row) else rounding.significant(row.margin),
            percent(row.probability),
            "" if row.is_within else "broken",
        )
        for row in figures
        for value, limit in [_numbers(row)]
    ]
    head = ("Figure", "rpm", "Value", "Limit", "Unit", "Margin", "Probability that it holds", "")
    caption = "Limits of totals, bands, criteria and lowest values"
    return Table(caption, head, tuple(rows), frozenset({0, 4, 7}))


def figure_limits_data(figures: Sequence[CheckedFigure]) -> DataTable:
    """Every figure that has a limit; the speed is empty where a figure is of all speeds."""
    rows = [
        [*(cell(getattr(row, name)) for name in _FIELDS), "yes" if row.is_within else "no"]
        for row in figures
    ]
    return columns_of((*_FIELDS, "within"), rows)


def _speed(row: CheckedFigure) -> str:
    return rounding.NOTHING if np.isnan(row.speed_rpm) else f"{row.speed_rpm:.0f}"


def _broken(row: CheckedFigure) -> str:
    at_speed = "" if np.isnan(row.speed_rpm) else f" at {row.speed_rpm:.0f} rpm"
    beyond = "above" if row.side == "highest" else "below"
    value, limit = _numbers(row)
    return (
        f"{row.figure}{at_speed} in {row.result}: {value} {row.unit} is {beyond} "
        f"{limit} {row.unit} ({row.origin})"
    )


def _numbers(row: CheckedFigure) -> tuple[str, str]:
    """Value and limit: levels to 0.1 dB, to more digits where they would read the same."""
    level, limit = (rounding.fixed(figure) for figure in (row.value, row.limit))
    if _is_level(row) and level != limit:
        return level, limit
    return rounding.significant(row.value, 4), rounding.significant(row.limit, 4)


def _is_level(row: CheckedFigure) -> bool:
    return row.unit.startswith("dB")
