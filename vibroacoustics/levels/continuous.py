"""Sound without tones by third octave: noise of the sources, and the remainder."""

from collections.abc import Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import stamped
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from .axes import LevelAxes
from .by_source import membership, weighting_power
from .labelled import level
from .measured_points import BASELINE_BANDS, MIDDLE_HZ, REMAINDER_BANDS

_OF_REMAINDER: Final = [BASELINE_BANDS.index(band) for band in REMAINDER_BANDS]


def noise_levels(
    axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound], remaining: Array
) -> xr.Dataset:
    """Levels in third octaves of what is no tone, unweighted.

    Parameters
    ----------
    axes : speeds, options and receivers
    received : sound of these cases, and of others
    remaining : A-weighted remainder, shape (speed, option, band of `REMAINDER_BANDS`), Pa²
    """
    noise = np.array([[_noise(received[s, o], axes) for o in axes.options] for s in axes.speeds])
    rest = np.zeros((*remaining.shape[:2], len(BASELINE_BANDS)))
    rest[..., _OF_REMAINDER] = remaining / weighting_power("A", MIDDLE_HZ[_OF_REMAINDER])
    bands = {"noise_band": [band.nominal_hz for band in BASELINE_BANDS]}
    values = {"noise_band_level": level(noise), "unmodelled_band_level": level(rest)}
    return stamped(values, axes.by_receiver | bands)


def _noise(sound: ReceivedSound, axes: LevelAxes) -> Array:
    """Mean squares of all sources' noise, shape (receiver, band), Pa²."""
    square = np.zeros((len(axes.receivers), len(BASELINE_BANDS)))
    for part in sound.noise:
        square += part.power @ membership(part.frequency_hz, BASELINE_BANDS)
    return square
