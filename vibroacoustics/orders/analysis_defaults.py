"""Defaults of an analysis of orders: what sample rate and length of a recording hold."""

from dataclasses import replace
from typing import Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..study.order_analysis import (
    DEFAULT_MAXIMUM_ORDER,
    DEFAULT_RESOLUTION_ORDER,
    FIRST_ORDERS,
    OrderAnalysis,
    default_orders,
)
from .angular_plan import HIGHEST_PASS_BAND_RATIO, AngularPlan, known_samples
from .block_orders import WINDOW
from .crank_motion import CrankMotion
from .windows import window_by_name

_HALF_LOBE: Final = 4.0 / 3.0
"""Half of the window's main lobe over its noise bandwidth: room for the highest order's band."""
_LEAST_REVOLUTIONS: Final = 4
"""Revolutions of a block whose main lobes, 4 lines wide, keep whole orders apart."""
_PROBES: Final = 10_001
_SPARE: Final = 1.5
"""Ratio of the highest order between the probes that ends the search."""


def highest_order(settings: OrderAnalysis) -> float:
    """Highest order that settings need: that of the spectra, or of the band of an order."""
    greatest = max(settings.orders or FIRST_ORDERS)
    return max(settings.maximum_or_default, greatest + _HALF_LOBE * settings.resolution_or_default)


def with_defaults(
    settings: OrderAnalysis, rate_hz: float, samples: int, motion: CrankMotion
) -> OrderAnalysis:
    """Settings whose unstated orders, maximum order and resolution fit a recording.

    A recording of fewer revolutions than blocks need is fitted at once, see `FittedOrders`.

    Parameters
    ----------
    settings : settings of the user, which stay as they are
    rate_hz, samples : sample rate and number of samples of the recording
    motion : motion of the shaft

    Raises
    ------
    ParameterError
        The sample rate does not hold order 1 or an order that is stated, or the recording is
        shorter than a revolution.
    """
    limit = _rate_limit(rate_hz, samples, motion, highest_order(settings))
    is_held = max(FIRST_ORDERS) + _HALF_LOBE * DEFAULT_RESOLUTION_ORDER <= limit
    if settings.orders is None or not (settings.orders or is_held):
        settings = replace(settings, orders=_orders_below(limit, rate_hz))
    if settings.maximum_order is None:
        _check_orders(settings, limit)
        highest = max(DEFAULT_MAXIMUM_ORDER, highest_order(settings))
        settings = replace(settings, maximum_order=min(highest, limit))
    if settings.resolution_order is not None or settings.is_fit:
        return settings
    first, last = known_samples(motion, rate_hz, samples)
    turns = float(np.ptp(motion.angle_rad(np.array([first, last - 1]) / rate_hz))) / (2.0 * np.pi)
    if turns < 1.0:
        raise ParameterError(
            f"holds {turns:.3g} revolutions of the shaft: orders need at least 1: record longer"
        )
    lines = window_by_name(WINDOW).noise_bandwidth_lines
    if (turns - 1.0) * DEFAULT_RESOLUTION_ORDER > 2.0 * lines:  # the kernel takes some
        return settings
    orders = settings.orders or _orders_below(limit, rate_hz)
    return _for_few_turns(settings, rate_hz, samples, motion, lines, orders)


def _rate_limit(rate_hz: float, samples: int, motion: CrankMotion, needed: float) -> float:
    """Highest order that the sample rate holds at the highest speed."""
    first, last = known_samples(motion, rate_hz, samples)
    time_s: Array = np.asarray(np.linspace(first, last - 1, _PROBES) / rate_hz, dtype=float)
    passed_hz = 0.5 * HIGHEST_PASS_BAND_RATIO * rate_hz
    limit = passed_hz / float(np.max(motion.frequency_hz(time_s)))
    if limit > _SPARE * needed:
        return limit
    return passed_hz / AngularPlan(rate_hz, samples, motion, 0.1 * limit).highest_hz


def _orders_below(limit: float, rate_hz: float) -> tuple[float, ...]:
    room = _HALF_LOBE * DEFAULT_RESOLUTION_ORDER
    held = default_orders(limit - room)
    if not held:
        raise ParameterError(
            f"sample_rate_hz = {rate_hz:g} Hz: holds orders up to {limit:.3g} at the highest "
            f"speed: order 1 needs {rate_hz * (1.0 + room) / limit:.0f} Hz at least"
        )
    return held


def _check_orders(settings: OrderAnalysis, limit: float) -> None:
    highest = limit - (0.0 if settings.is_fit else _HALF_LOBE * settings.resolution_or_default)
    greatest = max(settings.orders or (0.0,))
    if greatest > highest:
        raise ParameterError(
            f"orders = {greatest:g}: must be at most {highest:.4g} at the highest speed"
        )


def _for_few_turns(
    settings: OrderAnalysis,
    rate_hz: float,
    samples: int,
    motion: CrankMotion,
    lines: float,
    orders: tuple[float, ...],
) -> OrderAnalysis:
    """Settings with the finest resolution that blocks allow, or with a fit."""
    plan = _plan(settings, rate_hz, samples, motion)
    revolutions = 0 if plan is None else _spanned(plan)
    needed = int(np.ceil(lines / DEFAULT_RESOLUTION_ORDER))
    if revolutions >= needed:
        return settings
    if revolutions >= _LEAST_REVOLUTIONS:
        return replace(settings, resolution_order=lines / revolutions)
    return replace(settings, is_fit=True, orders=orders)


def _plan(
    settings: OrderAnalysis, rate_hz: float, samples: int, motion: CrankMotion
) -> AngularPlan | None:
    """Plan of the blocks; None where the recording is shorter than their kernel."""
    try:
        return AngularPlan(rate_hz, samples, motion, highest_order(settings))
    except ParameterError:
        return None


def _spanned(plan: AngularPlan) -> int:
    first, last = plan.grid
    return (last + 1 - first) // plan.samples_per_revolution
