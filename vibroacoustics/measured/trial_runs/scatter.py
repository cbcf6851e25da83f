"""Scatter of the readings of runs, and what a speed that differs between runs adds to it."""

from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...mechanics.balancing.coefficients import scatter_of_runs
from ...recordings.quantities import quantity

_SLOPES: Final = {"displacement": 1.0, "velocity": 2.0, "acceleration": 3.0, "sound pressure": 3.0}
_SLOPE: Final = 2.0
"""Exponents of the speed, midway between those below and above the resonances of the mounts."""
_SLOPE_DEVIATION: Final = 1.0
_MEASURED_DEVIATION: Final = 0.1
_TURN_SHARE: Final = 0.5
"""Standard deviation of an exponent between two speeds: a resonance near them turns the phase."""
_NEIGHBOUR_RATIO: Final = 2.5
"""Ratio of speeds within which readings of two speeds give the exponent."""
_SIGNIFICANT: Final = 0.99


class Slopes(NamedTuple):
    """Exponents of the speed by which readings grow.

    Attributes
    ----------
    exponent : shape (row,)
    deviation : standard deviation of the exponents, shape (row,)
    """

    exponent: Array
    deviation: Array


def slopes(
    readings: ComplexArray, sensors: Sequence[str], speeds_rpm: Array, units: Mapping[str, str]
) -> Slopes:
    """Find the exponents of readings over speed: from the neighbouring speed, else by quantity.

    Parameters
    ----------
    readings : shape (run, row); not a number where a run has no reading
    sensors : sensor of each row
    speeds_rpm : nominal speed of each row, shape (row,)
    units : unit by sensor
    """
    size = np.sqrt(np.nanmean(np.abs(readings) ** 2, axis=0))
    speeds = speeds_rpm.tolist()
    exponent = np.array([_SLOPES.get(quantity(units[name]).kind, _SLOPE) for name in sensors])
    deviation = np.full(exponent.shape, _SLOPE_DEVIATION)
    for row, sensor in enumerate(sensors):
        others = [
            other
            for other, name in enumerate(sensors)
            if name == sensor and 1.0 < _ratio(speeds[other], speeds[row]) < _NEIGHBOUR_RATIO
        ]
        if others and size[row] > 0.0:
            other = min(others, key=lambda each: _ratio(speeds[each], speeds[row]))
            steps = np.log(speeds_rpm[other] / speeds_rpm[row])
            measured = np.log(max(size[other], 1e-30) / size[row]) / steps
            exponent[row] = np.clip(measured, exponent[row] - 2.0, exponent[row] + 2.0)
            product = np.nansum(readings[:, other] * readings[:, row].conj())
            turn = abs(float(np.angle(product)) / steps)
            deviation[row] = min(_MEASURED_DEVIATION + _TURN_SHARE * turn, _SLOPE_DEVIATION)
    return Slopes(exponent, deviation)


def _ratio(first: float, second: float) -> float:
    return max(first / second, second / first)


class Corrected(NamedTuple):
    """Readings at the nominal speeds.

    Attributes
    ----------
    readings : shape (run, row)
    by_speed : their change by one standard deviation of the exponent, shape (run, row)
    """

    readings: ComplexArray
    by_speed: ComplexArray


def at_nominal_speed(
    readings: ComplexArray, actual_rpm: Array, speeds_rpm: Array, growth: Slopes
) -> Corrected:
    """Scale readings to the nominal speed of their row: b (n₀/n)^exponent.

    Parameters
    ----------
    readings, actual_rpm : shape (run, row)
    speeds_rpm : nominal speed of each row, shape (row,)
    growth : exponents
    """
    scaled = readings * (speeds_rpm / actual_rpm) ** growth.exponent
    return Corrected(scaled, scaled * np.log(actual_rpm / speeds_rpm) * growth.deviation)


class Deviations(NamedTuple):
    """Standard deviations of readings.

    Attributes
    ----------
    deviation : standard deviation of real and imaginary part, shape (run, row)
    freedom : degrees of freedom; infinite where it is stated or recorded, zero where it is
        unknown, shape (row,)
    """

    deviation: Array
    freedom: Array


def deviations(
    corrected: Corrected, weights: ComplexArray, stated: Array, sensors: Sequence[str]
) -> Deviations:
    """Find the standard deviation of each reading: stated, or that of repeats.

    Repeats and further runs of a sensor at all speeds are pooled, relative to the readings of each
    speed. A stated deviation grows where the runs scatter by significantly more.

    Parameters
    ----------
    corrected : readings at the nominal speeds
    weights : moments that are in, shape (run, plane), kg m
    stated : shape (run, row); not a number where it is unknown
    sensors : sensor of each row
    """
    from scipy.stats import chi2

    readings = corrected.readings
    scatter = scatter_of_runs(readings, weights, np.nan_to_num(corrected.by_speed))
    size = np.sqrt(np.nanmean(np.abs(readings) ** 2, axis=0))
    size = np.where(size > 0.0, size, 1.0)
    deviation, freedom = stated.copy(), np.full(len(sensors), np.inf)
    for sensor in dict.fromkeys(sensors):
        rows = np.array([name == sensor for name in sensors])
        count = float(scatter.freedom[rows].sum())
        present = np.isfinite(readings[:, rows])
        is_stated = bool(np.all(np.isfinite(stated[:, rows][present])))
        unit = np.sqrt(np.nanmean(stated[:, rows] ** 2, axis=0)) if is_stated else size[rows]
        ratio = float(np.sum(scatter.squares[rows] / unit**2)) / max(count, 1.0)
        if is_stated and (not count or count * ratio <= chi2.ppf(_SIGNIFICANT, count)):
            continue
        scale = np.sqrt(ratio) if count and ratio > 0.0 else 1.0
        every = stated[:, rows] if is_stated else np.broadcast_to(size[rows], present.shape)
        deviation[:, rows] = scale * every
        freedom[rows] = count if ratio > 0.0 else 0.0
    return Deviations(np.where(np.isfinite(deviation), deviation, 1.0), freedom)
