"""Levels of a recording before and after a replay: of its orders, and of whole channels."""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_BY_UNIT
from ..base.decibel import level_of_power, power_of_level
from ..base.vocabulary import WEIGHTINGS, check, label_coordinates, stamped
from ..base.weighting import WEIGHTING
from .option_ratios import PRESSURE_UNIT, OrderRatio

_UNWEIGHTED: Final = WEIGHTINGS.index("Z")


class ReplayedLine(NamedTuple):
    """Mean squares of an order, in the channel's unit squared.

    Attributes
    ----------
    name : in the study
    before : signal of the order, without noise
    noise : within the bandwidth
    after : signal of the changed order
    low, high : ends of the interval of `after`
    wider : these ends less `after`, shape (end, weighting)
    has_interval : whether the study has an interval
    """

    name: str
    before: float
    noise: float
    after: float
    low: float
    high: float
    wider: Array
    has_interval: bool


def replayed_line(
    order: OrderRatio, envelope: ComplexArray, ratio: ComplexArray, hertz: Array, speed_rpm: Array
) -> ReplayedLine:
    """Mean squares of an order after the change, and of the ends of its interval."""
    before = 0.5 * np.abs(envelope) ** 2
    square = before * np.abs(ratio) ** 2
    rpm = 60.0 * hertz / order.order
    ends = [
        square if factor is None else square * np.interp(rpm, speed_rpm, factor) ** 2
        for factor in (order.low, order.high)
    ]
    gains = np.array([power_of_level(WEIGHTING[name](hertz)) for name in WEIGHTINGS])
    wider = np.array([np.mean(gains * (end - square), axis=-1) for end in ends])
    after, low, high = (float(np.mean(each)) for each in (square, *ends))
    of_order = float(np.mean(before))
    return ReplayedLine(order.line, of_order, 0.0, after, low, high, wider, order.low is not None)


def summary_of(
    units: Mapping[str, str],
    before: Array,
    after: Array,
    rate_hz: float,
    lines: list[list[ReplayedLine]],
) -> xr.Dataset:
    """Levels of orders and of whole channels; units by channel."""
    channels = list(units)
    names = list(dict.fromkeys(line.name for of_channel in lines for line in of_channel))
    variables: dict[str, Any] = {
        name: np.full((len(channels), len(names)), np.nan)
        for name in (
            "recorded_line_level", "recorded_line_noise_level", "replayed_line_level",
            "replayed_line_change", "replayed_line_change_low", "replayed_line_change_high",
        )
    }  # fmt: skip
    reference = np.array([REFERENCE_BY_UNIT[unit] for unit in units.values()])
    for row, of_channel in enumerate(lines):
        for line in of_channel:
            for name, value in _levels(line, reference[row]).items():
                variables[name][row, names.index(line.name)] = value
    labelled = stamped(variables, {"channel": channels, "line": names})
    old, new = (np.array([_squares(each, rate_hz) for each in x]) for x in (before, after))
    wider = np.array([sum((line.wider for line in each), np.zeros((2, 3))) for each in lines])
    squares = {
        "recorded_total_level": old,
        "replayed_total_level": new,
        "replayed_total_level_low": new + wider[:, 0],
        "replayed_total_level_high": new + wider[:, 1],
    }
    is_sound = np.array([[unit == PRESSURE_UNIT] for unit in units.values()])
    has_weighting = is_sound | (np.arange(len(WEIGHTINGS)) == _UNWEIGHTED)
    totals = {
        name: np.where(has_weighting, _level(square, reference[:, None]), np.nan)
        for name, square in squares.items()
    }
    labelled = labelled.merge(stamped(totals, {"channel": channels, "weighting": list(WEIGHTINGS)}))
    labelled = labelled.assign_coords(channel_unit=("channel", list(units.values())))
    return check(label_coordinates(labelled))


def _levels(line: ReplayedLine, reference: float) -> dict[str, float]:
    """Levels of a line that is audible; of another one, level and noise alone."""
    levels = {
        "recorded_line_level": float(_level(line.before, reference)),
        "recorded_line_noise_level": float(_level(line.noise, reference)),
    }
    if line.before < line.noise:
        return levels
    change = line.after / line.before
    levels["replayed_line_change"] = float(level_of_power(change))
    levels["replayed_line_level"] = float(_level(line.after, reference))
    if line.has_interval:
        levels["replayed_line_change_low"] = float(level_of_power(line.low / line.before))
        levels["replayed_line_change_high"] = float(level_of_power(line.high / line.before))
    return levels


def _level(square: Array | float, reference: Array | float) -> Array:
    """Level of mean squares, dB; the reference is in the same unit."""
    ratio: Array = np.asarray(square, dtype=float) / np.asarray(reference, dtype=float) ** 2
    return np.asarray(level_of_power(ratio))


def _squares(signal: Array, rate_hz: float) -> Array:
    """Mean square by weighting over the whole signal, from one transform."""
    hertz = np.asarray(np.fft.rfftfreq(signal.size, 1.0 / rate_hz)[1:], dtype=float)
    square = 2.0 * np.abs(np.fft.rfft(signal)[1:]) ** 2 / signal.size**2
    gains = np.array([power_of_level(WEIGHTING[name](hertz)) for name in WEIGHTINGS])
    return np.asarray(gains @ square)
