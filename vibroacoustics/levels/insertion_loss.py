"""Insertion losses of options for airborne sound."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..machine.option import Option


def airborne_factor(options: Mapping[str, Option], order_frequency: xr.DataArray) -> xr.DataArray:
    """Pressure with each option's insertion loss over that without it, (option, speed, order).

    Parameters
    ----------
    options : by name
    order_frequency : (speed, order), Hz
    """
    losses = [option.insertion_loss() for option in options.values()]
    factor = [
        np.ones(order_frequency.shape)
        if loss is None
        else loss.amplitude_factor(order_frequency.values)
        for loss in losses
    ]
    coords = {"option": list(options), **{n: order_frequency[n] for n in order_frequency.dims}}
    return xr.DataArray(factor, coords, ("option", *order_frequency.dims))


def airborne(options: Mapping[str, Option], results: xr.Dataset) -> xr.Dataset:
    """Return results whose velocities are less by each option's insertion loss."""
    factor = airborne_factor(options, results["order_frequency"])
    return results.assign(velocity_order=factor * results["velocity_order"])


def remaining_factor(options: Mapping[str, Option], frequency_hz: Array) -> Array:
    """Mean square of a sound with each option's insertion loss over that without, (option, band).

    Parameters
    ----------
    options : by name
    frequency_hz : midband frequency, Hz, shape (band,)
    """
    losses = [option.insertion_loss() for option in options.values()]
    factors = [1.0 if loss is None else loss.power_factor(frequency_hz) for loss in losses]
    return np.array([np.ones(len(frequency_hz)) * factor for factor in factors])
