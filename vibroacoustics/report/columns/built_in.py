"""The columns that every comparison has, and further ones of the CSV: one line each."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any, Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import HIGH, LOW, NOMINAL, SUFFIXES
from ...results.estimates import is_sampled
from . import Column, Values


def _values(variable: str, coordinates: Mapping[str, Any]) -> Values:
    return lambda results: results[variable].sel(coordinates)


def _of(name: str, variable: str, coordinates: Mapping[str, Any], **more: Any) -> Column:
    """Column of the values of a variable."""
    return Column(name, _values(variable, coordinates), variable=variable, at=coordinates, **more)


def _beside(column: Column) -> Iterator[Column]:
    """Columns of the interval and the nominal value: `level_total_10_percent_dba` and so on."""
    stem, unit = column.name.rsplit("_", 1)
    for part in (LOW, HIGH, NOMINAL):
        suffix = SUFFIXES[part]
        yield Column(
            f"{stem}{suffix}_{unit}",
            _values(f"{column.variable}{suffix}", column.at),
            applies=partial(is_sampled, variable=column.variable),
        )


def _level(value: float, results: xr.Dataset) -> str:
    return rounding.level(value)


def _change(value: float, results: xr.Dataset) -> str:
    return rounding.signed(value)


_FIRST: Final = {"order": 1}
_SECOND: Final = {"order": 2}
_COLUMNS: Final = (
    _of("force_1x_n", "force_amplitude", _FIRST, head="Force 1×, N"),
    _of("force_2x_n", "force_amplitude", _SECOND),
    _of("moment_1x_nm", "moment_amplitude", _FIRST, head="Moment 1×, N m"),
    _of(
        "foot_force_1x_n", "largest_foot_force", _FIRST,
        head="Foot force 1×, N", terminal="foot 1x N",
    ),
    _of(
        "level_1x_db", "order_level", {**_FIRST, "weighting": "Z"},
        head="Level 1×, dB", terminal="1x dB", write=_level,
    ),
    _of("level_2x_db", "order_level", {**_SECOND, "weighting": "Z"}, write=_level),
    _of("level_1x_dba", "order_level", {**_FIRST, "weighting": "A"}, write=_level),
    _of(
        "level_modelled_dba", "level_modelled", {"weighting": "A"},
        head="Modelled level, dB(A)", write=_level,
    ),
    _of("level_total_dba", "level_total", {}, head="Total level, dB(A)",
        terminal="total dB(A)", write=_level),
    _of("change_1x_db", "change_1x", {}, write=_change,
        change_of="level_1x_db"),
    _of("change_modelled_db", "change_modelled", {}, write=_change,
        change_of="level_modelled_dba"),
    _of("change_total_db", "change_total", {}, head="Δ total, dB", terminal="Δtotal dB",
        write=_change),
    _of("level_modelled_db", "level_modelled", {"weighting": "Z"}),
    _of("level_modelled_dbc", "level_modelled", {"weighting": "C"}),
)  # fmt: skip
_EVERY: Final = (
    *_COLUMNS,
    *(column for shown_column in _COLUMNS for column in _beside(shown_column)),
)

for _number, _column in enumerate(_EVERY):
    register(replace(_column, position=float(_number)))
