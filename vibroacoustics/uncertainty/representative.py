"""The representative sample: its choice, and its orders at the medians of all samples."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.ellipse import semi_major_axis
from ..base.vocabulary import REFERENCE_OPTION

_QUIETEST_DB: Final = 30.0
"""Sources so far below the machine do not count."""


_AMPLITUDES: Final = {
    "force_order": "force_amplitude",
    "moment_order": "moment_amplitude",
    "foot_force_order": "foot_force_amplitude",
}
"""Amplitudes of the sums of orders by source."""


def at_medians(motion: xr.Dataset, results: xr.Dataset, names: Sequence[str]) -> xr.Dataset:
    """Return the motion of the representative sample with the median amplitudes of all samples.

    Orders keep their phases and directions; histories over time stay those of the sample.

    Parameters
    ----------
    motion : motion of the sample
    results : medians of the amplitudes by order
    names : names of orders, `force_order`, `moment_order` or `foot_force_order`
    """
    scaled = {}
    for name in names:
        current = motion[name].sum("source").reduce(semi_major_axis, "axis")
        ratio = (results[_AMPLITUDES[name]] / current.where(current > 0.0)).fillna(1.0)
        scaled[name] = (motion[name] * ratio).transpose(*motion[name].dims)
    return motion.assign(
        {name: phasor.assign_attrs(motion[name].attrs) for name, phasor in scaled.items()}
    )


def nearest_row(results: xr.Dataset) -> int:
    """Return the row of the weighted samples nearest to the medians of the source levels.

    The distance is the root of the summed squares of deviations in dB without an option, over
    speeds, microphones, audible sources and unmodelled noise.

    Parameters
    ----------
    results : levels of sources and unmodelled noise, medians and by sample, and the weights
    """
    without = {"option": REFERENCE_OPTION}
    median = results["source_level"].sel(without)
    audible = median > results["level_total"].sel(without) - _QUIETEST_DB
    deviation = results["source_level_by_sample"].sel(without) - median
    others = [str(dim) for dim in deviation.dims if dim != "sample"]
    square = (deviation**2).where(audible, 0.0).sum(others)
    of_noise = results["level_unmodelled_by_sample"] - results["level_unmodelled"]
    points = results.sizes["speed"] * results.sizes["receiver"]
    distance = (square + points * of_noise**2).transpose("sample").values
    counts = results["sample_weight"].values[0] > 0.0
    return int(np.argmin(np.where(counts, distance, np.inf)))
