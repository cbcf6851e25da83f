"""Tables of orders against their limits."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_amplitude
from ..results.order_limits import NOT_CHECKED
from .order_tables import amplitude
from .tables import DataTable, Table, columns_of

_OF_ONE: Final = {"": ("channel", "speed", "channel_order_rms", "limit_margin")}
_OF_TWO: Final = {
    "A": ("channel", "speed", "channel_order_rms", "limit_margin"),
    "B": ("compared_channel", "compared_speed", "compared_order_rms", "compared_limit_margin"),
}
"""By the result: names of its channel, speed, RMS and margin."""


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
        """What it is, in a sentence."""
        of = f" in {self.result}" if self.result else ""
        return f"order {self.order:g} of {self.channel} at {self.speed_rpm:.0f} rpm{of}"


def limits_data(checked: xr.Dataset) -> DataTable:
    """Every order that has a limit, at every speed; of two results with a column for which."""
    first = 0 if "compared_limit_margin" in checked else 1
    return columns_of(_Checked._fields[first:], [row[first:] for row in _rows(checked)])


def limits_words(checked: xr.Dataset) -> list[str]:
    """How many orders exceed their limit, and what was not checked."""
    return [_verdict(_worst(checked)), *_not_checked(checked)]


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
    """How many exceed, and which one most."""
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


def _not_checked(checked: xr.Dataset) -> list[str]:
    left_out = checked.attrs.get(NOT_CHECKED)
    return [f"not checked, no such order or speed: {left_out}"] if left_out else []


def _worst(checked: xr.Dataset) -> list[_Checked]:
    """The row of least margin of each result, channel and order."""
    worst: dict[tuple[str, str, float], _Checked] = {}
    for row in _rows(checked):
        key = (row.result, row.channel, row.order)
        worst[key] = min(worst.get(key, row), row, key=lambda each: each.margin_db)
    return list(worst.values())


def _rows(checked: xr.Dataset) -> Iterator[_Checked]:
    """Of each channel, speed and order with a limit, a row of each result that has a value."""
    names = _OF_TWO if "compared_limit_margin" in checked else _OF_ONE
    used = {name for each in names.values() for name in each} | {"order_limit", "order"}
    values = {name: checked[name].values for name in used}
    units = checked["channel_unit"].values
    for at in zip(*np.nonzero(np.isfinite(values["order_limit"])), strict=True):
        unit = str(units[at[0]])
        for result, (channel, speed, rms, margin) in names.items():
            if np.isfinite(values[margin][at]):
                yield _Checked(
                    result=result,
                    channel=str(values[channel][at[0]]),
                    unit="dB" if unit == "Pa" else unit,
                    order=float(values["order"][at[2]]),
                    speed_rpm=float(values[speed][at[1]]),
                    value=_in_unit(float(values[rms][at]), unit),
                    limit=_in_unit(float(values["order_limit"][at]), unit),
                    margin_db=float(values[margin][at]),
                    within="yes" if values[margin][at] >= 0.0 else "no",
                )


def _in_unit(rms: float, unit: str) -> float:
    """Sound pressure as its level, all else as it is."""
    return float(level_of_amplitude(rms / REFERENCE_PRESSURE_PA)) if unit == "Pa" else rms


def _shown(value: float, unit: str) -> str:
    return rounding.fixed(value) if unit == "dB" else amplitude(value)
