"""Comparison of both methods of a room around crossover, and levels over a plane of it."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_POWER_W, REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.vocabulary import REFERENCE_OPTION, stamped
from ..study.study import Study
from .by_source import weighting_power
from .in_room import ROUNDED, frequencies_of
from .measured_points import BASELINE_BANDS, MIDDLE_HZ

LOWEST_HZ: Final = 31.5
"""Lowest third octave of a map."""


def map_bands_hz() -> dict[float, Array]:
    """Frequencies that stand for each band of a map, however high, by its nominal middle."""
    return {
        band.nominal_hz: frequencies_of(band)
        for band in BASELINE_BANDS
        if band.nominal_hz >= LOWEST_HZ
    }


def map_level(study: Study, gain: xr.DataArray, power_w: Array, height_m: float) -> xr.Dataset:
    """Compute the A-weighted level over the plane, of the machine without an option.

    At the speed nearest to that of the published level, in the bands of the gains.

    Parameters
    ----------
    study : with its speeds
    gain : level over the power level, (room_map_y, room_map_x, seam_band), dB
    power_w : unweighted, in `BASELINE_BANDS`, shape (speed, option, band)
    height_m : height of the plane
    """
    speeds = study.operation.speed_rpm
    nearest = min(speeds, key=lambda speed: abs(speed - study.catalogue_speed_rpm))
    of_machine = power_w[speeds.index(nearest), list(study.options).index(REFERENCE_OPTION)]
    names = [band.nominal_hz for band in BASELINE_BANDS]
    rows = [names.index(float(middle)) for middle in gain["seam_band"].values]
    weight = (of_machine * weighting_power("A", MIDDLE_HZ))[rows] / REFERENCE_POWER_W
    values = gain.transpose("room_map_y", "room_map_x", "seam_band").values
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(values) @ weight
    air = np.isfinite(square)
    level = np.full(square.shape, np.nan)
    level[air] = mean_square_level(square[air], REFERENCE_PRESSURE_PA)
    coords = {name: gain[name].values for name in ("room_map_y", "room_map_x")}
    made = stamped({"room_map_level": level}, coords)
    about = {"speed_rpm": nearest, "height_m": height_m, "highest_band_hz": names[rows[-1]]}
    made["room_map_level"].attrs |= about
    return made


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
