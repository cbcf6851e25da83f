"""Levels of blocks of a signal, from their spectra."""

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.vocabulary import WEIGHTINGS, stamp
from ..base.weighting import WEIGHTING


def block_levels(
    spectra_pa: ComplexArray, frequency_hz: Array, resolution_hz: float, weighting: str
) -> Array:
    """Level of each block, all lines above 0 Hz together, dB re 20 µPa.

    By Parseval's theorem, with the window's noise bandwidth taken off (Heinzel, Rüdiger and
    Schilling 2002, equations 21 to 24).

    Parameters
    ----------
    spectra_pa : complex peaks, shape (..., block, frequency), Pa
    frequency_hz : shape (frequency,), evenly spaced from 0
    resolution_hz : noise bandwidth of a line
    weighting : A, C or Z

    Returns
    -------
    shape (..., block)
    """
    lines = resolution_hz / (frequency_hz[1] - frequency_hz[0])
    gain = power_of_level(WEIGHTING[weighting](frequency_hz[1:]))
    square = np.sum(gain * np.abs(spectra_pa[..., 1:]) ** 2, axis=-1) / (2.0 * lines)
    return mean_square_level(square, REFERENCE_PRESSURE_PA)


def labelled_block_levels(
    spectra: ComplexArray, frequency_hz: Array, resolution_hz: float, channel_unit: xr.DataArray
) -> xr.Dataset:
    """`block_level` (channel, block, weighting), not a number where a channel is no sound pressure.

    Empty where none is.

    Parameters
    ----------
    spectra : spectra of all channels, shape (channel, block, frequency)
    frequency_hz, resolution_hz : see `block_levels`
    channel_unit : (channel,)
    """
    is_pressure = channel_unit.values == "Pa"
    if not is_pressure.any():
        return xr.Dataset()
    blocks = spectra.shape[1]
    level = np.full((is_pressure.size, blocks, len(WEIGHTINGS)), np.nan)
    for number, weighting in enumerate(WEIGHTINGS):
        level[is_pressure, :, number] = block_levels(
            spectra[is_pressure], frequency_hz, resolution_hz, weighting
        )
    coords = {
        "channel": channel_unit["channel"],
        "block": np.arange(blocks),
        "weighting": list(WEIGHTINGS),
    }
    return xr.Dataset({"block_level": stamp("block_level", level, coords)})
