"""The vocabulary: dimensions, unit and long name of every variable that leaves a stage."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, TypeVar

import numpy as np
import xarray as xr

from .errors import SchemaError
from .registry import Registry

NOMINAL: Final = "nominal"
MEDIAN: Final = "median"
MEDIAN_STEP: Final = "median step"
MEAN: Final = "mean"
REPRESENTATIVE: Final = "representative"
STATISTICS: Final = (NOMINAL, MEDIAN, MEDIAN_STEP, MEAN, REPRESENTATIVE)
"""Statistic of a variable's value: nominal, the median or mean of the weighted samples, or that of
the representative sample. Of a variable in steps, median and interval are steps themselves."""
LOW: Final = "low"
HIGH: Final = "high"
SUFFIXES: Final = {LOW: "_10_percent", HIGH: "_90_percent", NOMINAL: "_nominal"}
"""Suffixes of variables beside a sampled one: ends of its interval, and the nominal value."""
_SUFFIX_WORDS: Final = {
    LOW: "10 % of the samples are below", HIGH: "90 % of the samples are below",
    NOMINAL: "nominal values",
}  # fmt: skip


LARGEST: Final = 1e30
"""Greatest value, whose squares are summed."""
LARGEST_LEVEL_DB: Final = 1e3
"""Greatest level, whose power is summed."""
BOUNDS: Final = {
    "dB": (-LARGEST_LEVEL_DB, LARGEST_LEVEL_DB),
    "Hz": (0.0, 1e9),
    "rpm": (-1e6, 1e6),
    "m": (-1e6, 1e6),
    "kg": (-1e9, 1e9),
    "sone": (0.0, 1e6),
    "acum": (0.0, 1e3),
}
"""Physical bounds by unit, of variables that name none; other units have the greatest value."""
YES_OR_NO: Final = (0.0, 1.0)
"""Bounds of variables that may hold truth values."""
_ROUNDING: Final = 1e-9


@dataclass(frozen=True)
class _Labelled:
    """Fields that variables and coordinates have in common.

    Attributes
    ----------
    name : in the dataset
    dims : names of its dimensions, each a coordinate
    units : ASCII; empty for text, and where the unit goes with the value
    long_name : plain words, ASCII, as not every reader of netCDF knows others
    missing : whether a value may be no number, where nothing is known
    bounds : least and greatest value; by default those of the unit
    """

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    missing: bool = field(default=False, kw_only=True)
    bounds: tuple[float, float] | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        if not (isinstance(self.dims, tuple) and all(isinstance(dim, str) for dim in self.dims)):
            raise SchemaError(f"{self.name}: dims = {self.dims!r}: must be a tuple of names")
        for text in (self.units, self.long_name):
            if not (isinstance(text, str) and text.isascii()):
                raise SchemaError(f"{self.name}: {text!r}: must be text in ASCII")

    @property
    def is_text(self) -> bool:
        """Whether a coordinate holds words: it has neither unit nor bounds."""
        return not self.units and self.bounds is None

    def check_numbers(self, array: xr.DataArray | xr.Variable) -> None:
        """Refuse what are no numbers within the bounds; of phasors each part is.

        Raises
        ------
        SchemaError
            Names the variable and its bounds.
        """
        kinds = "iufcb" if self.bounds == YES_OR_NO else "iufc"
        if array.dtype.kind not in kinds:
            raise SchemaError(f"{self.name} holds no numbers")
        lowest, highest = self.bounds or BOUNDS.get(self.units, (-LARGEST, LARGEST))
        slack = _ROUNDING * max(abs(lowest), abs(highest))
        values = array.values if array.dtype.kind == "c" else array.values.astype(float)
        for part in (values.real, values.imag) if np.iscomplexobj(values) else (values,):
            within = (lowest - slack <= part) & (part <= highest + slack)
            if not (within | np.isnan(part) if self.missing else within).all():
                raise SchemaError(
                    f"{self.name} holds no number, or one beyond {lowest:g} to {highest:g} "
                    f"{self.units}".rstrip()
                )


@dataclass(frozen=True)
class Variable(_Labelled):
    """A variable of a result.

    Attributes
    ----------
    complex_peak : whether its values are phasors, complex peaks
    statistic : statistic of its values in a run with samples: nominal ones, or medians or means

    Examples
    --------
    >>> depth = va.register(va.Coordinate("depth", ("depth",), "m", "depth below the floor"))
    >>> warmth = va.register(va.Variable("warmth", ("depth",), "K", "temperature of the soil"))
    >>> va.stamp("warmth", [281.0, 283.0], {"depth": [0.0, 1.0]}).attrs["units"]
    'K'
    """

    complex_peak: bool = False
    statistic: str = NOMINAL

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.statistic not in STATISTICS:
            raise SchemaError(f"{self.name}: statistic = {self.statistic!r}: is none")

    def of_samples(self) -> "list[Variable]":
        """Return the variables beside it: ends of the interval and nominal values; else none."""
        if self.statistic not in (MEDIAN, MEDIAN_STEP, MEAN):
            return []
        return [
            Variable(
                f"{self.name}{suffix}", self.dims, self.units,
                f"{self.long_name}; {_SUFFIX_WORDS[part]}", missing=self.missing,
                bounds=self.bounds,
            )
            for part, suffix in SUFFIXES.items()
        ]  # fmt: skip


@dataclass(frozen=True)
class Coordinate(_Labelled):
    """A coordinate of a result: values along a dimension, or what belongs to them.

    Examples
    --------
    >>> depth = va.register(va.Coordinate("depth", ("depth",), "m", "depth below the floor"))
    """


Labelled = TypeVar("Labelled", bound=_Labelled)
VARIABLES: Final[Registry[Variable]] = Registry(
    "variable", Variable, "name", "base.variables", "vibroacoustics.variables"
)
COORDINATES: Final[Registry[Coordinate]] = Registry(
    "coordinate", Coordinate, "name", "base.variables", "vibroacoustics.coordinates"
)
"""Apart from VARIABLES: what may be a coordinate may not stand among the variables."""

AXES: Final = ("x", "y", "z")
RIGID_BODY_DOFS: Final = ("tx", "ty", "tz", "rx", "ry", "rz")
"""Translations (m/s) and rotations (rad/s) along and about x, y, z at the centre of mass."""
WEIGHTINGS: Final = ("Z", "A", "C")
REFERENCE_OPTION: Final = "none"
"""The option against which changes are computed."""
GIVEN_SUPPLY: Final = "given by the study"
DERIVED_SUPPLY: Final = "derived from speed and slip"
"""Attribute `source` of the frequency of the motor's supply."""
PUBLISHED_LEVEL: Final = "level"
PUBLISHED_SHARE: Final = "spectral share"
"""Published data of a machine that weigh samples."""
NO_ANGLE_ZERO: Final = "none"
"""Attribute `angle_zero` of orders whose phases count from no mark on the shaft."""
DOF_UNIT_NOTE: Final = "unit of the translations; for rotations with rad in place of m"


def stamp(
    name: str, values: Any, coords: Mapping[str, Any] | None = None, **attrs: str
) -> xr.DataArray:
    """Label an array as the vocabulary's variable `name`.

    Parameters
    ----------
    name : name of a registered variable; it fixes the dims and the unit
    values : array whose shape follows those dims
    coords : coordinate values by name
    attrs : further attributes, such as `source`

    Raises
    ------
    SchemaError
        The name is unknown or the number of dimensions does not fit.

    Examples
    --------
    >>> level = va.stamp("level_unmodelled", 55.9, source="catalogue")
    >>> level.attrs["units"], level.attrs["source"]
    ('dB', 'catalogue')
    """
    variable = _look_up(VARIABLES, name)
    array = np.asarray(values)
    if array.ndim != len(variable.dims):
        raise SchemaError(f"{name}: has {array.ndim} dimensions, needs {variable.dims}")
    labelled = xr.DataArray(array, dims=variable.dims, coords=coords, name=name)
    labelled.attrs = {"units": variable.units, "long_name": variable.long_name, **attrs}
    if variable.complex_peak:
        labelled.attrs["phasor"] = "complex peak, x(t) = Re{X exp(+j w t)}"
    if "dof" in variable.dims:
        labelled.attrs["note"] = (
            "unit of the translations; rotations per m" if name == "mode_shape" else DOF_UNIT_NOTE
        )
    return labelled


def stamped(values: Mapping[str, Any], coords: Mapping[str, Any]) -> xr.Dataset:
    """Label arrays as variables of the vocabulary, each with the coordinates of its dimensions."""
    arrays = {}
    for name, array in values.items():
        dims = _look_up(VARIABLES, name).dims
        arrays[name] = stamp(name, array, {dim: coords[dim] for dim in dims})
    return check(xr.Dataset(arrays))


def check(dataset: xr.Dataset, required: Sequence[str] = ()) -> xr.Dataset:
    """Return the dataset if all of its variables obey the vocabulary.

    Parameters
    ----------
    dataset : any result
    required : names of variables that it must hold

    Raises
    ------
    SchemaError
        A variable is unknown, missing, has other dims or another unit, or is complex where
        it must not be.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.check(results) is results
    True
    """
    for name in required:
        if name not in dataset:
            raise SchemaError(f"variable {name} is missing")
    for key in dataset.data_vars:
        _check_variable(str(key), dataset.variables[key])
    for key in dataset.coords:
        _look_up(COORDINATES, str(key))
    return dataset


def label_coordinates(dataset: xr.Dataset) -> xr.Dataset:
    """Give every coordinate its unit and long name."""
    for name, coordinate in dataset.coords.items():
        variable = _look_up(COORDINATES, str(name))
        coordinate.attrs = {"long_name": variable.long_name}
        if variable.units:
            coordinate.attrs["units"] = variable.units
    return dataset


def _look_up(registry: Registry[Labelled], name: str) -> Labelled:
    labelled = registry.get(name)
    if labelled is None:
        raise SchemaError(f"{registry.noun} {name} is not in the vocabulary{registry.meant(name)}")
    return labelled


def _check_variable(name: str, array: xr.Variable) -> None:
    variable = _look_up(VARIABLES, name)
    if array.dims != variable.dims:
        raise SchemaError(f"{name}: dims are {array.dims}, must be {variable.dims}")
    unit = array.attrs.get("units")
    if not isinstance(unit, str) or unit != variable.units:
        raise SchemaError(f"{name}: unit is {unit!r}, must be {variable.units!r}")
    if np.iscomplexobj(array.data) != variable.complex_peak:
        raise SchemaError(f"{name}: must {'' if variable.complex_peak else 'not '}be complex")
