"""Numbers of one speed as the page holds them."""

from typing import Any

import numpy as np

from ..base.arrays import ComplexArray
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.baseline import left_of_squares
from .lines import Lines
from .mounts import is_over_frequency, stiffness_over_frequency
from .moving import Moving
from .numbers import FEW_BITS, LOAD_BITS, NOISE_BITS, Numbers
from .transmission import beside


def case_of(numbers: Numbers, lines: Lines, moving: Moving | None, speed: int) -> dict[str, Any]:
    """One speed with all options.

    Arrays are the numbers of their first elements in `numbers`, by option where nothing else is
    said: `rest` and `modelled` (microphone), beside the lines, `noise` (microphone, band),
    `pressure` beside that of the loads (microphone, line), `load` (line, 6), `weight` (line; force,
    moment; axis), `factor` (line); `vector` of all options (line, microphone, 6) and, by machine,
    `stiffness` over frequency (line, 21); with a baseline what the model leaves of it, `left`
    (microphone, line) and whether with its `phase`. A line that is no order has zeros. Where
    nothing moves there are `pressure`, as it sounds, and `modelled` with its lines.
    """
    case: dict[str, Any] = {
        "frequency": [round(float(hertz), 9) for hertz in lines.frequency_hz],
        "order": [None if np.isnan(order) else float(order) for order in lines.order],
        "rest": [numbers.put(of_option) for of_option in lines.continuous],
        "noise": [numbers.put(of_option, NOISE_BITS) for of_option in lines.noise],
    }
    if moving is None:
        return case | {
            "modelled": [
                numbers.put(values) for values in lines.modelled_continuous + lines.of_model
            ],
            "pressure": [numbers.put(values, FEW_BITS) for values in lines.pressure],
        }
    case["modelled"] = [numbers.put(of_option) for of_option in lines.modelled_continuous]
    return case | _moving_case(numbers, lines, moving, speed)


def _moving_case(numbers: Numbers, lines: Lines, moving: Moving, speed: int) -> dict[str, Any]:
    of_run, machines = moving.transmission, moving.machines
    load = [_by_line(lines, component) for component in of_run.load[speed]]
    factor = [machines.amplitude_factor(name, lines.frequency_hz) for name in machines.option]
    of_loads = np.array([_by_line(lines, component).T for component in of_run.pressure[speed]])
    others = beside(lines.modelled, of_loads)
    case: dict[str, Any] = {
        "vector": numbers.put(_by_line(lines, of_run.vector[speed]), FEW_BITS),
        "load": [numbers.put(component, LOAD_BITS) for component in load],
        "factor": [numbers.put_unless(values, 1.0) for values in factor],
        "pressure": [numbers.put_unless(other, 0.0, FEW_BITS) for other in others],
    }
    if np.any(lines.measured):
        none = list(machines.option).index(REFERENCE_OPTION)
        case["left"] = numbers.put(_left(lines, none), LOAD_BITS)
        case["phase"] = numbers.put(lines.has_phase)
    if moving.unit_loads is not None:
        weight = [_by_line(lines, component) for component in moving.unit_loads[speed]]
        case["weight"] = [numbers.put(component, LOAD_BITS) for component in weight]
    if any(map(is_over_frequency, machines.different)):
        at_lines = (
            stiffness_over_frequency(stiffness, lines.frequency_hz)
            for stiffness in machines.different
        )
        case["stiffness"] = [numbers.put(values, LOAD_BITS) for values in at_lines]
    return case


def _left(lines: Lines, none: int) -> ComplexArray:
    """Measured orders less the model without an option, (receiver, line), Pa.

    A difference of peaks where the phase is known, else of energies, as `changed_orders` has it.
    """
    before = lines.modelled[none]
    squares = left_of_squares(np.abs(lines.measured) ** 2, np.abs(before) ** 2)
    return np.where(lines.has_phase, lines.measured - before, np.sqrt(squares))


def _by_line(lines: Lines, values: ComplexArray) -> ComplexArray:
    """Values at the lines, of which the orders come first; zero at other lines."""
    by_order = np.moveaxis(values, -1, 0)
    is_kept = np.isfinite(lines.order) & (lines.order < len(by_order))
    chosen = np.where(is_kept, lines.order, 0).astype(int)
    shape = (-1, *[1] * (values.ndim - 1))
    return np.asarray(by_order[chosen] * is_kept.reshape(shape))
