"""Forces and moments as spectra at whole orders, datasets 58 and 58b of function type 12."""

from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from ...base.arrays import ComplexArray, IndexArray
from ...base.errors import ParameterError, StorageError
from ...base.units import shaft_frequency_hz
from .spectra import COMPONENTS, Spectra

if TYPE_CHECKING:
    from ...recordings.measured_function import MeasuredFunction

TIME: Final = 1
"""Function type of a course over time."""
OFF_ORDER: Final = 1e-3
"""Largest distance of a frequency from a whole order."""


def holds_spectra(path: Path) -> bool:
    """Whether a universal file has no course over time; also false where it cannot be read."""
    from ...recordings.uff58 import datasets

    try:
        with path.open("rb") as file:
            every = datasets(file).functions
    except (OSError, ParameterError, StorageError):
        return False
    return bool(every) and all(header.function_type != TIME for header in every)


def read_spectra(path: Path, speed_rpm: float) -> Spectra:
    """Complex peaks at whole orders; every node is a source, what is not there is zero.

    Forces are along `x`, `y`, `z`, moments about `rx`, `ry`, `rz` of their node.

    Parameters
    ----------
    path : universal file
    speed_rpm : at which it holds

    Raises
    ------
    ParameterError
        It cannot be read, holds no such spectrum, or a frequency is no whole order.
    """
    from ...recordings.functions import read_functions

    try:
        functions = read_functions(path)
    except StorageError as error:
        raise ParameterError(*error.args) from None
    parts: dict[str, dict[str, tuple[IndexArray, ComplexArray]]] = {}
    for one in functions:
        if one.kind == "spectrum" and one.response_unit in ("N", "N m"):
            try:
                component, order = _component(one), _orders(one, speed_rpm)
            except ParameterError as error:
                raise ParameterError(f"{path}: {one}: {error}") from None
            known = parts.setdefault(str(one.response.number), {})
            if component in known:
                raise ParameterError(f"{path}: {one}: is there twice")
            sign = -1.0 if one.response.direction[0] == "-" else 1.0
            known[component] = order, sign * one.values
    if not parts:
        raise ParameterError(f"{path}: holds no spectrum in N or N m")
    highest = max(int(order.max()) for of in parts.values() for order, _ in of.values())
    orders = np.zeros((1, len(parts), len(COMPONENTS), highest + 1), dtype=complex)
    for row, of_source in enumerate(parts.values()):
        for component, (order, values) in of_source.items():
            orders[0, row, COMPONENTS.index(component), order] = values
    return Spectra((speed_rpm,), tuple(parts), orders)


def _component(one: "MeasuredFunction") -> str:
    axis = one.response.direction
    component = f"{'m' if axis[1:2] == 'r' else 'f'}{axis[-1:]}"
    if component not in COMPONENTS or (component[0] == "m") != (one.response_unit == "N m"):
        raise ParameterError(
            f"unit {one.response_unit}: must be N along x, y, z or N m about rx, ry, rz"
        )
    return component


def _orders(one: "MeasuredFunction", speed_rpm: float) -> IndexArray:
    order = one.frequency_hz / shaft_frequency_hz(speed_rpm)
    off = np.abs(order - np.rint(order))
    if off.max() > OFF_ORDER:
        at = int(off.argmax())
        raise ParameterError(
            f"{one.frequency_hz[at]:g} Hz is order {order[at]:.4g} at {speed_rpm:g} rpm: must be "
            "a whole order"
        )
    return np.rint(order).astype(np.intp)
