"""Order map of a stop, labelled."""

from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import AXES, check, stamp
from ..orders import OrderMap, angular_resample, from_angle, order_map
from .coasting import RunDown
from .stops import Stops

MAP_REVOLUTIONS: Final = 8
"""Revolutions in a block of the order map: orders 0.19 apart are separated."""
KERNEL_REVOLUTIONS: Final = 2
"""Lost to the resampling's kernel, which spans 1.6 for the orders below."""
MAP_ORDER: Final = 4
MAP_SAMPLES: Final = 32
"""Samples of the run-down per revolution at full speed, for the order map."""


def stopping_order_map(stops: Stops, speed_rpm: float) -> xr.Dataset:
    """Order map of a stop without gas load; empty where it lasts too few revolutions or too long.

    A stop from the highest speed runs through all others. Under load it is over within a few
    revolutions, too few to separate orders.

    Parameters
    ----------
    stops : stops of the machine
    speed_rpm : before switch-off
    """
    no_gas = stops.stopping.model_copy(update={"gas_share_ratio": 0.0})
    rate_hz = MAP_SAMPLES * shaft_frequency_hz(speed_rpm)
    if no_gas.friction_torque_n_m == 0.0:  # it would never stop
        return xr.Dataset()
    try:
        run = replace(stops, stopping=no_gas, after=None).run_down(speed_rpm, rate_hz, 0)
    except ParameterError:  # friction alone takes too long
        return xr.Dataset()
    if run.crank_angle_rad[-1] < 2.0 * np.pi * (MAP_REVOLUTIONS + KERNEL_REVOLUTIONS):
        return xr.Dataset()
    return _labelled(_spectra(run, rate_hz))


def _spectra(run: RunDown, rate_hz: float) -> OrderMap:
    motion = from_angle(run.time_s, run.crank_angle_rad)
    signal = angular_resample(run.force_n.sum(axis=0), rate_hz, motion, MAP_ORDER)
    return order_map(signal, 1.5 / MAP_REVOLUTIONS, overlap_ratio=0.75)


def _labelled(spectra: OrderMap) -> xr.Dataset:
    coords = {
        "axis": list(AXES),
        "stopping_block": np.arange(spectra.time_s.size),
        "map_order": spectra.order,
        "stopping_block_time": ("stopping_block", spectra.time_s),
        "stopping_block_speed": ("stopping_block", 60.0 * spectra.shaft_frequency_hz),
    }
    labelled = stamp("stopping_order_map", np.abs(spectra.amplitude), coords)
    return check(xr.Dataset({"stopping_order_map": labelled}))
