"""Lines of an order map that are orders, and the loudest of them."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import level_of_power, power_of_level
from ..base.weighting import WEIGHTING
from ..study.order_analysis import FIRST_ORDERS

MOST_LOUDEST: Final = 6
_RANGE_DB: Final = 30.0
"""Orders whose greatest level is further below the loudest order are omitted."""
_PEAK_RATIO: Final = 4.0
"""Power of a line over the median of the lines around it, from which it is an order: 6 dB."""


def a_weighted_power(order: Array, speed_rpm: Array) -> Array:
    """Power gain of the A-weighting at orders and speeds, shape (block, line).

    Parameters
    ----------
    order : multiples of the shaft frequency, shape (line,); that of order 0 is 0
    speed_rpm : shape (block,)
    """
    frequency_hz = np.maximum(np.outer(speed_rpm / 60.0, order), 1e-3)
    return np.asarray(power_of_level(WEIGHTING["A"](frequency_hz)))


def band_power(power: Array, map_order: Array, order: Array, band_order: float) -> Array:
    """Sum of the powers of the lines in the bands of orders, shape (block, order).

    Parameters
    ----------
    power : power of the lines, shape (block, line)
    map_order : order of the lines, evenly spaced from 0, shape (line,)
    order : middles of the bands, shape (order,)
    band_order : width of the bands, orders
    """
    slack = 1e-6 * map_order[1]
    sums = np.concatenate([np.zeros((len(power), 1)), np.cumsum(power, axis=1)], axis=1)
    first = np.searchsorted(map_order, order - 0.5 * band_order - slack)
    end = np.searchsorted(map_order, order + 0.5 * band_order + slack)
    return np.asarray(sums[:, end] - sums[:, first])


def standing_out(mean_power: Array, map_order: Array, band_order: float) -> Array:
    """Orders whose line is a peak, 6 dB above the median of the lines around it, rising.

    The stronger of two peaks in one band counts.

    Parameters
    ----------
    mean_power : mean power of the lines, shape (line,)
    map_order : order of the lines, evenly spaced from 0, shape (line,)
    band_order : width of the bands, orders; the first and last half of it are omitted
    """
    reach = max(round(band_order / map_order[1]), 1)
    half = reach // 2 + 1
    lines_found: list[int] = []
    for line in np.argsort(-mean_power, kind="stable").tolist():
        if not half <= line < mean_power.size - half:
            continue
        around = mean_power[max(line - 2 * reach, half) : line + 2 * reach + 1]
        is_peak = mean_power[line] == mean_power[line - 1 : line + 2].max()
        is_clear = mean_power[line] > _PEAK_RATIO * np.median(around)
        if is_peak and is_clear and all(abs(line - other) > reach for other in lines_found):
            lines_found.append(line)
    return np.sort(map_order[lines_found])


def ranked_orders(
    power: Array, map_order: Array, nominal: Sequence[float] | Array, band_order: float, gain: Array
) -> tuple[Array, Array, IndexArray]:
    """Orders of a map, their power over the blocks, and which of them are the loudest.

    Candidates are nominal orders and those that stand out in the map; ranked by their greatest
    weighted power, at most six and 30 dB are kept.

    Parameters
    ----------
    power : power of the lines, shape (block, line)
    map_order : order of the lines, evenly spaced from 0, shape (line,)
    nominal : orders that are candidates in any case, shape (order,)
    band_order : width of the bands, orders
    gain : weighting of the lines, power, shape (block, line), or 1

    Returns
    -------
    candidates, rising, shape (order,); weighted power in their bands, shape (block, order); numbers
    of the loudest, the loudest first
    """
    expected = np.asarray(nominal, dtype=float)
    others = standing_out((power * gain).mean(axis=0), map_order, band_order)
    distance = np.abs(others[:, None] - expected).min(axis=1, initial=np.inf)
    candidates = np.sort(np.concatenate([expected, others[distance > band_order]]))
    in_bands = band_power(power, map_order, candidates, band_order)
    if gain.size > 1:  # of the line next to the order
        in_bands = in_bands * gain[:, np.rint(candidates / map_order[1]).astype(int)]
    level_db = level_of_power(in_bands.max(axis=0))
    ranked = np.argsort(-level_db, kind="stable")[:MOST_LOUDEST]
    return candidates, in_bands, ranked[level_db[ranked] > level_db.max() - _RANGE_DB]


def loud_orders(
    amplitude: ComplexArray, map_order: Array, speed_rpm: Array, band_order: float, is_sound: Array
) -> tuple[float, ...]:
    """Orders 1 and 2 and the loudest of each channel, at most six, rising.

    The loudest order of every channel comes first, sound pressure before other quantities and the
    loudest channel before others; then the second ones, and so on. Sound pressure is A-weighted.

    Parameters
    ----------
    amplitude : complex peaks of the map, shape (channel, block, line)
    map_order : order of the lines, evenly spaced from 0, shape (line,)
    speed_rpm : speed of the blocks, shape (block,)
    band_order : width of the bands, orders
    is_sound : whether a channel is sound pressure, shape (channel,)
    """
    gain = a_weighted_power(map_order, speed_rpm)
    ranked: list[tuple[int, bool, float, float]] = []
    for peak, sound in zip(amplitude, is_sound.tolist(), strict=True):
        power = peak.real**2 + peak.imag**2
        candidates, in_bands, rows = ranked_orders(
            power, map_order, FIRST_ORDERS, band_order, gain if sound else np.ones(1)
        )
        greatest = in_bands.max(axis=0)
        ranked += [
            (rank, not sound, -float(greatest[rows[0]]), float(candidates[row]))
            for rank, row in enumerate(rows)
        ]
    listed = dict.fromkeys([*FIRST_ORDERS, *(order for *_, order in sorted(ranked))])
    return tuple(sorted([*listed][:MOST_LOUDEST]))
