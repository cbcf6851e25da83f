"""Levels of a study at the receivers: by source, of all modelled sources, of the machine."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, sound_pressure_level
from ..base.vocabulary import REFERENCE_OPTION, WEIGHTINGS, stamped
from ..machine.source import CaseKey
from .axes import LevelAxes
from .by_source import A_FIRST, SourceSound
from .weighting import WEIGHTING


def level(mean_square: Array) -> Array:
    """Level of mean squares of pressure, dB re 20 µPa."""
    return mean_square_level(mean_square, REFERENCE_PRESSURE_PA)


def level_variables(
    axes: LevelAxes,
    sound: Mapping[CaseKey, SourceSound],
    pressure_line: xr.DataArray,
    order_frequency: xr.DataArray,
    remaining: Array,
    remainder: float,
    baseline: xr.Dataset | None = None,
) -> xr.Dataset:
    """Levels with the values as given.

    Parameters
    ----------
    axes : of the levels
    sound : of every case, with totals by the weightings A_FIRST
    pressure_line : of every source, orders first, complex peaks, Pa
    order_frequency : (speed, order), Hz
    remaining : mean square that the model does not explain, shape (speed, option, receiver), Pa²
    remainder : the same at the published point without an option, Pa²
    baseline : of `baseline_variables`, whose orders stand for the modelled ones
    """
    part = axes.gathered(sound, "part")
    totals = part.sum(axis=3)  # (speed, option, weighting, receiver)
    a_total = totals[:, :, A_FIRST.index("A")]
    modelled = [level(totals[:, :, A_FIRST.index(name)]) for name in WEIGHTINGS]
    total = level(a_total + remaining)
    orders = pressure_line.values[..., : order_frequency.sizes["order"]].sum(axis=2)
    order_level = _order_level(orders, order_frequency)
    if baseline is not None and "baseline_order_level" in baseline:
        order = order_frequency["order"].values.astype(float)
        measured = baseline["baseline_order_level"].reindex(baseline_order=order).values
        of_baseline = _weighted(measured, order_frequency)
        order_level = np.where(np.isnan(of_baseline), order_level, of_baseline)
    changes = {
        "change_1x": order_level[..., 1, WEIGHTINGS.index("Z")],
        "change_modelled": level(a_total),
        "change_total": total,
    }
    reference = list(axes.options).index(REFERENCE_OPTION)
    values = {
        "order_level": order_level,
        "level_modelled": np.stack(modelled, axis=-1),
        "level_total": total,
        "level_unmodelled": level(np.asarray(remainder)),
        **_of_sources(axes, sound),
        **{name: every - every[:, [reference]] for name, every in changes.items()},
    }
    coords = {
        **axes.by_source,
        "weighting": list(WEIGHTINGS),
        "order": order_frequency["order"].values,
        "band": [band.nominal_hz for band in axes.bands],
    }
    return stamped(values, coords)


def _of_sources(axes: LevelAxes, sound: Mapping[CaseKey, SourceSound]) -> dict[str, Array]:
    """A-weighted level, share of the modelled total and third octaves of each source."""
    shares = axes.gathered(sound, "part")[:, :, A_FIRST.index("A")]
    total = shares.sum(axis=2, keepdims=True)
    return {
        "source_level": level(axes.gathered(sound, "alone")),
        "source_share": shares / np.where(total > 0.0, total, 1.0),
        "source_band_level": level(axes.gathered(sound, "band")),
    }


def sample_level_variables(
    axes: LevelAxes,
    sounds: Sequence[Mapping[CaseKey, SourceSound]],
    remaining: Array,
    remainder: Array,
    weight: Array,
    prior_names: Sequence[str],
) -> xr.Dataset:
    """A-weighted levels of every sample.

    A sample without a solution has weight 0, and its levels are empty.

    Parameters
    ----------
    axes : of the levels
    sounds : of every case, by sample
    remaining : mean square that each sample leaves unexplained, Pa², shape (sample, speed, option,
        receiver)
    remainder : the same at the published point without an option, shape (sample,), Pa²
    weight : of the samples, shape (prior, sample)
    prior_names : of the remainder
    """
    alone = np.array([axes.gathered(sound, "alone") for sound in sounds])
    modelled = np.array([axes.gathered(sound, "part")[:, :, 0].sum(axis=2) for sound in sounds])
    total = modelled + remaining
    values = {
        "source_level_by_sample": _level_or_none(alone),
        "level_modelled_by_sample": _level_or_none(modelled),
        "level_total_by_sample": _level_or_none(total),
        "level_unmodelled_by_sample": level(remainder),
        "sample_weight": _of_solved(weight, modelled),
    }
    samples = np.arange(1, len(sounds) + 1)
    return stamped(values, {**axes.by_source, "sample": samples, "prior": list(prior_names)})


def _of_solved(weight: Array, modelled: Array) -> Array:
    """Weights that sum up to one over the samples that have a solution, shape (prior, sample)."""
    solved = ~np.isnan(modelled).any(axis=(1, 2, 3))
    total = (weight * solved).sum(axis=1, keepdims=True)
    return np.asarray(weight * solved / np.where(total > 0.0, total, 1.0))


def _level_or_none(mean_square: Array) -> Array:
    """Levels; empty where a sample has no solution."""
    return np.where(np.isnan(mean_square), np.nan, level(np.nan_to_num(mean_square)))


def _order_level(pressure: ComplexArray, frequency: xr.DataArray) -> Array:
    """Levels of the orders, (speed, option, receiver, order, weighting)."""
    return _weighted(sound_pressure_level(pressure), frequency)


def _weighted(unweighted: Array, frequency: xr.DataArray) -> Array:
    hertz = frequency.values[:, None, None, :]
    return np.stack([unweighted + WEIGHTING[name](hertz) for name in WEIGHTINGS], axis=-1)
