"""Levels of a study at the receivers: by source, of all modelled sources, of the machine."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, sound_pressure_level
from ..base.vocabulary import REFERENCE_OPTION, WEIGHTINGS, stamped
from ..base.weighting import WEIGHTING
from ..machine.source import CaseKey
from .axes import LevelAxes
from .by_source import A_FIRST, SourceSound


def level(mean_square: Array) -> Array:
    """Level of mean squares of pressure, dB re 20 µPa."""
    return mean_square_level(mean_square, REFERENCE_PRESSURE_PA)


def level_variables(
    axes: LevelAxes,
    sound: Mapping[CaseKey, SourceSound],
    pressure_line: xr.DataArray,
    order_frequency: xr.DataArray,
    residual: Array,
    unmodelled: float,
    baseline: xr.Dataset | None = None,
) -> xr.Dataset:
    """Label the levels with the nominal values.

    Parameters
    ----------
    axes : axes of the levels
    sound : sound of every case, with totals by the weightings A_FIRST
    pressure_line : pressure of every source at the lines, orders first, complex peaks, Pa
    order_frequency : (speed, order), Hz
    residual : mean square of what the model leaves, shape (speed, option, receiver), Pa²
    unmodelled : noise at the published point without an option, Pa²
    baseline : result of `baseline_variables`, whose orders are in place of the modelled ones
    """
    part = axes.gathered(sound, "part")
    totals = part.sum(axis=3)  # (speed, option, weighting, receiver)
    a_total = totals[:, :, A_FIRST.index("A")]
    modelled = [level(totals[:, :, A_FIRST.index(name)]) for name in WEIGHTINGS]
    hertz = order_frequency.values
    orders = sound_pressure_level(pressure_line.values[..., : hertz.shape[1]].sum(axis=2))
    if baseline is not None and "baseline_order_level" in baseline:
        orders = with_measured(
            orders, baseline["baseline_order_level"].values, axes.measured_orders
        )
    levels = {
        "order_level": weighted(orders, hertz),
        "level_modelled": np.stack(modelled, axis=-1),
        "level_total": level(a_total + residual),
    }
    reference = list(axes.options).index(REFERENCE_OPTION)
    values = {
        **levels,
        **level_changes(levels, reference),
        **source_levels(axes, sound, residual),
        "level_unmodelled": level(np.asarray(unmodelled)),
    }
    coords = {
        **axes.by_source,
        "weighting": list(WEIGHTINGS),
        "order": order_frequency["order"].values,
        "band": [band.nominal_hz for band in axes.bands],
    }
    return stamped(values, coords)


def level_changes(levels: Mapping[str, Array], reference: int) -> dict[str, Array]:
    """Compute the changes of levels against an option, dB.

    Parameters
    ----------
    levels : `level_total` and `level_modelled` with their axis of options third from last or, by
        weighting, fourth; and `order_level`
    reference : number of the option
    """
    a, z = WEIGHTINGS.index("A"), WEIGHTINGS.index("Z")
    every = {
        "change_total": levels["level_total"],
        "change_modelled": levels["level_modelled"][..., a],
    }
    changes = {name: values - values[..., [reference], :] for name, values in every.items()}
    orders = levels["order_level"][..., z]
    order_change = orders - orders[..., [reference], :, :]
    return {**changes, "order_change": order_change, "change_1x": order_change[..., 1]}


def source_levels(
    axes: LevelAxes, sound: Mapping[CaseKey, SourceSound], residual: Array
) -> dict[str, Array]:
    """Compute levels of each source, A-weighted and by third octave, and shares of the energy.

    A source has half the energy of its interference with others, so that all shares, with that of
    unmodelled noise, are one together; where lines cancel a share can be negative.

    Parameters
    ----------
    axes : axes of the levels
    sound : sound of every case
    residual : mean square of what the model leaves, shape (speed, option, receiver), Pa²
    """
    part = axes.gathered(sound, "part")[:, :, A_FIRST.index("A")]
    total = part.sum(axis=2) + residual
    energy = np.where(total > 0.0, total, 1.0)
    return {
        "source_level": level(axes.gathered(sound, "alone")),
        "source_band_level": level(axes.gathered(sound, "band")),
        "source_share": part / energy[:, :, None],
        "unmodelled_share": residual / energy,
        "residual_level": level(np.maximum(residual, 0.0)),
    }


def with_measured(levels: Array, measured: Array, orders: Sequence[float]) -> Array:
    """Return levels of shaft orders with the measured ones in place of the modelled.

    Parameters
    ----------
    levels : levels of the orders 0, 1, 2, …, shape (..., order), dB
    measured : levels of some orders, shape (..., measured order), dB; not a number where not
        measured
    orders : that were measured
    """
    numbers = [n for n, order in enumerate(orders) if order in range(levels.shape[-1])]
    columns = [int(orders[n]) for n in numbers]
    together = levels.copy()
    is_measured = np.isfinite(measured[..., numbers])
    together[..., columns] = np.where(is_measured, measured[..., numbers], levels[..., columns])
    return np.asarray(together)


def weighted(levels: Array, frequency_hz: Array) -> Array:
    """Return levels of orders by `WEIGHTINGS`, the last axis.

    Parameters
    ----------
    levels : unweighted, shape (..., speed, option, receiver, order), dB
    frequency_hz : shape (speed, order)
    """
    hertz = frequency_hz[:, None, None, :]
    return np.stack([levels + WEIGHTING[name](hertz) for name in WEIGHTINGS], axis=-1)
