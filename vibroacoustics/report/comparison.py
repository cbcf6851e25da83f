"""The comparison of the options: one value per option, speed and microphone."""

from collections.abc import Callable, Iterable
from itertools import product
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base import rounding
from ..schema import REFERENCE_OPTION
from .study import catalogue_receiver, first_order_hz, has_inner_sources, options, speeds
from .tables import Table, to_csv, to_text

HEADS: Final = {
    "force_1x_n": "Force 1×, N",
    "force_2x_n": "Force 2×, N",
    "moment_1x_nm": "Moment 1×, N m",
    "foot_force_1x_n": "Foot force 1×, N",
    "level_1x_db": "Level 1×, dB",
    "level_2x_db": "Level 2×, dB",
    "level_1x_dba": "Level 1×, dB(A)",
    "level_modelled_dba": "Modelled level, dB(A)",
    "level_total_dba": "Total level, dB(A)",
    "change_1x_db": "Δ 1×, dB",
    "change_modelled_dba": "Δ modelled, dB",
    "change_total_dba": "Δ total, dB",
}

COLUMNS: Final = tuple(HEADS)

_SOURCES: Final[dict[str, Callable[[xr.Dataset], xr.DataArray]]] = {
    "force_1x_n": lambda results: results["force_amplitude"].sel(order=1),
    "force_2x_n": lambda results: results["force_amplitude"].sel(order=2),
    "moment_1x_nm": lambda results: results["moment_amplitude"].sel(order=1),
    "foot_force_1x_n": lambda results: results["foot_force_amplitude"].sel(order=1).max("foot"),
    "level_1x_db": lambda results: results["order_level"].sel(order=1, weighting="Z"),
    "level_2x_db": lambda results: results["order_level"].sel(order=2, weighting="Z"),
    "level_1x_dba": lambda results: results["order_level"].sel(order=1, weighting="A"),
    "level_modelled_dba": lambda results: results["level_modelled"].sel(weighting="A"),
    "level_total_dba": lambda results: results["level_total"],
    "change_1x_db": lambda results: results["change_1x"],
    "change_modelled_dba": lambda results: results["change_modelled"],
    "change_total_dba": lambda results: results["change_total"],
}

_OF_ALL_SOURCES: Final = {
    "level_modelled_dba": "level_all_sources",
    "level_total_dba": "level_whole",
    "change_modelled_dba": "change_all_sources",
    "change_total_dba": "change_whole",
}
"""Variables of these columns where gas, keys and motor are modelled, at the assumed values."""

_TERMINAL: Final = {
    "force_1x_n": "1x N",
    "force_2x_n": "2x N",
    "moment_1x_nm": "1x N m",
    "foot_force_1x_n": "foot 1x N",
    "level_1x_db": "1x dB",
    "level_2x_db": "2x dB",
    "level_modelled_dba": "model dB(A)",
    "change_1x_db": "Δ1x dB",
    "change_total_dba": "Δtotal dB",
}


_BESIDE: Final[dict[str, str]] = {"level_modelled_db": "Z", "level_modelled_dbc": "C"}
"""Further columns of the CSV: the level of the modelled orders in the other weightings."""

_BANDS: Final = ("change_all_sources", "change_whole")
"""Further columns of the CSV with inner sources, as quantiles over the draws."""


def column(results: xr.Dataset, name: str) -> xr.DataArray:
    """One column over option, speed and, for levels, receiver; the unit is in its name."""
    if has_inner_sources(results) and name in _OF_ALL_SOURCES:
        return results[_OF_ALL_SOURCES[name]].reset_coords(drop=True)
    return _SOURCES[name](results).reset_coords(drop=True)


def comparison(results: xr.Dataset) -> xr.Dataset:
    """The columns of `comparison.csv` as variables over (option, speed, receiver).

    Forces in N and moments in N m are semi-major axes, peak; the foot force is the largest over
    the feet; levels in dB re 20 µPa.
    """
    columns = xr.Dataset({name: column(results, name) for name in COLUMNS})
    return columns.broadcast_like(columns["level_total_dba"]).transpose(
        "option", "speed", "receiver"
    )


def comparison_csv(results: xr.Dataset) -> bytes:
    """One row per option, speed and microphone, to nine significant digits."""
    compared = comparison(results)
    receivers = [str(name) for name in compared["receiver"].values]
    keys: Iterable[tuple[str | float, ...]] = product(options(results), speeds(results), receivers)
    beside = _beside(results)
    arrays = [
        *(compared[name] for name in COLUMNS),
        *(values.transpose("option", "speed", "receiver") for values in beside.values()),
    ]
    values = zip(*(array.values.ravel() for array in arrays), strict=True)
    rows = [(*key, *map(float, row)) for key, row in zip(keys, values, strict=True)]
    return to_csv(("option", "speed_rpm", "receiver", *COLUMNS, *beside), rows)


def _beside(results: xr.Dataset) -> dict[str, xr.DataArray]:
    """Further columns: other weightings of the orders, or bands of the changes."""
    if not has_inner_sources(results):
        modelled = results["level_modelled"]
        return {name: modelled.sel(weighting=weighting) for name, weighting in _BESIDE.items()}
    return {
        f"{name}_{100.0 * quantile:.0f}_percent_db": results[f"{name}_quantile"].sel(
            quantile=quantile
        )
        for name in _BANDS
        for quantile in results["quantile"].values
    }


def comparison_tables(results: xr.Dataset, receiver: str) -> list[Table]:
    """One table per speed, rounded for reading."""
    return _tables(results, receiver, HEADS)


def comparison_text(results: xr.Dataset) -> str:
    """Compact plain-text tables for the terminal, at the catalogue's microphone."""
    tables = _tables(results, catalogue_receiver(results), _TERMINAL)
    return "\n".join(to_text(table) for table in tables)


def _tables(results: xr.Dataset, receiver: str, heads: dict[str, str]) -> list[Table]:
    compared = comparison(results).sel(receiver=receiver)
    numbers = {name: compared[name].transpose("speed", "option").values for name in COLUMNS}
    reference = options(results).index(REFERENCE_OPTION)
    pairs = zip(speeds(results), first_order_hz(results), strict=True)
    uncertain = {"change_total_dba": _rough_change} if has_inner_sources(results) else {}
    cells = {**_CELLS, **uncertain}
    return [
        Table(
            f"{speed:g} rpm (1× at {frequency:.1f} Hz), microphone {receiver}",
            ("Option", *heads.values()),
            tuple(
                (option, *_cells(_at(numbers, i, j), _at(numbers, i, reference), cells, heads))
                for j, option in enumerate(options(results))
            ),
        )
        for i, (speed, frequency) in enumerate(pairs)
    ]


_Numbers = dict[str, float]
_Cell = Callable[[_Numbers, _Numbers, str], str]


def _at(numbers: dict[str, NDArray[np.float64]], speed: int, option: int) -> _Numbers:
    return {name: float(values[speed, option]) for name, values in numbers.items()}


def _cells(
    own: _Numbers, reference: _Numbers, cells: dict[str, _Cell], names: Iterable[str]
) -> Iterable[str]:
    return (cells[name](own, reference, name) for name in names)


def _amount(own: _Numbers, reference: _Numbers, name: str) -> str:
    return rounding.significant(own[name])


def _level(own: _Numbers, reference: _Numbers, name: str) -> str:
    return rounding.level(own[name])


def _change_of(level_name: str) -> _Cell:
    def cell(own: _Numbers, reference: _Numbers, name: str) -> str:
        return rounding.level_change(own[name], own[level_name], reference[level_name])

    return cell


def _total_change(own: _Numbers, reference: _Numbers, name: str) -> str:
    return rounding.signed(own[name], 3)


def _rough_change(own: _Numbers, reference: _Numbers, name: str) -> str:
    return rounding.signed(own[name])


_CELLS: Final[dict[str, _Cell]] = {
    "force_1x_n": _amount,
    "force_2x_n": _amount,
    "moment_1x_nm": _amount,
    "foot_force_1x_n": _amount,
    "level_1x_db": _level,
    "level_2x_db": _level,
    "level_1x_dba": _level,
    "level_modelled_dba": _level,
    "level_total_dba": _level,
    "change_1x_db": _change_of("level_1x_db"),
    "change_modelled_dba": _change_of("level_modelled_dba"),
    "change_total_dba": _total_change,
}
