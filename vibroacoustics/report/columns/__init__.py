"""Columns of the comparison: one value per option, speed and microphone.

A column is one object, in one list of `built_in` or registered by a third party; it appears in
`comparison.csv`, and in the tables of the report and the terminal where it has a head for them.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

import xarray as xr

from ...base import rounding
from ...base.registry import LAST, Registry
from ...base.remembered import remembered

Values = Callable[[xr.Dataset], xr.DataArray]
Write = Callable[[float, xr.Dataset], str]


def amount(value: float, results: xr.Dataset) -> str:
    """A quantity to three significant digits."""
    return rounding.significant(value)


def _always(results: xr.Dataset) -> bool:
    return True


@dataclass(frozen=True)
class Column:
    """A column of the comparison.

    Attributes
    ----------
    name : name in comparison.csv, with its unit
    values : from the results, over option, speed and, where it depends on it, receiver
    head : in the tables of the report; None: not in them
    terminal : head in the terminal; None: not there
    write : text of a cell, from value and results
    change_of : column of the level that this one is a change of: `–` where that is silent
        without a balancer, `silent` where it is with the option
    applies : whether results have such a column
    position : from left to right; those of third parties are the last
    variable : name of the variable whose value it is, with the labels `at`; the tables show its
        interval
    at : labels of the variable beside option, speed and receiver

    Examples
    --------
    >>> def moment(results):
    ...     return results["moment_amplitude"].sel(order=2)
    >>> column = va.Column("moment_2x_nm", moment, head="Moment 2×, N m")
    >>> column.values(va.open_results("results.nc")).dims
    ('speed', 'option')
    """

    name: str
    values: Values
    head: str | None = None
    terminal: str | None = None
    write: Write = amount
    change_of: str = ""
    applies: Callable[[xr.Dataset], bool] = _always
    position: float = LAST
    variable: str = ""
    at: Mapping[str, Any] = field(default_factory=dict)


COLUMNS: Final[Registry[Column]] = Registry(
    "column", Column, "name", "report.columns", "vibroacoustics.columns"
)


@remembered
def column(results: xr.Dataset, name: str) -> xr.DataArray:
    """One column over option, speed and, for levels, receiver; the unit is in its name."""
    return COLUMNS[name].values(results).reset_coords(drop=True)
