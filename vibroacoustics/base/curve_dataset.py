"""A dataset of curves: each a variable with the words that its table and picture need."""

from collections.abc import Iterable, Mapping
from itertools import chain, count
from typing import Any

import numpy as np
import xarray as xr

from .arrays import Array
from .curves import Axis, Curve, in_words
from .errors import ParameterError
from .units import UNITS


def curves_dataset(curves: Iterable[Curve], attrs: Mapping[str, Any]) -> xr.Dataset:
    """Curves as variables of one dataset; an axis that differs from one of its name is renamed.

    Parameters
    ----------
    curves : each with a name of its own
    attrs : of the dataset

    Raises
    ------
    ParameterError
        Two curves have one name.
    """
    dataset = xr.Dataset(attrs=dict(attrs))
    for curve in curves:
        if curve.name in dataset.data_vars:
            raise ParameterError(f"curve {curve.name}: two have this name")
        axes = [_without_clash(axis, dataset) for axis in curve.axes]
        dataset = dataset.assign_coords({axis.name: _coordinate(axis) for axis in axes})
        dataset[curve.name] = xr.Variable(
            [axis.name for axis in axes],
            np.asarray(curve.values, dtype=float),
            {
                **_unit_attrs(curve.unit),
                "long_name": in_words(curve.name),
                "title": curve.title,
                "source": curve.source,
                "picture": curve.picture,
                **({"orders": list(curve.orders)} if curve.orders else {}),
            },
        )
    return dataset


def _without_clash(axis: Axis, dataset: xr.Dataset) -> Axis:
    """The axis under its name, or under the first number of it that is free or the same."""
    for name in chain([axis.name], (f"{axis.name}_{number}" for number in count(2))):
        if name not in dataset.coords or _same(dataset[name].values, axis):
            return axis._replace(name=name)
    raise AssertionError  # there is always a further number


def _same(values: Array, axis: Axis) -> bool:
    return bool(np.array_equal(values, np.asarray(axis.values)))


def _coordinate(axis: Axis) -> xr.Variable:
    label = axis.label or in_words(axis.name)
    if axis.words:
        return xr.Variable(axis.name, np.array(axis.values, dtype=str), {"long_name": label})
    values = np.asarray(axis.values, dtype=float)
    return xr.Variable(axis.name, values, {**_unit_attrs(axis.unit), "long_name": label})


def _unit_attrs(unit: str) -> dict[str, str]:
    """SI unit of the values, and the key of the one in which they are read."""
    si = UNITS[unit].si_suffix
    return {"units": UNITS[si].symbol or "1", "read_in": unit}


def shown(values: xr.DataArray) -> Array:
    """Numbers in the unit in which they are read.

    Parameters
    ----------
    values : variable or coordinate of a dataset of curves
    """
    return np.asarray(values.values / UNITS[values.attrs["read_in"]].factor)


def shown_label(values: xr.DataArray) -> str:
    """Label of an axis: words, then the unit in which they are read, where there is one."""
    label = str(values.attrs["long_name"])
    symbol = UNITS[values.attrs["read_in"]].symbol if "read_in" in values.attrs else ""
    return f"{label}, {symbol}" if symbol else label


def axis_words(coordinate: xr.DataArray) -> list[str]:
    """Values of an axis in words: these, or numbers with the unit in which they are read."""
    if "read_in" not in coordinate.attrs:
        return [str(word) for word in coordinate.values]
    symbol = UNITS[coordinate.attrs["read_in"]].symbol
    numbers = (f"{value:.4g}".replace("-", "−") for value in shown(coordinate))
    return [f"{number} {symbol}".strip() for number in numbers]
