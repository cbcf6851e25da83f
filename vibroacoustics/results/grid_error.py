"""Error of transfer vectors, estimated from two grids or meshes."""

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import level_of_amplitude


def grid_error_db(results: xr.Dataset, receiver: str) -> float:
    """Return the error at a microphone, dB, root mean square over motions and frequencies."""
    error, size = 0.0, 0.0
    for name in ("transfer_vector", "pattern_transfer_vector"):
        if f"{name}_error" in results:
            error += float((results[f"{name}_error"].sel(receiver=receiver) ** 2).sum())
            size += float((np.abs(results[name].sel(receiver=receiver)) ** 2).sum())
    return level_of_amplitude(1.0 + np.sqrt(error / size)) if size > 0.0 else 0.0


def loud_errors_db(results: xr.Dataset) -> Array:
    """Return the errors where vectors are within 20 dB of the loudest microphone, dB.


    Returns
    -------
    shape (vector,); empty where all vectors are silent
    """
    size = np.abs(results["transfer_vector"].values)
    loud = size > 0.1 * size.max(axis=0)
    error = results["transfer_vector_error"].values[loud]
    return np.asarray(level_of_amplitude(1.0 + error / size[loud]))
