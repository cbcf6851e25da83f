"""Values of a baseline at the speeds of a study, between those that were measured."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level, power_of_level
from ..base.units import shaft_frequency_hz
from ..mechanics.added import third_octave_number
from ..study.baseline import Baseline, BaselineOrders
from .bands import bands_between
from .by_source import GAIN_BANDS

BASELINE_BANDS: Final = GAIN_BANDS
"""Third octaves that a baseline may have."""
UNMODELLED_BANDS: Final = bands_between(3, 25.0, 10000.0)
"""Third octaves of unmodelled noise, where there is no baseline."""
MIDDLE_HZ: Final[Array] = np.array([band.middle_hz for band in BASELINE_BANDS])
_EDGES: Final[Array] = np.array([[band.lower_hz, band.upper_hz] for band in BASELINE_BANDS])


@dataclass(frozen=True)
class MeasuredPoint:
    """Measurement at a microphone, at a speed of the study.

    Attributes
    ----------
    band : numbers of `BASELINE_BANDS`, shape (band,); none where no third octaves were measured
    unmodelled : mean squares without the measured orders, shape (band,), Pa²
    order, frequency_hz : shape (order,)
    peak : complex at the study's crank angle where the phase is known, else amplitudes, shape
        (order,), Pa
    has_phase : shape (order,)
    """

    band: IndexArray
    unmodelled: Array
    order: Array
    frequency_hz: Array
    peak: ComplexArray
    has_phase: Array


class _Between(NamedTuple):
    """Two neighbours in a list of speeds and how far towards the second."""

    first: int
    second: int
    share: float


PointKey = tuple[str, float]
"""Microphone and speed."""


def measured_points(
    baseline: Baseline, receivers: Iterable[str], speeds: Sequence[float]
) -> dict[PointKey, MeasuredPoint]:
    """Return the measurement at each microphone and speed that the baseline covers.

    Parameters
    ----------
    baseline : baseline of the study
    receivers, speeds : receivers and speeds of the study, rpm
    """
    return {
        (name, speed): _point(baseline, name, speed)
        for name in receivers
        for speed in speeds
        if baseline.covers(name, speed)
    }


def evidence(points: Iterable[PointKey]) -> list[PointKey]:
    """Points that weigh samples: at each microphone the lowest, a middle and the highest speed.

    Speeds between them add little information, and each costs one case in every sample.
    """
    by_receiver: dict[str, list[float]] = {}
    for receiver, speed in points:
        by_receiver.setdefault(receiver, []).append(speed)
    return [
        (receiver, speed)
        for receiver, speeds in by_receiver.items()
        for speed in dict.fromkeys(sorted(speeds)[index] for index in (0, len(speeds) // 2, -1))
    ]


def holds(frequency_hz: Array) -> Array:
    """1 where a third octave of `BASELINE_BANDS` holds a frequency, shape (frequency, band)."""
    hertz = frequency_hz[:, None]
    return ((hertz >= _EDGES[:, 0]) & (hertz < _EDGES[:, 1])).astype(float)


def _point(baseline: Baseline, name: str, speed: float) -> MeasuredPoint:
    orders = baseline.orders_at(name)
    number = np.array(orders[0].order if orders else (), dtype=float)
    peak, has_phase = _peaks(orders, speed)
    if baseline.tacho_angle_rad is None:
        has_phase = np.zeros_like(has_phase)
    else:
        peak = peak * np.exp(-1j * number * baseline.tacho_angle_rad)
    band, unmodelled = _rest(baseline, name, speed)
    hertz = number * shaft_frequency_hz(speed)
    return MeasuredPoint(
        band, unmodelled, number, hertz, np.where(has_phase, peak, np.abs(peak)), has_phase
    )


def _rest(baseline: Baseline, name: str, speed: float) -> tuple[IndexArray, Array]:
    """Numbers of the bands and their mean squares without the measured orders, Pa²."""
    spectra, orders = baseline.spectra_at(name), baseline.orders_at(name)
    if not spectra:
        return np.zeros(0, dtype=np.intp), np.zeros(0)
    numbers = third_octave_number(np.array(spectra[0].band_hz)) - third_octave_number(
        np.array(MIDDLE_HZ[0])
    )
    band = numbers.astype(np.intp)
    squares = []
    for spectrum in spectra:
        square = REFERENCE_PRESSURE_PA**2 * power_of_level(np.array(spectrum.level_db))
        if orders and not spectrum.without_orders:
            peak, _ = _peaks(orders, spectrum.speed_rpm)
            hertz = np.array(orders[0].order) * shaft_frequency_hz(spectrum.speed_rpm)
            square = np.maximum(square - (0.5 * np.abs(peak) ** 2) @ holds(hertz)[:, band], 0.0)
        squares.append(square)
    between = _between([spectrum.speed_rpm for spectrum in spectra], speed)
    return band, _straight_levels(squares[between.first], squares[between.second], between.share)


def _straight_levels(first: Array, second: Array, share: float) -> Array:
    """Mean squares on a straight line of their level; of their energy where one is nothing."""
    is_heard_twice = (first > 0.0) & (second > 0.0)
    ratio = np.where(is_heard_twice, second, 1.0) / np.where(is_heard_twice, first, 1.0)
    by_energy = (1.0 - share) * first + share * second
    return np.asarray(np.where(is_heard_twice, first * ratio**share, by_energy))


def _peaks(orders: Sequence[BaselineOrders], speed: float) -> tuple[ComplexArray, Array]:
    """Peaks after the tacho's pulse at a speed, Pa, and whether their phase is known, (order,).

    Levels go by straight lines between neighbouring speeds, phases by the shorter way round.
    """
    if not orders:
        return np.zeros(0, dtype=complex), np.zeros(0, dtype=bool)
    first, second, share = _between([row.speed_rpm for row in orders], speed)
    level = [np.array(orders[row].level_db) for row in (first, second)]
    phase = [np.array(orders[row].phase_rad, dtype=float) for row in (first, second)]
    turn = np.angle(np.exp(1j * (phase[1] - phase[0]))) if share > 0.0 else 0.0
    angle = phase[0] + share * turn
    between = level[0] + share * (level[1] - level[0])
    size = np.sqrt(2.0) * REFERENCE_PRESSURE_PA * amplitude_of_level(between)
    return size * np.exp(1j * np.nan_to_num(angle)), np.isfinite(angle)


def _between(speeds: Sequence[float], speed: float) -> _Between:
    """Neighbours of a speed among rising ones; the nearest alone outside them or at one of them."""
    above = int(np.searchsorted(speeds, speed))
    if above == 0 or above == len(speeds):
        nearest = min(above, len(speeds) - 1)
        return _Between(nearest, nearest, 0.0)
    if speeds[above] == speed:
        return _Between(above, above, 0.0)
    low, high = speeds[above - 1], speeds[above]
    return _Between(above - 1, above, (speed - low) / (high - low))
