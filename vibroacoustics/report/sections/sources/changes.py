"""Impacts of keys, with the option and without it."""

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.arrays import Array
from ....base.remembered import remembered
from ....results.stored_study import options, speeds


def key_impacts(results: xr.Dataset, option: str) -> list[str]:
    """Impacts of keys per revolution and the largest force on a key, where there are impacts."""
    texts = []
    for prefix, whose in (("key", "Keys of the ring"), ("twin_key", "Keys of the second ring")):
        count = key_figure(results, option, f"{prefix}_impacts_per_revolution")
        force = key_figure(results, option, f"{prefix}_force_peak_n")
        if np.nanmax(count, initial=0.0) > 0.0:
            often = rounding.span(count, rounding.fixed)
            most = rounding.significant(float(np.nanmax(force)))
            texts.append(f"{whose}: {often} impacts per revolution, up to {most} N on a key.")
    return texts


def key_figure(results: xr.Dataset, option: str, name: str) -> Array:
    """A figure of the sources at every speed; NaN where the option has none."""
    nothing = np.full(len(speeds(results)), np.nan)
    return np.asarray(_figures(results)[option].get(name, nothing))


@remembered
def _figures(results: xr.Dataset) -> dict[str, dict[str, Array]]:
    """Figures of the sources at every speed, by option and name."""
    figures = results["reported_figure"].transpose("option", "figure", "speed")
    names = figures["figure"].values.tolist()
    of_options = zip(options(results), figures.values, strict=True)
    return {option: dict(zip(names, rows, strict=True)) for option, rows in of_options}
