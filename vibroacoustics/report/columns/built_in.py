"""The columns that every comparison has, and further ones of the CSV: one line each."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ..study import has_inner_sources
from . import Column, Values


def _amplitude(name: str, order: int) -> Values:
    return lambda results: results[name].sel(order=order)


def _foot_force(results: xr.Dataset) -> xr.DataArray:
    return results["foot_force_amplitude"].sel(order=1).max("foot")


def _line(order: int, weighting: str) -> Values:
    return lambda results: results["order_level"].sel(order=order, weighting=weighting)


def _modelled(weighting: str) -> Values:
    return lambda results: results["level_modelled"].sel(weighting=weighting)


def _either(orders: Values, all_sources: str) -> Values:
    """Of the orders; where gas, keys and motor are modelled, of all sources as assumed."""
    return lambda results: results[all_sources] if has_inner_sources(results) else orders(results)


def _variable(name: str) -> Values:
    return lambda results: results[name]


def _quantile(name: str, quantile: float) -> Values:
    return lambda results: results[f"{name}_quantile"].sel(quantile=quantile)


def _level(value: float, results: xr.Dataset) -> str:
    return rounding.level(value)


def _change(value: float, results: xr.Dataset) -> str:
    return rounding.signed(value)


def _total_change(value: float, results: xr.Dataset) -> str:
    """To 0.001 dB; of all sources, which rest on assumed values, to 0.1 dB."""
    return rounding.signed(value, 1 if has_inner_sources(results) else 3)


def _orders_only(results: xr.Dataset) -> bool:
    return not has_inner_sources(results)


_modelled_level = _either(_modelled("A"), "level_all_sources")
_total_level = _either(_variable("level_total"), "level_whole")
_modelled_change = _either(_variable("change_modelled"), "change_all_sources")
_whole_change = _either(_variable("change_total"), "change_whole")
_drawn: Callable[[xr.Dataset], bool] = has_inner_sources

# fmt: off
_COLUMNS: Final = (
    Column("force_1x_n", _amplitude("force_amplitude", 1), "Force 1×, N", "1x N"),
    Column("force_2x_n", _amplitude("force_amplitude", 2), "Force 2×, N", "2x N"),
    Column("moment_1x_nm", _amplitude("moment_amplitude", 1), "Moment 1×, N m", "1x N m"),
    Column("foot_force_1x_n", _foot_force, "Foot force 1×, N", "foot 1x N"),
    Column("level_1x_db", _line(1, "Z"), "Level 1×, dB", "1x dB", _level),
    Column("level_2x_db", _line(2, "Z"), "Level 2×, dB", "2x dB", _level),
    Column("level_1x_dba", _line(1, "A"), "Level 1×, dB(A)", None, _level),
    Column("level_modelled_dba", _modelled_level, "Modelled level, dB(A)", "model dB(A)", _level),
    Column("level_total_dba", _total_level, "Total level, dB(A)", None, _level),
    Column("change_1x_db", _variable("change_1x"), "Δ 1×, dB", "Δ1x dB", _change, "level_1x_db"),
    Column("change_modelled_dba", _modelled_change, "Δ modelled, dB", None, _change, "level_modelled_dba"),  # noqa: E501
    Column("change_total_dba", _whole_change, "Δ total, dB", "Δtotal dB", _total_change),
    Column("level_modelled_db", _modelled("Z"), applies=_orders_only),
    Column("level_modelled_dbc", _modelled("C"), applies=_orders_only),
    Column("change_all_sources_10_percent_db", _quantile("change_all_sources", 0.1), applies=_drawn),  # noqa: E501
    Column("change_all_sources_50_percent_db", _quantile("change_all_sources", 0.5), applies=_drawn),  # noqa: E501
    Column("change_all_sources_90_percent_db", _quantile("change_all_sources", 0.9), applies=_drawn),  # noqa: E501
    Column("change_whole_10_percent_db", _quantile("change_whole", 0.1), applies=_drawn),
    Column("change_whole_50_percent_db", _quantile("change_whole", 0.5), applies=_drawn),
    Column("change_whole_90_percent_db", _quantile("change_whole", 0.9), applies=_drawn),
)
# fmt: on

for _number, _column in enumerate(_COLUMNS):
    register(replace(_column, position=float(_number)))
