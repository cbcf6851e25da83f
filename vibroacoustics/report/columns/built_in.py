"""The columns that every comparison has, and further ones of the CSV: one line each."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ..bands import QUANTILES, has_band, quantiles
from . import Column, Values


def _amplitude(name: str, order: int) -> Values:
    return lambda results: results[name].sel(order=order)


def _foot_force(results: xr.Dataset) -> xr.DataArray:
    return results["foot_force_amplitude"].sel(order=1).max("foot")


def _line(order: int, weighting: str) -> Values:
    return lambda results: results["order_level"].sel(order=order, weighting=weighting)


def _modelled(weighting: str) -> Values:
    return lambda results: results["level_modelled"].sel(weighting=weighting)


def _variable(name: str) -> Values:
    return lambda results: results[name]


def _quantile(name: str, quantile: float) -> Values:
    return lambda results: quantiles(results, name).sel(quantile=quantile)


def _quantiles(name: str, unit: str) -> Iterator[Column]:
    """`level_total_10_percent_dba` and the others of a band."""
    for share in QUANTILES:
        column = f"{name}_{100.0 * share:.0f}_percent_{unit}"
        yield Column(column, _quantile(name, share), applies=partial(has_band, name=name))


def _level(value: float, results: xr.Dataset) -> str:
    return rounding.level(value)


def _change(value: float, results: xr.Dataset) -> str:
    return rounding.signed(value)


# fmt: off
_COLUMNS: Final = (
    Column("force_1x_n", _amplitude("force_amplitude", 1), "Force 1×, N", "1x N", band="force_1x"),
    Column("force_2x_n", _amplitude("force_amplitude", 2), "Force 2×, N"),
    Column("moment_1x_nm", _amplitude("moment_amplitude", 1), "Moment 1×, N m", "1x N m", band="moment_1x"),  # noqa: E501
    Column("foot_force_1x_n", _foot_force, "Foot force 1×, N", "foot 1x N", band="foot_force_1x"),
    Column("level_1x_db", _line(1, "Z"), "Level 1×, dB", "1x dB", _level),
    Column("level_2x_db", _line(2, "Z"), "Level 2×, dB", None, _level),
    Column("level_1x_dba", _line(1, "A"), "Level 1×, dB(A)", None, _level),
    Column("level_modelled_dba", _modelled("A"), "Modelled level, dB(A)", "model dB(A)", _level, band="level_modelled"),  # noqa: E501
    Column("level_total_dba", _variable("level_total"), "Total level, dB(A)", None, _level, band="level_total"),  # noqa: E501
    Column("change_1x_db", _variable("change_1x"), "Δ 1×, dB", "Δ1x dB", _change, "level_1x_db"),
    Column("change_modelled_dba", _variable("change_modelled"), "Δ modelled, dB", None, _change, "level_modelled_dba", band="change_modelled"),  # noqa: E501
    Column("change_total_dba", _variable("change_total"), "Δ total, dB", "Δtotal dB", _change, band="change_total"),  # noqa: E501
    Column("level_modelled_db", _modelled("Z")),
    Column("level_modelled_dbc", _modelled("C")),
    *_quantiles("change_modelled", "db"),
    *_quantiles("change_total", "db"),
    *_quantiles("force_1x", "n"),
    *_quantiles("moment_1x", "nm"),
    *_quantiles("foot_force_1x", "n"),
    *_quantiles("level_modelled", "dba"),
    *_quantiles("level_total", "dba"),
)
# fmt: on

for _number, _column in enumerate(_COLUMNS):
    register(replace(_column, position=float(_number)))
