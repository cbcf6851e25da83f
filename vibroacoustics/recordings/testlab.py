"""Signals of Simcenter Testlab in a MAT file: structs with `x_values` and `y_values`.

Testlab stores samples in SI units and, with the label of the displayed unit, the factor from one to
the other: displayed = stored · `unit_transformation.factor`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..base.errors import ParameterError, StorageError
from .array_columns import Column, samples_of_parts, stored_limits
from .axes import Axis, line_of
from .named_arrays import NamedArray
from .quantities import find_quantity, find_time_factor
from .recorded import Recorded, Request, check_size, listed, numbered

VALUES: Final = "y_values.values"
INCREMENT: Final = "x_values.increment"
_AXIS_LABEL: Final = "x_values.quantity.label"
_LABEL: Final = "y_values.quantity.label"
_FACTOR: Final = "y_values.quantity.unit_transformation.factor"
_OFFSET: Final = "y_values.quantity.unit_transformation.offset"
_NAME: Final = "function_record.name"
_LENGTH: Final = "x_values.number_of_values"
_START: Final = "x_values.start_value"
_AXIS_FACTOR: Final = "x_values.quantity.unit_transformation.factor"
_FIT: Final = 1e-3


@dataclass(frozen=True)
class Struct:
    """A struct of a MAT file, by the paths of its fields.

    Attributes
    ----------
    name : name of the variable
    numbers : arrays of numbers by their path in the struct
    texts : texts of one field: one text, or those of a cell
    """

    name: str
    numbers: Mapping[str, NamedArray]
    texts: Callable[[str], Sequence[str]]

    @property
    def is_signal(self) -> bool:
        """Whether Testlab wrote it."""
        return VALUES in self.numbers and INCREMENT in self.numbers

    def number(self, path: str, default: float | None = None) -> float:
        """One number of the struct; a text that is one counts too."""
        if path not in self.numbers and default is not None:
            return default
        values = np.asarray(self.numbers[path].values()).ravel()
        if values.size != 1:
            raise StorageError(f"{self.name}.{path} has {values.size} values, not one")
        return float(values[0])


@dataclass(frozen=True)
class _Signal:
    """One channel of such a struct."""

    column: Column
    axis: Axis
    factor: float


def recorded_signals(structs: Sequence[Struct], request: Request) -> Recorded:
    """The recording that signals of Testlab make.

    Raises
    ------
    ParameterError
        None is a function of time, or channels differ in length or rate.
    StorageError
        A signal claims another number of samples than it holds.
    """
    signals = [
        signal for struct in structs if _is_time(struct) for signal in _signals(struct, request)
    ]
    if not signals:
        axes = sorted({"".join(struct.texts(_AXIS_LABEL)) for struct in structs})
        raise ParameterError(f"holds no function of time, only of {listed(axes)}")
    names = numbered([signal.column.name for signal in signals])
    units = [signal.column.unit for signal in signals]
    omissions = request.omissions(names, units)
    chosen = request.chosen(names, units)
    if not chosen:
        raise ParameterError("no channel is chosen")
    names, signals = [names[c] for c in chosen], [signals[c] for c in chosen]
    line = line_of(names, [signal.axis for signal in signals], request)
    check_size(len(names), line.last - line.first)
    columns = [signal.column for signal in signals]
    stored = samples_of_parts(columns, line.parts)
    units = [column.unit for column in columns]
    return line.recorded(
        names,
        units,
        stored,
        remarks=[*omissions, *_remarks(names, signals)],
        limits=stored_limits(columns, stored, line),
        calibration=[signal.factor for signal in signals],
    )


def _is_time(struct: Struct) -> bool:
    """Whether the axis is a time; a label other than s needs the factor from the stored SI unit."""
    factor = find_time_factor("".join(struct.texts(_AXIS_LABEL)).strip() or "s")
    if factor is None:
        return False
    return abs(factor * struct.number(_AXIS_FACTOR, 1.0) - 1.0) < _FIT


def _signals(struct: Struct, request: Request) -> list[_Signal]:
    values = struct.numbers[VALUES]
    if not values.may_be_channels:
        raise StorageError(f"{struct.name}.{VALUES} has the shape {values.shape}")
    width = min(values.shape) if len(values.shape) == 2 else 1
    increment_s = struct.number(INCREMENT)
    if not 0.0 < increment_s < np.inf:
        raise StorageError(f"{struct.name}.{INCREMENT} = {increment_s:g} s: must be above zero")
    claimed = struct.number(_LENGTH, float(max(values.shape)))
    if claimed != max(values.shape):
        raise StorageError(
            f"{struct.name} claims {claimed:.12g} samples and holds {max(values.shape)}"
        )
    if struct.number(_OFFSET, 0.0) != 0.0:
        raise ParameterError(f"{struct.name}: its unit has an offset: export it in SI units")
    names, units = _spread(struct, _NAME, width, struct.name), _spread(struct, _LABEL, width, "")
    along, factor = values.time_axis, struct.number(_FACTOR, 1.0)
    rate_hz = request.sample_rate_hz or 1.0 / increment_s
    axis = Axis(max(values.shape), rate_hz, struct.number(_START, 0.0))
    return [
        _Signal(Column(name, unit, values, index, along), axis, factor)
        for index, (name, unit) in enumerate(zip(names, units, strict=True))
    ]


def _spread(struct: Struct, path: str, width: int, default: str) -> list[str]:
    """One text a channel; one that is stated once holds for all."""
    texts = [text.strip() or default for text in struct.texts(path)] or [default]
    return texts * width if len(texts) == 1 else [*texts, *[default] * width][:width]


def _remarks(names: Sequence[str], signals: Sequence[_Signal]) -> list[str]:
    """A line for each channel whose factor does not take SI units to the unit of its label."""
    lines = []
    for name, signal in zip(names, signals, strict=True):
        measured: Any = find_quantity(signal.column.unit)
        if measured is not None and abs(signal.factor * measured.factor - 1.0) > _FIT:
            lines.append(
                f"channel {name!r}: factor {signal.factor:g} does not take SI units to "
                f"{signal.column.unit!r}: check the level, or give unit and calibration"
            )
    return lines
