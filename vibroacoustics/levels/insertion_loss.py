"""What options leave of the airborne sound: insertion losses by option."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import power_of_level
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


def remaining_share(options: Mapping[str, Option]) -> Array:
    """Share that each option leaves of the energy of sound that no source explains, (option,).

    Its spectrum is not known: it is taken as spread evenly over the bands of the loss.
    """
    losses = [option.insertion_loss() for option in options.values()]
    even_db = np.array([0.0 if loss is None else loss.even_db for loss in losses])
    return power_of_level(-even_db)
