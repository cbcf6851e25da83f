"""Inner curves of a machine over a crank angle, a speed or a length, and their dataset."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, count
from typing import Any, Final, Literal, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .arrays import Array
from .errors import ParameterError
from .units import UNITS

CRANK_ANGLES: Final = 720
"""Samples a revolution where a curve may choose: half a degree."""
MOST_AXES: Final = 3
ORBIT_AXES: Final = ("x", "y")


class CurveAxis(NamedTuple):
    """Abscissa of a curve, or the quantity that parts its lines or panels.

    Attributes
    ----------
    name : name of the dimension
    values : numbers in SI, or words
    unit : key of `units.UNITS` in which they are read; empty for words
    label : in a picture; the name in words where empty

    Examples
    --------
    >>> va.CurveAxis("crank_angle", np.linspace(0.0, 6.0, 4), "deg").words
    False
    """

    name: str
    values: NDArray[np.floating[Any]] | Sequence[str]
    unit: str = ""
    label: str = ""

    @property
    def words(self) -> bool:
        """Whether the values are words."""
        return not np.issubdtype(np.asarray(self.values).dtype, np.number)


@dataclass(frozen=True)
class Curve:
    """A curve, a family of curves, or families of curves in panels.

    Attributes
    ----------
    name : name of the variable, and of its table and picture
    title : quantity that is shown, in words
    values : SI, shape (...), one dimension for each axis
    axes : the last is the abscissa, the one before parts the lines, the first of three the panels
    unit : key of `units.UNITS` in which the values are read
    source : document and figure or equation that it repeats; or what it is derived from
    picture : lines over the abscissa; or an orbit, the second of two axes `x`, `y` over the first,
        in a circle of one
    orders : shaft orders that a map of frequencies over the speed shows as lines

    Examples
    --------
    >>> angle = np.linspace(0.0, 6.0, 4)
    >>> axis = va.CurveAxis("crank_angle", angle, "deg", "Crank angle, degrees")
    >>> curve = va.Curve("pin_force", "Force on the pin", np.cos(angle), (axis,), "n", "derived")
    >>> curve.values.shape
    (4,)
    """

    name: str
    title: str
    values: Array
    axes: tuple[CurveAxis, ...]
    unit: str
    source: str
    picture: Literal["lines", "orbit"] = "lines"
    orders: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if reason := next(filter(None, self._reasons()), None):
            raise ParameterError(f"curve {self.name}: {reason}")

    def _reasons(self) -> Iterator[str | None]:
        """Yield what is wrong; later checks assume that the earlier ones passed."""
        if not self.name.isidentifier() or not self.title or not self.source:
            yield "name, title and source must be said, the name as a word of letters, digits, _"
        most = MOST_AXES + (self.picture == "orbit")
        if not 1 <= len(self.axes) <= most:
            yield f"{len(self.axes)} axes; allowed 1 to {most}"
        shape = tuple(len(axis.values) for axis in self.axes)
        if np.shape(self.values) != shape or 0 in shape:
            yield f"values of shape {np.shape(self.values)} over axes of {shape}"
        numbers = [(self.unit, self.values)]
        numbers += [(axis.unit, np.asarray(axis.values)) for axis in self.axes if not axis.words]
        for unit, values in numbers:
            if unit not in UNITS:
                yield f"unit {unit}: {UNITS.unknown(unit)}"
            if not np.all(np.isfinite(values)):
                yield "values must be finite"
        if self.picture == "orbit":
            yield self._why_no_orbit()

    def _why_no_orbit(self) -> str | None:
        fits = len(self.axes) >= 2 and tuple(self.axes[-2].values) == ORBIT_AXES
        return None if fits else "an orbit needs x and y as the last axis but one"


def angle_axis(
    crank_angle: Array, name: str = "crank_angle", label: str = "Crank angle"
) -> CurveAxis:
    """Crank angle, rad, shape (samples,), as an abscissa."""
    return CurveAxis(name, crank_angle, "deg", label)


def in_words(name: str) -> str:
    """A variable's name as the words of a label."""
    text = name.replace("_", " ")
    return text[:1].upper() + text[1:]


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
