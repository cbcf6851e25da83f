"""Columns of third parties: checked, and kept in the results for a report without the plug-in."""

import json
from collections.abc import Mapping
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.errors import SchemaError
from ..base.fault import collected
from ..base.vocabulary import stamp
from ..results.complete import read_attribute
from ..results.run_attributes import Part
from . import left_out
from .columns import COLUMNS, Column, Write
from .shown_speeds import few_speeds

ATTRIBUTE: Final = "report_columns"
_DIMENSIONS: Final = ("option", "speed", "receiver")


class ColumnsOf(NamedTuple):
    """Columns of some results, and a line on each that is omitted."""

    columns: tuple[Column, ...]
    left_out: tuple[str, ...]


def columns_of(results: xr.Dataset) -> ColumnsOf:
    """Built-in columns, those of third parties that are loaded, and kept ones of others, in
    order."""
    third_party = COLUMNS.origins()
    built_in = [column for column in COLUMNS.values() if column.name not in third_party]
    columns = [column for column in built_in if column.applies(results)]
    names = frozenset(column.name for column in columns)
    with collected() as lines:
        for name in third_party:
            with COLUMNS.spared(), COLUMNS.fenced(name):
                columns += _checked(COLUMNS[name], results, names)
    columns += [column for column in kept(results) if column.name not in COLUMNS]
    absent = left_out.missing(results, "column", ATTRIBUTE)
    lines += [line for name, line in absent.items() if name not in COLUMNS]
    return ColumnsOf(tuple(sorted(columns, key=lambda column: column.position)), tuple(lines))


def keep_columns(results: xr.Dataset) -> xr.Dataset:
    """The results with head, values and texts of every column that is not built in."""
    every = columns_of(results).columns
    others = [
        column for column in every if COLUMNS.origin(column.name) or column.name not in COLUMNS
    ]
    held = results.drop_vars(["column_value", "column"], errors="ignore")
    if not others:
        return held.assign_attrs({ATTRIBUTE: "[]"}) if COLUMNS.origins() else held
    arrays = [_values(column, results).astype(float) for column in others]
    held.attrs[ATTRIBUTE] = json.dumps(
        [_as_json(column, values, results) for column, values in zip(others, arrays, strict=True)]
    )
    names = [column.name for column in others]
    coords = {"column": names, **{dim: results[dim] for dim in _DIMENSIONS}}
    held["column_value"] = stamp("column_value", np.stack(arrays), coords)
    return held


def _checked(column: Column, results: xr.Dataset, names: frozenset[str]) -> list[Column]:
    """The column, if it applies and can be shown."""
    if not column.applies(results):
        return []
    if column.change_of and column.change_of not in names:
        raise ValueError(f"change_of = {column.change_of}: no such column")
    shown = _values(column, few_speeds(results))
    if not np.isfinite(shown.values).all():
        raise ValueError("values are not finite")
    _texts(column, shown, results)
    return [column]


def _values(column: Column, results: xr.Dataset) -> xr.DataArray:
    """Values over option, speed and microphone."""
    values = column.values(results).reset_coords(drop=True)
    if not set(values.dims) <= set(_DIMENSIONS):
        raise ValueError(f"dimensions are {values.dims}; allowed {', '.join(_DIMENSIONS)}")
    coordinates = xr.Dataset(coords={dim: results[dim] for dim in _DIMENSIONS})
    aligned, _ = xr.align(values, coordinates, join="exact")
    return aligned.broadcast_like(coordinates).transpose(*_DIMENSIONS)


def _texts(column: Column, values: xr.DataArray, results: xr.Dataset) -> dict[str, str]:
    """Text of every value that is shown."""
    shown = np.unique(values.values.astype(float)).tolist()
    texts = {repr(value): column.write(value, results) for value in shown}
    if not all(isinstance(text, str) for text in texts.values()):
        raise ValueError("write gives no text")
    return texts


def _as_json(column: Column, values: xr.DataArray, results: xr.Dataset) -> dict[str, Any]:
    shown = values.sel(speed=few_speeds(results)["speed"])
    return {
        **{name: getattr(column, name) for name in ("name", "head", "terminal", "change_of")},
        "position": column.position,
        "texts": _texts(column, shown, results),
    }


class KeptColumn(Part):
    """A column in the results: head and texts; its values are in `column_value`."""

    name: str
    head: str | None
    terminal: str | None
    texts: dict[str, str]
    change_of: str
    position: float

    def column(self) -> Column:
        """The column with these texts."""
        shown = (partial(_kept_values, self.name), self.head, self.terminal, _writer(self.texts))
        return Column(self.name, *shown, self.change_of, position=self.position)


def kept(results: xr.Dataset) -> list[Column]:
    """Columns that the results hold.

    Raises
    ------
    SchemaError
        What they hold is no column, or its values are missing.
    """
    if ATTRIBUTE not in results.attrs:
        return []
    entries: list[KeptColumn] = read_attribute(results, ATTRIBUTE, list[KeptColumn])
    names = results["column"].values if "column_value" in results else ()
    for entry in entries:
        if entry.name not in names:
            raise SchemaError(f"column_value: holds no column {entry.name}")
    return [entry.column() for entry in entries]


def _kept_values(name: str, results: xr.Dataset) -> xr.DataArray:
    return results["column_value"].sel(column=name, drop=True)


def _writer(texts: Mapping[str, str]) -> Write:
    """The texts that were kept; three digits for a value that was not shown then."""
    return lambda value, results: texts.get(repr(value)) or rounding.significant(value)
