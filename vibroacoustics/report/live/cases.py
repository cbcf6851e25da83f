"""Numbers of one speed as the page holds them."""

from typing import Any

import numpy as np

from ...base.arrays import Array, ComplexArray
from .lines import Lines
from .moving import Moving
from .numbers import FEW_BITS, FULL_BITS, NOTHING, Numbers

DIGITS = 8
"""Of energies, which are summed."""


def case_of(numbers: Numbers, lines: Lines, moving: Moving | None, speed: int) -> dict[str, Any]:
    """One speed with all options.

    Arrays are the numbers of their first elements in `numbers`, by option: `pressure` (microphone,
    line), `load` (line, 6), `vector` (line, microphone, 6), per velocity where mounts vary and per
    load elsewhere, `weight` (line; forces at 0° and 90°, moment; axis), `factor` (line), `noise`
    (microphone, band). A line that is no order has zeros.

    Parameters
    ----------
    numbers : keeps the arrays
    lines : of the speed
    moving : none where nothing moves
    speed : its number
    """
    mounted = moving is not None and moving.mounts is not None
    case: dict[str, Any] = {
        "frequency": [round(float(hertz), 9) for hertz in lines.frequency_hz],
        "order": [None if np.isnan(order) else float(order) for order in lines.order],
        "rest": _rounded(lines.rest),
        "modelled": _rounded(lines.modelled_rest),
        "noise": [numbers.put(of_option, FEW_BITS) for of_option in lines.noise],
        "pressure": [NOTHING if mounted else numbers.put(one) for one in lines.pressure],
    }
    if moving is None:
        return case
    vectors = moving.transmission.vector[None] if mounted else moving.pressure_per_load
    for o, option in enumerate(moving.machines.option):
        machine = 0 if mounted else moving.machines.number(option)
        parts = {"vector": (vectors[machine, speed], FEW_BITS)}
        if mounted:
            parts["load"] = (moving.transmission.load[speed, o], FULL_BITS)
        if moving.unit_loads is not None:
            parts["weight"] = (moving.unit_loads[speed, o], FULL_BITS)
        for name, (values, bits) in parts.items():
            case.setdefault(name, []).append(numbers.put(_by_line(lines, values), bits))
        factor = moving.machines.amplitude_factor(option, lines.frequency_hz)
        case.setdefault("factor", []).append(numbers.put_unless(factor, 1.0))
    return case


def _by_line(lines: Lines, values: ComplexArray) -> ComplexArray:
    """Of values whose last axis is the order, those of the lines, which come first; else zero."""
    by_order = np.moveaxis(values, -1, 0)
    known = np.isfinite(lines.order) & (lines.order < len(by_order))
    chosen = np.where(known, lines.order, 0).astype(int)
    shape = (-1, *[1] * (values.ndim - 1))
    return np.asarray(by_order[chosen] * known.reshape(shape))


def _rounded(values: Array) -> list[list[float]]:
    return [[float(f"{value:.{DIGITS}g}") for value in row] for row in values]
