"""The comparison of the options: one value per option, speed and microphone."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import xarray as xr

from ....base import rounding
from ....base.arrays import Array
from ....base.remembered import remembered
from ....base.vocabulary import REFERENCE_OPTION
from ....results.estimates import has_samples
from ....results.stored_study import (
    balancers,
    catalogue_receiver,
    first_order_hz,
    nearest_speed,
    options,
    overall_noise,
    speeds,
)
from ...bands import INTERVAL, number
from ...blocks import Block, Text
from ...columns import Column
from ...kept_columns import columns_of
from ...quantities import TOTAL
from ...remainder import total_sentence
from ...shifts import shift
from ...shown_speeds import few_speeds, few_speeds_words
from ...tables import Cell, DataTable, Table, data_table
from ..verdict.words import word

_DIMENSIONS = ("option", "speed", "receiver")
_UNITS = {"dba": "dB(A)", "dbc": "dB(C)"}
"""Units of weighted levels by the ending of a column's name."""


@remembered
def comparison(results: xr.Dataset) -> xr.Dataset:
    """The columns of `comparison.csv` as variables over (option, speed, receiver).

    Forces in N and moments in N m are semi-major axes, peak; the foot force is the largest over
    the feet; levels in dB re 20 µPa.
    """
    columns = columns_of(results).columns
    arrays = {column.name: column.values(results).reset_coords(drop=True) for column in columns}
    coordinates = xr.Dataset(coords={dim: results[dim] for dim in _DIMENSIONS})
    return xr.Dataset(arrays).broadcast_like(coordinates).transpose(*_DIMENSIONS)


def comparison_data(results: xr.Dataset) -> DataTable:
    """One row per option, speed and microphone."""
    compared = comparison(results)
    keys = {"option": "option", "speed_rpm": "speed", "receiver": "receiver"}
    columns = {head: compared[dim] for head, dim in keys.items()}
    values = {str(name): column for name, column in compared.data_vars.items()}
    return data_table(_DIMENSIONS, {**columns, **values})


def comparison_table(results: xr.Dataset) -> Table:
    """Return the comparison at speed and microphone of the published level."""
    here = results.sel(speed=[nearest_speed(results)])
    (table,) = _tables(here, catalogue_receiver(results), lambda column: column.head)
    return table


def terminal_blocks(results: xr.Dataset) -> tuple[Block, ...]:
    """Compact tables for the terminal, at the catalogue's microphone, and what their values are."""
    tables = _tables(results, catalogue_receiver(results), lambda column: column.terminal)
    notes = [bands_sentence(results), few_speeds_words(results), _no_total(results)]
    return (*tables, *map(Text, filter(None, notes)))


def bands_sentence(results: xr.Dataset) -> str:
    """Say what the values in the tables are; nothing without samples."""
    if not has_samples(results):
        return ""
    return f"Values are medians of the weighted samples, with their {INTERVAL} in brackets."


def _no_total(results: xr.Dataset) -> str:
    return total_sentence(results) if overall_noise(results) is None else ""


def _tables(
    results: xr.Dataset, receiver: str, head_of: Callable[[Column], str | None]
) -> list[Table]:
    shown = few_speeds(results)
    columns = columns_of(shown).columns
    cells = _Cells.of(shown, receiver)
    heads = {column.name: head for column in columns if (head := head_of(column)) is not None}
    words = level_words(results)
    return [
        Table(
            f"{speed:g} rpm (1× at {frequency:.1f} Hz), microphone {receiver}",
            ("Option", "Level", *heads.values()),
            tuple(
                (
                    option,
                    words[option],
                    *(cells.cell(column, at, i) for column in columns if column.name in heads),
                )
                for at, option in enumerate(options(shown))
            ),
            frozenset({0, 1}),
        )
        for i, (speed, frequency) in enumerate(
            zip(speeds(shown), first_order_hz(shown), strict=True)
        )
    ]


@dataclass(frozen=True)
class _Cells:
    """Values at one microphone.

    Attributes
    ----------
    results : with the speeds that are shown
    numbers : by column, shape (option, speed)
    receiver : the microphone
    """

    results: xr.Dataset
    numbers: dict[str, Array]
    receiver: str

    @classmethod
    def of(cls, results: xr.Dataset, receiver: str) -> "_Cells":
        compared = comparison(results).sel(receiver=receiver)
        numbers = {str(name): array.values for name, array in compared.data_vars.items()}
        return cls(results, numbers, receiver)

    def cell(self, column: Column, option: int, speed: int) -> Cell:
        """Value with its interval; a change of a silent level is none."""
        value = float(self.numbers[column.name][option, speed])
        if column.change_of:
            level = self.numbers[column.change_of][:, speed]
            if level[options(self.results).index(REFERENCE_OPTION)] < rounding.LEVEL_FLOOR_DB:
                return rounding.NOTHING
            if level[option] < rounding.LEVEL_FLOOR_DB:
                return "silent"
        if not column.variable:
            return column.write(value, self.results)
        at = {"option": options(self.results)[option], "speed": speeds(self.results)[speed]}
        return number(
            self.results,
            column.variable,
            partial(_write, column, self.results),
            _UNITS.get(column.name.rsplit("_", 1)[-1], ""),
            **{"receiver": self.receiver, **at, **column.at},
        )


def level_words(results: xr.Dataset) -> dict[str, str]:
    """Return what every option does to the level, in the word of the first screen."""
    changed = {name: word(shift(results, TOTAL, name)) for name in balancers(results)}
    return {REFERENCE_OPTION: rounding.NOTHING, **changed}


def _write(column: Column, results: xr.Dataset, value: float) -> str:
    return column.write(value, results)
