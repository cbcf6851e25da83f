"""UFF dataset 58 (ASCII and binary), time responses."""

from collections.abc import Sequence
from functools import lru_cache
from typing import BinaryIO, Final

import numpy as np

from ...base.errors import ParameterError
from ...base.registry import register
from ..axes import Axis, line_of
from ..quantities import axis_factor
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, check_size, numbered
from ..uff58 import DOUBLE, SINGLE, Datasets, Header, datasets
from ..uff58_values import values

TIME_RESPONSE: Final = 1
"""Function type in record 6, field 1."""
_KEPT: Final = 4
"""Parts of an axis that are kept: its ends, and what is looked at and then read."""
_INFINITE: Final = 1.797e308
_TIMES: Final = (0, 1, 17)
"""Specific data types of an abscissa that may be a time: unknown, general, time."""
_AXES: Final = {
    8: "a displacement", 11: "a velocity", 12: "an acceleration", 13: "a force",
    15: "a pressure", 18: "a frequency", 19: "a speed in rpm", 20: "an order",
}  # fmt: skip
"""Other specific data types."""


def read(request: Request) -> Recorded:
    """Time responses of a universal file; the sample rate is 1 over the abscissa increment.

    An ASCII file stores that increment with six digits, so the rate is no better.
    """
    with request.path.open("rb") as file:
        contents = datasets(file)
        responses = _time_responses(contents)
        names = numbered([header.name or "channel" for header in responses])
        units = [header.unit for header in responses]
        remarks = [*contents.remarks, *request.omissions(names, units)]
        chosen = request.chosen(names, units)
        names, responses = [names[c] for c in chosen], [responses[c] for c in chosen]
        units = [units[c] for c in chosen]
        _check_first(responses, request)
        axes = [_axis(file, name, h) for name, h in zip(names, responses, strict=True)]
        line = line_of(names, _shared(axes), request)
        check_size(len(names), line.last - line.first)
        stored = [
            _with_infinity(values(file, header, *part)[0])
            for header, part in zip(responses, line.parts, strict=True)
        ]
    return line.recorded(names, units, stored, responses[0].start_time, remarks)


def _with_infinity(samples: Samples) -> Samples:
    """Samples of which the largest number of doubles, which pyuff writes for infinity, is that."""
    if samples.dtype.itemsize < np.dtype(float).itemsize or not samples.size:
        return samples
    is_infinite = np.abs(samples) >= _INFINITE
    return np.where(is_infinite, np.inf, samples) if is_infinite.any() else samples


def _time_responses(contents: Datasets) -> list[Header]:
    responses = [header for header in contents.functions if header.function_type == TIME_RESPONSE]
    types = sorted({header.function_type for header in contents.functions})
    if types and not responses:
        raise ParameterError(
            f"holds no time response (function type 1), only functions of type {types}"
        )
    if not responses:
        kinds = ", ".join(map(str, sorted(set(contents.kinds)))) or "none"
        raise ParameterError(f"holds no time response (dataset 58); its datasets: {kinds}")
    if any(header.ordinate_type not in (SINGLE, DOUBLE) for header in responses):
        raise ParameterError("holds a complex time response: no real numbers")
    return responses


def _check_first(responses: Sequence[Header], request: Request) -> None:
    if not responses:
        raise ParameterError("no channel is chosen")
    check_size(0, 0 if not request.wants_all else responses[0].points)


def _axis(file: BinaryIO, name: str, header: Header) -> Axis:
    """Time axis of a response.

    Raises
    ------
    ParameterError
        The abscissa is no time.
    """
    if header.axis_type not in _TIMES:
        kind = _AXES.get(header.axis_type, f"type {header.axis_type}")
        raise ParameterError(
            f"channel {name!r}: its abscissa is {kind}, unit {header.axis_unit or 'none'!r}: a "
            "recording needs a time"
        )
    factor = axis_factor(f"channel {name!r}: its abscissa", header.axis_unit or "s")
    if header.is_even:
        rate_hz = _rate_hz(factor * header.increment)
        return Axis(header.points, rate_hz, factor * header.minimum)

    @lru_cache(_KEPT)
    def times(first: int, last: int) -> Samples:
        _, abscissas = values(file, header, first, last)
        assert abscissas is not None  # noqa: S101 - the abscissa is uneven
        return abscissas * factor

    return Axis(header.points, None, 0.0, times)


def _shared(axes: Sequence[Axis]) -> list[Axis]:
    """Axes of which equal uneven ones are one."""
    first = axes[0]
    if first.times is None or any(axis.times is None for axis in axes):
        return list(axes)
    if len({axis.samples for axis in axes}) > 1:
        return list(axes)
    times = first.times(0, first.samples)
    others = (axis.times(0, axis.samples) for axis in axes[1:] if axis.times is not None)
    return [first] * len(axes) if all(np.array_equal(t, times) for t in others) else list(axes)


def _rate_hz(increment: float) -> float:
    if not increment > 0.0:
        raise ParameterError(f"abscissa increment {increment} s: must be above zero")
    return 1.0 / increment


register(Reader("uff", (".uff", ".unv", ".ufb", ".bunv", ".uf"), "UFF", read))
