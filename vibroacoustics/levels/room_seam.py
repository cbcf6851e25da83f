"""Both methods of a room side by side around the frequencies where one follows the other."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, mean_square_level
from ..base.vocabulary import check, stamp
from .measured_points import BASELINE_BANDS, MIDDLE_HZ
from .room_levels import REFERENCE_POWER_W

_ROUNDED = 1.02


def seam_variables(
    listeners: Sequence[str],
    waves: Array,
    diffuse: Array,
    gain: float,
    between_hz: tuple[float, float],
) -> xr.Dataset:
    """Levels at the listeners over the sound power level by both methods, and their difference.

    Parameters
    ----------
    listeners : their names
    waves : mean square per power in `BASELINE_BANDS`, shape (listener, band), Pa²/W
    diffuse : the same by direct sound and diffuse field, without the gain
    gain : of the power at the machine's place, which the diffuse field takes over
    between_hz : lowest and highest middle of the bands
    """
    low, high = between_hz
    shown = np.flatnonzero((low / _ROUNDED < MIDDLE_HZ) & (high * _ROUNDED > MIDDLE_HZ))
    coords = {
        "listener": list(listeners),
        "seam_band": [BASELINE_BANDS[number].nominal_hz for number in shown],
    }
    by_waves, by_power = (
        mean_square_level(each[:, shown] * REFERENCE_POWER_W, REFERENCE_PRESSURE_PA)
        for each in (waves, gain * diffuse)
    )
    arrays = {
        "room_gain_waves": stamp("room_gain_waves", by_waves, coords),
        "room_gain_diffuse": stamp("room_gain_diffuse", by_power, coords),
        "room_gain_difference": stamp("room_gain_difference", by_waves - by_power, coords),
        "room_place_gain": stamp("room_place_gain", level_of_power(gain)),
    }
    return check(xr.Dataset(arrays))
