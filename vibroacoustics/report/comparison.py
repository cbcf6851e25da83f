"""The comparison of the options: one value per option, speed and microphone."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import product

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.vocabulary import REFERENCE_OPTION
from .columns import COLUMNS, Column
from .kept_columns import columns_of
from .study import (
    catalogue_receiver,
    few_speeds,
    few_speeds_words,
    first_order_hz,
    options,
    speeds,
)
from .tables import Table, to_csv, to_text

_DIMENSIONS = ("option", "speed", "receiver")


def column(results: xr.Dataset, name: str) -> xr.DataArray:
    """One column over option, speed and, for levels, receiver; the unit is in its name."""
    return COLUMNS[name].values(results).reset_coords(drop=True)


def comparison(results: xr.Dataset) -> xr.Dataset:
    """The columns of `comparison.csv` as variables over (option, speed, receiver).

    Forces in N and moments in N m are semi-major axes, peak; the foot force is the largest over
    the feet; levels in dB re 20 µPa.
    """
    return _joined(results, columns_of(results).columns)


def comparison_csv(results: xr.Dataset) -> bytes:
    """One row per option, speed and microphone, to nine significant digits."""
    compared = comparison(results)
    names = [str(name) for name in compared.data_vars]
    receivers = [str(name) for name in compared["receiver"].values]
    keys: Iterable[tuple[str | float, ...]] = product(options(results), speeds(results), receivers)
    values = np.stack([compared[name].values.ravel() for name in names], axis=-1).tolist()
    rows = ((*key, *row) for key, row in zip(keys, values, strict=True))
    return to_csv(("option", "speed_rpm", "receiver", *names), rows)


def comparison_tables(results: xr.Dataset, receiver: str) -> list[Table]:
    """One table per speed that is shown, rounded for reading."""
    return _tables(results, receiver, lambda column: column.head)


def comparison_text(results: xr.Dataset) -> str:
    """Compact plain-text tables for the terminal, at the catalogue's microphone."""
    tables = _tables(results, catalogue_receiver(results), lambda column: column.terminal)
    chosen = few_speeds_words(results)
    return "\n".join([*map(to_text, tables), *([f"{chosen}\n"] if chosen else [])])


def _joined(results: xr.Dataset, columns: Sequence[Column]) -> xr.Dataset:
    arrays = {column.name: column.values(results).reset_coords(drop=True) for column in columns}
    coordinates = xr.Dataset(coords={dim: results[dim] for dim in _DIMENSIONS})
    return xr.Dataset(arrays).broadcast_like(coordinates).transpose(*_DIMENSIONS)


def _tables(
    results: xr.Dataset, receiver: str, head_of: Callable[[Column], str | None]
) -> list[Table]:
    shown = few_speeds(results)
    columns = columns_of(shown).columns
    compared = _joined(shown, columns).sel(receiver=receiver)
    numbers = {str(name): array.values for name, array in compared.data_vars.items()}
    heads = {column.name: head for column in columns if (head := head_of(column)) is not None}
    write = partial(_cell, shown, numbers)
    return [
        Table(
            f"{speed:g} rpm (1× at {frequency:.1f} Hz), microphone {receiver}",
            ("Option", *heads.values()),
            tuple(
                (option, *(write(column, at, i) for column in columns if column.name in heads))
                for at, option in enumerate(options(shown))
            ),
        )
        for i, (speed, frequency) in enumerate(
            zip(speeds(shown), first_order_hz(shown), strict=True)
        )
    ]


def _cell(
    results: xr.Dataset,
    numbers: dict[str, Array],
    column: Column,
    option: int,
    speed: int,
) -> str:
    """Text of a value; a change of a silent level is none."""
    value = float(numbers[column.name][option, speed])
    if column.change_of:
        level = numbers[column.change_of][:, speed]
        if level[options(results).index(REFERENCE_OPTION)] < rounding.LEVEL_FLOOR_DB:
            return rounding.NOTHING
        if level[option] < rounding.LEVEL_FLOOR_DB:
            return "silent"
    return column.write(value, results)
