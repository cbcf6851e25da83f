"""Levels of a measured baseline with options, band by band and order by order."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.vocabulary import REFERENCE_OPTION, stamped
from ..base.weighting import WEIGHTING
from ..machine.source import CaseKey
from ..study.study import Study
from .axes import LevelAxes
from .by_source import SourceSound
from .measured_points import (
    BASELINE_BANDS,
    MIDDLE_HZ,
    UNMODELLED_BANDS,
    MeasuredPoint,
    PointKey,
    holds,
    measured_points,
)


def left_of_squares(measured: Array, modelled: Array) -> Array:
    """Mean square that a model leaves of a measured one, Pa²; nothing where it is louder.

    Parameters
    ----------
    measured, modelled : mean squares, of any one shape
    """
    return np.maximum(measured - modelled, 0.0)


def changed_orders(
    measured: ComplexArray, before: ComplexArray, after: ComplexArray, factor: Array, phase: Array
) -> Array:
    """Mean squares of orders after a change, shape (option, order), Pa².

    Where the phase was measured M - P0 + P1 as complex peaks, else as energies. What the model
    leaves passes the option's insertion loss.

    Parameters
    ----------
    measured : M, complex peaks; amplitudes where there is no phase, shape (order,)
    before : P0, modelled without an option, shape (order,)
    after : P1, modelled with each option, shape (option, order)
    factor : amplitude with each option's insertion loss over that without, (option, order)
    phase : whether the phase was measured, shape (order,)
    """
    by_phase = 0.5 * np.abs((measured - before) * factor + after) ** 2
    unmodelled = left_of_squares(0.5 * np.abs(measured) ** 2, 0.5 * np.abs(before) ** 2)
    by_energy = unmodelled * factor**2 + 0.5 * np.abs(after) ** 2
    return np.where(phase, by_phase, by_energy)


_UNMODELLED_COLUMNS: Final = [BASELINE_BANDS.index(band) for band in UNMODELLED_BANDS]
"""Columns of unmodelled noise among the bands of a baseline."""


@dataclass(frozen=True)
class Changed:
    """Mean squares at a microphone and speed with every option, Pa².

    Attributes
    ----------
    unmodelled : part of the measured bands that the model leaves, without orders, shape (option,
        band)
    beside : modelled in these bands, without the measured orders, shape (option, band)
    order : measured orders, changed, shape (option, order)
    modelled_order : pressure of the modelled orders alone, shape (option, order)
    """

    unmodelled: Array
    beside: Array
    order: Array
    modelled_order: Array


def points_of(study: Study, axes: LevelAxes) -> dict[PointKey, MeasuredPoint]:
    """Return measurements at the microphones and speeds of a study; nothing without a baseline."""
    if study.baseline is None:
        return {}
    return measured_points(study.baseline, axes.receivers, axes.speeds)


def with_baseline(
    study: Study,
    axes: LevelAxes,
    points: Mapping[PointKey, MeasuredPoint],
    sound: Mapping[CaseKey, SourceSound],
    remaining: Array,
) -> Array:
    """A-weighted mean square beside the model, shape (speed, option, receiver), Pa².

    In bands and orders with a baseline it is what the model of the machine without an option leaves
    of it, so that new = measured - modelled (none) + modelled (option); an option takes its
    insertion loss off. With phases it may be below zero. Elsewhere, in bands and at microphones, it
    is the unmodelled noise.

    Parameters
    ----------
    study : its options
    axes : axes of the levels
    points : result of `points_of`
    sound : sound of every case
    remaining : unmodelled noise in `UNMODELLED_BANDS`, shape (speed, option, receiver, band), Pa²
    """
    unmodelled: Array = remaining.sum(axis=3)
    for (receiver, speed), point in points.items():
        row = axes.speeds.index(speed), slice(None), axes.receivers.index(receiver)
        changed = _changed(study, axes, (receiver, speed), point, sound)
        elsewhere = ~np.isin(_UNMODELLED_COLUMNS, point.band)
        unmodelled[row] = remaining[row] @ elsewhere + changed.unmodelled @ _a_weight(
            MIDDLE_HZ[point.band]
        )
        weight = _a_weight(point.frequency_hz)
        unmodelled[row] += (changed.order - changed.modelled_order) @ weight
    return unmodelled


def over_baseline(
    axes: LevelAxes,
    points: Mapping[PointKey, MeasuredPoint],
    sound: Mapping[CaseKey, SourceSound],
    key: PointKey,
) -> float:
    """A-weighted level of the model over that measured, in the bands and orders measured, dB.

    Not a number where the model has no solution.
    """
    point, column = points[key], axes.receivers.index(key[0])
    none = sound[key[1], REFERENCE_OPTION]
    of_bands, of_orders = _a_weight(MIDDLE_HZ[point.band]), _a_weight(point.frequency_hz)
    chosen = _columns(axes, point)
    modelled = none.beside_total[column, point.band] @ of_bands
    modelled += 0.5 * np.abs(none.order_total[column, chosen]) ** 2 @ of_orders
    measured = point.unmodelled @ of_bands + 0.5 * np.abs(point.peak) ** 2 @ of_orders
    if np.isnan(modelled):
        return float("nan")
    return float(mean_square_level(modelled, 1.0) - mean_square_level(measured, 1.0))


def baseline_variables(
    study: Study,
    axes: LevelAxes,
    points: Mapping[PointKey, MeasuredPoint],
    sound: Mapping[CaseKey, SourceSound],
) -> xr.Dataset:
    """Bands and orders of the baseline with every option, and what the model explains of each."""
    if not points:
        return xr.Dataset()
    sizes = (len(axes.speeds), len(axes.options), len(axes.receivers))
    order = np.array(axes.measured_orders)
    bands = np.full((*sizes, len(BASELINE_BANDS)), np.nan)
    orders = baseline_orders(study, axes, points, sound)
    share, order_share = bands[:, 0].copy(), orders[:, 0].copy() * np.nan
    phase, peak = order_share.copy(), np.zeros(order_share.shape, dtype=complex)
    none = list(axes.options).index(REFERENCE_OPTION)
    for (receiver, speed), point in points.items():
        s, r = axes.speeds.index(speed), axes.receivers.index(receiver)
        changed = _changed(study, axes, (receiver, speed), point, sound)
        chosen = _columns(axes, point)
        phase[s, r, chosen], peak[s, r, chosen] = point.has_phase, point.peak
        square = 0.5 * np.abs(point.peak) ** 2
        order_share[s, r, chosen] = _ratio(changed.modelled_order[none], square)
        tones = changed.order @ holds(point.frequency_hz)[:, point.band]
        bands[s][:, r, point.band] = _level(changed.unmodelled + changed.beside + tones)
        share[s, r, point.band] = _ratio(changed.beside[none], point.unmodelled)
    values = {"baseline_share": share, "baseline_band_level": bands}
    if order.size:
        values |= {
            "baseline_order_share": order_share,
            "baseline_order_phase": phase,
            "baseline_order_pressure": peak,
            "baseline_order_level": orders,
        }
    names = [band.nominal_hz for band in BASELINE_BANDS]
    return stamped(values, {**axes.by_receiver, "baseline_band": names, "baseline_order": order})


def baseline_orders(
    study: Study,
    axes: LevelAxes,
    points: Mapping[PointKey, MeasuredPoint],
    sound: Mapping[CaseKey, SourceSound],
) -> Array:
    """Return levels of the measured orders with every option, empty where none was measured.

    Returns
    -------
    shape (speed, option, receiver, measured order), dB
    """
    sizes = (len(axes.speeds), len(axes.options), len(axes.receivers), len(axes.measured_orders))
    orders = np.full(sizes, np.nan)
    for (receiver, speed), point in points.items():
        s, r = axes.speeds.index(speed), axes.receivers.index(receiver)
        changed = _changed(study, axes, (receiver, speed), point, sound)
        orders[s][:, r, _columns(axes, point)] = _level(changed.order)
    return orders


def _changed(
    study: Study,
    axes: LevelAxes,
    key: PointKey,
    point: MeasuredPoint,
    sound: Mapping[CaseKey, SourceSound],
) -> Changed:
    column, chosen = axes.receivers.index(key[0]), _columns(axes, point)
    cases = [sound[key[1], option] for option in axes.options]
    none = cases[list(axes.options).index(REFERENCE_OPTION)]
    beside = np.array([case.beside_total[column, point.band] for case in cases])
    order = np.array([case.order_total[column, chosen] for case in cases])
    losses = [study.options[name].insertion_loss() for name in axes.options]
    middle_hz, hertz = MIDDLE_HZ[point.band], point.frequency_hz
    by_band = [1.0 if loss is None else loss.power_factor(middle_hz) for loss in losses]
    by_order = [1.0 if loss is None else loss.amplitude_factor(hertz) for loss in losses]
    unmodelled = left_of_squares(point.unmodelled, none.beside_total[column, point.band])
    factor = np.array([gain * np.ones(hertz.size) for gain in by_order])
    return Changed(
        np.array([unmodelled * gain for gain in by_band]),
        beside,
        changed_orders(
            point.peak, none.order_total[column, chosen], order, factor, point.has_phase
        ),
        0.5 * np.abs(order) ** 2,
    )


def _columns(axes: LevelAxes, point: MeasuredPoint) -> list[int]:
    """Columns of the point's orders among all that were measured."""
    return [axes.measured_orders.index(order) for order in point.order.tolist()]


def _a_weight(frequency_hz: Array) -> Array:
    return power_of_level(np.asarray(WEIGHTING["A"](frequency_hz)))


def _level(mean_square: Array) -> Array:
    return mean_square_level(mean_square, REFERENCE_PRESSURE_PA)


def _ratio(modelled: Array, measured: Array) -> Array:
    """Modelled over measured; not a number where nothing was measured."""
    return np.divide(modelled, measured, out=np.full_like(measured, np.nan), where=measured > 0.0)
