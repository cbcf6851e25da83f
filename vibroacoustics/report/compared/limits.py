"""Limits of two results: a table, and a line for each that is broken."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...results.figure_limits import CheckedFigure
from ..bands import percent
from ..blocks import Block, Bullets, Text
from ..limit_tables import broken_orders, order_limits_table
from ..tables import DataTable, Table, columns_of

_FIELDS: Final = (
    "result", "figure", "speed_rpm", "value", "limit", "unit", "side", "margin", "probability",
)  # fmt: skip


def broken_lines(checked: xr.Dataset, figures: Sequence[CheckedFigure]) -> list[str]:
    """What is broken, a line each; none where all limits hold."""
    orders = broken_orders(checked) if "order_limit" in checked else []
    return [*orders, *(_broken(row) for row in figures if not row.is_within)]


def limit_blocks(checked: xr.Dataset, figures: Sequence[CheckedFigure]) -> list[Block]:
    """What is broken, and every limit with its margin."""
    broken = broken_lines(checked, figures)
    blocks: list[Block] = [Text(limits_sentence(checked, figures), "strong")]
    if broken:
        blocks.append(Bullets(tuple(broken)))
    if "order_limit" in checked:
        blocks.append(order_limits_table(checked))
    return [*blocks, figure_limits_table(figures)] if figures else blocks


def limits_sentence(checked: xr.Dataset, figures: Sequence[CheckedFigure]) -> str:
    """How many limits are broken."""
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
            _chance(row),
            "" if row.is_within else "broken",
        )
        for row in figures
        for value, limit in [_numbers(row)]
    ]
    head = ("Figure", "rpm", "Value", "Limit", "Unit", "Margin", "Probability that it holds", "")
    return Table(
        "Limits of totals, bands, criteria and lowest values",
        head,
        tuple(rows),
        frozenset({0, 4, 7}),
    )


def figure_limits_data(figures: Sequence[CheckedFigure]) -> DataTable:
    """Every figure that has a limit; the speed is empty where a figure is of all speeds."""
    rows = [
        [*(_cell(getattr(row, name)) for name in _FIELDS), "yes" if row.is_within else "no"]
        for row in figures
    ]
    return columns_of((*_FIELDS, "within"), rows)


def _cell(value: str | float) -> str | float:
    return "" if isinstance(value, float) and np.isnan(value) else value


def _chance(row: CheckedFigure) -> str:
    return rounding.NOTHING if np.isnan(row.probability) else percent(row.probability)


def _speed(row: CheckedFigure) -> str:
    return rounding.NOTHING if np.isnan(row.speed_rpm) else f"{row.speed_rpm:.0f}"


def _broken(row: CheckedFigure) -> str:
    at = "" if np.isnan(row.speed_rpm) else f" at {row.speed_rpm:.0f} rpm"
    beyond = "above" if row.side == "highest" else "below"
    value, limit = _numbers(row)
    return (
        f"{row.figure}{at} in {row.result}: {value} {row.unit} is {beyond} {limit} {row.unit} "
        f"({row.origin})"
    )


def _numbers(row: CheckedFigure) -> tuple[str, str]:
    """Value and limit: levels to 0.1 dB, to more digits where they would read the same."""
    level, limit = (rounding.fixed(one) for one in (row.value, row.limit))
    if _is_level(row) and level != limit:
        return level, limit
    return rounding.significant(row.value, 4), rounding.significant(row.limit, 4)


def _is_level(row: CheckedFigure) -> bool:
    return row.unit.startswith("dB")
