"""Every option beside every other: forces, levels and their changes, by speed and microphone."""

from collections.abc import Callable, Mapping
from typing import Any

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.remembered import remembered
from ...base.vocabulary import REFERENCE_OPTION
from ...results.bands import INTERVAL, number
from ...results.estimates import has_samples
from ...results.stored_study import (
    balancers,
    catalogue_receiver,
    first_order_hz,
    nearest_speed,
    options,
    overall_noise,
    speeds,
)
from ..blocks import Block, Text
from ..columns import Column
from ..kept_columns import columns_of
from ..quantities import TOTAL
from ..remainder import total_sentence
from ..shifts import level_word, shift
from ..shown_speeds import few_speeds, few_speeds_words
from ..tables import Cell, DataTable, Table, data_table
from . import Section

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
    heads = ("option", "speed_rpm", "receiver")
    columns = {head: compared[dim] for head, dim in zip(heads, _DIMENSIONS, strict=True)}
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
    no_total = total_sentence(results) if overall_noise(results) is None else ""
    notes = [bands_sentence(results), few_speeds_words(results), no_total]
    return (*tables, *map(Text, filter(None, notes)))


def bands_sentence(results: xr.Dataset) -> str:
    """Say what the values in the tables are; nothing without samples."""
    if not has_samples(results):
        return ""
    return f"Values are medians of the weighted samples, with their {INTERVAL} in brackets."


def _tables(
    results: xr.Dataset, receiver: str, head_of: Callable[[Column], str | None]
) -> list[Table]:
    shown = few_speeds(results)
    columns = [each for each in columns_of(shown).columns if head_of(each) is not None]
    words = level_words(results)
    tables = []
    for speed, frequency in zip(speeds(shown), first_order_hz(shown), strict=True):
        coordinates = {"receiver": receiver, "speed": speed}
        here = comparison(shown).sel(coordinates)
        rows = tuple(
            (
                option,
                words[option],
                *(_cell(shown, each, here, option, coordinates) for each in columns),
            )
            for option in options(shown)
        )
        caption = f"{speed:g} rpm (1× at {frequency:.1f} Hz), microphone {receiver}"
        head = ("Option", "Level", *(head_of(column) or "" for column in columns))
        tables.append(Table(caption, head, rows, frozenset({0, 1})))
    return tables


def _cell(
    results: xr.Dataset,
    column: Column,
    here: xr.Dataset,
    option: str,
    coordinates: Mapping[str, Any],
) -> Cell:
    """Value with its interval; a change of a silent level is none."""

    def write(value: float) -> str:
        return column.write(value, results)

    if column.change_of:
        level = here[column.change_of]
        if level.sel(option=REFERENCE_OPTION) < rounding.LEVEL_FLOOR_DB:
            return rounding.NOTHING
        if level.sel(option=option) < rounding.LEVEL_FLOOR_DB:
            return "silent"
    if not column.variable:
        return write(float(here[column.name].sel(option=option)))
    unit = _UNITS.get(column.name.rsplit("_", 1)[-1], "")
    return number(
        results, column.variable, write, unit, **{"option": option, **coordinates, **column.at}
    )


def level_words(results: xr.Dataset) -> dict[str, str]:
    """Return what every option does to the level, in the word of the first screen."""
    changed = {name: level_word(shift(results, TOTAL, name)) for name in balancers(results)}
    return {REFERENCE_OPTION: rounding.NOTHING, **changed}


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "1× is once per shaft revolution. Forces and moments (about the centre of mass) are "
            "peak values, the foot force is the largest over the feet. Levels are in dB re 20 µPa. "
            f"{total_sentence(results)} {bands_sentence(results)} Δ is the change against none.",
            "note",
            (("assumptions", "assumptions"),),
        ),
        *(Text(line, "note") for line in columns_of(results).left_out),
        comparison_table(results),
        Text("Other microphones, speeds and columns are in comparison.csv.", "note"),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    return {"comparison.csv": comparison_data(results)}


register(Section("comparison", "Comparison", _blocks, position=20.0, tables=_data))
