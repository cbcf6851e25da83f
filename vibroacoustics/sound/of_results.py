"""Loudness and sharpness of the sound of every option over results."""

from collections.abc import Callable
from itertools import product

import numpy as np
import xarray as xr

from .ingredients import Ingredients, ingredients
from .loudness import loudness_of


def loudness(results: xr.Dataset) -> xr.DataArray:
    """Loudness, (option, receiver, speed), sone.

    Raises
    ------
    ParameterError
        mosqito is not installed.
    """
    return _of_every_case(results, lambda parts: [one.loudness_sone for one in loudness_of(parts)])


def sharpness(results: xr.Dataset) -> xr.DataArray:
    """Sharpness, (option, receiver, speed), acum; 0 of a sound that is hardly audible.

    Raises
    ------
    ParameterError
        mosqito is not installed.
    """
    return _of_every_case(
        results, lambda parts: [float(np.nan_to_num(o.sharpness_acum)) for o in loudness_of(parts)]
    )


def _of_every_case(
    results: xr.Dataset, figures: Callable[[list[Ingredients]], list[float]]
) -> xr.DataArray:
    dims = ("option", "receiver", "speed")
    names = [results[dim].values.tolist() for dim in dims]
    parts = [ingredients(results, str(o), str(r), float(s)) for o, r, s in product(*names)]
    values = np.reshape(figures(parts), tuple(map(len, names)))
    return xr.DataArray(values, dict(zip(dims, names, strict=True)), dims)
