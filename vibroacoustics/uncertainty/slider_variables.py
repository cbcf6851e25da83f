"""Changes of the level by sliders, labelled, and the error of adding them."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr
from scipy.stats import chi2, norm

from ..base.arrays import Array, IndexArray
from ..base.vocabulary import REFERENCE_OPTION, stamped
from ..levels.by_source import GAIN_BANDS
from ..levels.changes import change_at, total_change
from ..results.estimates import QUANTILES
from ..study.sampling import Sample, sample_at
from .sliders import NODES, Compute, Slider, band_levels

HOOD: Final = "hood.insertion_loss_db"
"""Slider that is no parameter: an insertion loss, the same in all bands."""
HOOD_DB: Final = 20.0
"""Largest insertion loss of the slider."""
SETTINGS: Final = 12
"""Random settings of all sliders."""
COVERED: Final = 0.95
"""Part of further random settings whose error is within the limit."""
CONFIDENCE: Final = 0.95
"""Probability that the limit is so large."""


def slider_variables(
    sliders: Sequence[Slider],
    starts: Mapping[str, float],
    machines: int,
    seed: int,
    compute: Compute,
    coords: Mapping[str, Any],
) -> xr.Dataset:
    """Label the changes of the level by sliders, and those in random settings of all.

    Nothing where a sample or all settings have no solution.

    Parameters
    ----------
    sliders : sliders of parameters, to which that of a hood is added
    starts : median of each parameter by name
    machines : number of the weighted samples
    seed : seed of the random settings
    compute : gives the third octaves, shape (option, receiver, band)
    coords : the speed, options and microphones
    """
    unchanged = compute([(number, {}) for number in range(machines)])
    settings = _settings(sliders, seed)
    machine: IndexArray = np.arange(len(settings)) % machines
    after = compute(
        [
            (int(number), _sample(sliders, each))
            for number, each in zip(machine, settings, strict=True)
        ]
    )
    solved = [number for number, squares in enumerate(after) if squares is not None]
    if any(squares is None for squares in unchanged) or not solved:
        return xr.Dataset()
    bands = np.array([band_levels(squares) for squares in unchanged if squares is not None])
    settings, machine = settings[solved], machine[solved]
    levels = np.array([band_levels(squares) for squares in after if squares is not None])
    change = total_change(bands[machine], levels - bands[machine])
    added = np.array(
        [
            _added(sliders, each, bands, number)
            for number, each in zip(machine, settings, strict=True)
        ]
    )
    loss = np.linspace(0.0, HOOD_DB, NODES)
    reference = list(coords["option"]).index(REFERENCE_OPTION)
    without = bands[:, reference]
    of_hood = np.broadcast_to(-loss[:, None, None, None], (loss.size, *without.shape))
    by_node = np.array([*(slider.change_db for slider in sliders), of_hood])
    total = total_change(without, by_node)
    low, middle, high = np.quantile(total, (QUANTILES[0], 0.5, QUANTILES[1]), axis=2)
    names = [slider.limits.name for slider in sliders]
    values = {
        "slider_speed": coords["speed"][0],
        "slider_value": [*(slider.nodes for slider in sliders), loss],
        "slider_start": [*(starts[name] for name in names), 0.0],
        "slider_band_level": np.moveaxis(bands, 0, 1),
        "slider_band_change": by_node,
        "slider_total_change": middle,
        "slider_total_change_10_percent": low,
        "slider_total_change_90_percent": high,
        "slider_interpolation_error": [*(slider.error_db for slider in sliders), 0.0],
        "slider_setting_value": np.column_stack([settings, np.zeros(len(settings))]),
        "slider_setting_machine": machine + 1,
        "slider_setting_change": change,
        "slider_addition_error": tolerance_limit(added - change),
    }
    labels = {
        "noise_band": [band.nominal_hz for band in GAIN_BANDS],
        "slider": [*names, HOOD],
        "slider_node": np.arange(1, NODES + 1),
        "slider_machine": np.arange(1, machines + 1),
        "slider_setting": np.arange(1, len(settings) + 1),
    }
    return stamped(values, {**coords, **labels})


def tolerance_limit(error: Array) -> Array:
    """Return the limit of `COVERED` of all errors with the confidence `CONFIDENCE`, shape (...).

    Errors are normally distributed about zero (Howe 1969, J. Am. Stat. Assoc. 64, 610).

    Parameters
    ----------
    error : errors of random settings, shape (setting, ...)
    """
    number = len(error)
    factor = norm.ppf(0.5 + 0.5 * COVERED) * np.sqrt(number / chi2.ppf(1.0 - CONFIDENCE, number))
    return np.asarray(factor * np.sqrt(np.mean(error**2, axis=0)))


def _added(sliders: Sequence[Slider], setting: Array, band_level_db: Array, machine: int) -> Array:
    """Change of the level of a sample by all sliders together, shape (option, receiver), dB."""
    change = np.zeros(band_level_db.shape[2:])
    for slider, value in zip(sliders, setting.tolist(), strict=True):
        change += change_at(value, slider.nodes, slider.change_db[:, machine])
    return total_change(band_level_db[machine], change)


def _settings(sliders: Sequence[Slider], seed: int) -> Array:
    """Random values of all sliders over their ranges, shape (setting, slider)."""
    shares = np.random.default_rng((seed, SETTINGS)).random((SETTINGS, len(sliders)))
    ranges = [slider.limits for slider in sliders]
    return np.array([list(sample_at(ranges, row).values()) for row in shares])


def _sample(sliders: Sequence[Slider], setting: Array) -> Sample:
    values = zip(sliders, setting.tolist(), strict=True)
    return {key: number for slider, value in values for key, number in slider.sample(value).items()}
