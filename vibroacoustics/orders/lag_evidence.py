"""Evidence for a lag of a speed: distances of lines from orders, and where the sound departs."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..base.arrays import Array
from .speed_lag import SpeedLag

_DEPARTURE_TURNS: Final = 1.0
"""Change of the phase within a block that a resonance or a filter cannot make."""
_BLOCK_REVOLUTIONS: Final = 16.0
_DEPARTURE_SCATTER: Final = 10.0
_DEPARTURE_BLOCKS: Final = 4
"""Blocks in a row that depart: a line that crosses is not as long in all orders."""
_FINE_ORDERS: Final = 5.0
_NEAR_ORDER: Final = 0.03
_ALIKE: Final = 0.15
_LINE_ERROR: Final = 4e-3
_LEAST_SCALE: Final = 1e-3
_LEAST_SLOPE: Final = 0.02
"""Distances of lines from orders that have one scale, relative, and f'/f in 1/s from which a lag
follows from it."""
_DECAY: Final = 0.05
"""Scatter of f'/f, relative, below which it is constant: noise alone then correlates with it."""
_ON_ORDER: Final = 0.01
OFF_ORDER: Final = 0.03
"""Distance from multiples of 1/2 by which a lag may move lines: one line of the spectra."""
LEAST_LINES: Final = 2


def scale_lag(lag: SpeedLag) -> float:
    """Lag in s by which lines are beside orders, of a speed that decays; 0 without one.

    Where f'/f is constant, a lag changes the scale of the orders only: at least two lines must be
    at the same distance, relative, from multiples of 1/2 below order 5 and of 1 above.
    """
    lines = lag.unmoved_lines
    if not lines.size:
        return 0.0
    nearest = np.where(lines < _FINE_ORDERS, 0.5 * np.rint(2.0 * lines), np.rint(lines))
    off = np.log(lines / np.maximum(nearest, 0.5))
    error = _LINE_ERROR / lines
    alike = np.abs(off - off[:, None]) < _ALIKE * np.abs(off)[:, None] + error
    most = alike[int(np.argmax(alike @ lines))] & (np.abs(off) < _NEAR_ORDER)
    is_sure = np.count_nonzero(most) >= max(LEAST_LINES, 0.5 * lines.size)
    is_sure |= lines.size == 1 and lines[0] > _FINE_ORDERS
    if not is_sure or abs(lag.slope_per_s) < _LEAST_SLOPE:
        return 0.0
    weight = np.where(most, lines**2, 0.0)
    scale = float(np.sum(weight * off) / max(float(np.sum(weight)), 1e-30))
    least = max(_LEAST_SCALE, 3.0 * float(error[most].min())) if most.any() else np.inf
    return scale / lag.slope_per_s if abs(scale) > least else 0.0


def is_supported(lag: SpeedLag) -> bool:
    """Whether a lag is no chance: in a decay it must bring lines to orders."""
    if lag.slope_scatter > _DECAY * abs(lag.slope_per_s):
        return True
    before, behind = (
        np.count_nonzero(off_orders(lines) < line_error(lines))
        for lines in (lag.unmoved_lines, lag.lines)
    )
    return bool(behind > before)


def moves_off(lag: SpeedLag) -> bool:
    """Whether a lag moves lines that are orders: in a decay it only changes their scale."""
    lines = lag.unmoved_lines
    are_orders = lines.size > 0 and bool(np.all(off_orders(lines) < _ON_ORDER))
    farthest = np.abs(lag.lines[:, None] - lines).min(axis=1, initial=np.inf).max(initial=0.0)
    return are_orders and bool(farthest > OFF_ORDER)


def departures(lag: SpeedLag) -> list[str]:
    """Name the longest part in which lines depart from the speed alike."""
    least = _DEPARTURE_TURNS / (_BLOCK_REVOLUTIONS * float(lag.lines.min()))
    threshold = max(least, _DEPARTURE_SCATTER * lag.scatter)
    departs = np.concatenate([[False], np.abs(lag.departure) > threshold, [False]])
    borders = np.flatnonzero(departs[1:] != departs[:-1])
    runs = list(zip(borders[::2].tolist(), borders[1::2].tolist(), strict=True))
    first, last = max(runs, key=lambda run: run[1] - run[0], default=(0, 0))
    if last - first < _DEPARTURE_BLOCKS:
        return []
    worst = lag.departure[first:last][np.argmax(np.abs(lag.departure[first:last]))]
    return [
        f"from {lag.time_s[first]:.4g} to {lag.time_s[last - 1]:.4g} s the sound is at "
        f"{1.0 + worst:.3f} times the speed: orders read too low there"
    ]


def off_orders(lines: Array) -> Array:
    """Distance of lines from multiples of 1/2, shape (line,)."""
    return np.asarray(np.abs(lines - 0.5 * np.rint(2.0 * lines)))


def line_error(lines: Array) -> Array:
    """Error of the orders of lines, shape (line,): of the spectrum, and of a speed that varies."""
    return _LINE_ERROR * (1.0 + lines)


def in_place(lines: Array) -> NDArray[np.bool_]:
    """Whether lines are multiples of 1/2, shape (line,)."""
    return np.asarray(off_orders(lines) < OFF_ORDER)
