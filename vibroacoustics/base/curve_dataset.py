"""A dataset of curves: each a variable with the words that its table and picture need."""

from collections.abc import Iterable, Mapping
from itertools import chain, count
from typing import Any

import numpy as np
import xarray as xr

from .arrays import Array
from .curves import Curve, CurveAxis, in_words
from .errors import ParameterError
from .units import UNITS


def curves_dataset(curves: Iterable[Curve], attrs: Mapping[str, Any]) -> xr.Dataset:
    """Curves as variables of one dataset; an axis that differs from one of its name is renamed.


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


def _without_clash(axis: CurveAxis, dataset: xr.Dataset) -> CurveAxis:
    """The axis under its name, or under the first number of it that is free or the same."""
    for name in chain([axis.name], (f"{axis.name}_{number}" for number in count(2))):
        if name not in dataset.coords or _same(dataset[name].values, axis):
            return axis._replace(name=name)
    raise AssertionError  # there is always a further number


def _same(values: Array, axis: CurveAxis) -> bool:
    return bool(np.array_equal(values, np.asarray(axis.values)))


def _coordinate(axis: CurveAxis) -> xr.Variable:
    label = axis.label or in_words(axis.name)
    if axis.words:
        return xr.Variable(axis.name, np.array(axis.values, dtype=str), {"long_name": label})
    values = np.asarray(axis.values, dtype=float)
    return xr.Variable(axis.name, values, {**_unit_attrs(axis.unit), "long_name": label})


def _unit_attrs(suffix: str) -> dict[str, str | float]:
    """SI unit of the values; symbol of the one in which they are read, and its factor."""
    unit = UNITS[suffix]
    si = UNITS[unit.si_suffix].symbol or "1"
    return {"units": si, "read_in": unit.symbol, "read_factor": unit.factor}


def shown(values: xr.DataArray) -> Array:
    """Numbers in the unit in which they are read."""
    return np.asarray(values.values / values.attrs["read_factor"])


def shown_label(values: xr.DataArray) -> str:
    """Label of an axis: words, then the unit in which they are read, where there is one."""
    label, symbol = str(values.attrs["long_name"]), values.attrs.get("read_in")
    return f"{label}, {symbol}" if symbol else label


def is_words(coordinate: xr.DataArray) -> bool:
    """Whether an axis holds words in place of numbers."""
    return "read_factor" not in coordinate.attrs


def axis_words(coordinate: xr.DataArray) -> list[str]:
    """Values of an axis in words: these, or numbers with the unit in which they are read."""
    if is_words(coordinate):
        return [str(word) for word in coordinate.values]
    numbers = (f"{value:.4g}".replace("-", "−") for value in shown(coordinate))
    return [f"{number} {coordinate.attrs['read_in']}".strip() for number in numbers]
