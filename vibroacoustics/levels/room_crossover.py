"""Comparison of both methods of a room around the crossover frequencies."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_POWER_W, REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..base.vocabulary import stamped
from .in_room import ROUNDED
from .measured_points import BASELINE_BANDS, MIDDLE_HZ


def shown_bands(between_hz: tuple[float, float]) -> IndexArray:
    """Numbers of the `BASELINE_BANDS` in which both methods are shown."""
    low, high = between_hz
    return np.flatnonzero((low / ROUNDED < MIDDLE_HZ) & (high * ROUNDED > MIDDLE_HZ))


def crossover_variables(
    listeners: Sequence[str], shown: IndexArray, waves: Array, diffuse: Array, gains_db: Array
) -> xr.Dataset:
    """Levels at the listeners relative to the sound power level by both methods, and difference.

    Parameters
    ----------
    listeners : names of the listeners
    shown : numbers of the bands, shape (shown band,)
    waves : mean square per power by waves, shape (listener, shown band), Pa²/W
    diffuse : mean square by direct sound and diffuse field per power in the open, shape (listener,
        shown band), Pa²/W
    gains_db : gain of the diffuse field in the shown bands and in all bands above, shape (shown
        band + 1,), dB: mean difference of both methods over the listeners, not part of `diffuse`
    """
    bands = [BASELINE_BANDS[number].nominal_hz for number in shown]
    by_waves, by_power = (
        mean_square_level(each * REFERENCE_POWER_W, REFERENCE_PRESSURE_PA)
        for each in (waves, diffuse)
    )
    values = {
        "room_gain_waves": by_waves,
        "room_gain_diffuse": by_power,
        "room_gain_difference": by_waves - by_power,
        "room_place_gain": gains_db[:-1],
        "room_place_gain_above": gains_db[-1],
    }
    return stamped(values, {"listener": list(listeners), "seam_band": bands})
