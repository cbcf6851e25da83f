"""Loudness of every option at a listener in the room."""

from collections.abc import Sequence
from contextlib import suppress
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import energy_sum
from ..base.errors import ParameterError
from ..sound.ingredients import ingredients
from ..sound.loudness import NEEDED, available, loudness_of
from .study import nearest_speed, options

SONE_HEAD: Final = "Loudness, sone (diffuse field)"
_HOW: Final = (
    "Loudness by ISO 532-1 (Zwicker, diffuse field) is that of the sound with the values as given, "
    "air and feet together, set to the level in the table."
)


def has_sound_in_room(results: xr.Dataset) -> bool:
    """Whether results hold what sounds at the listeners are made of."""
    return {"room_pressure_line", "noise_band_level"} <= set(results)


def sones(results: xr.Dataset, listener: str, levels_dba: Sequence[float]) -> list[str]:
    """Loudness of every option at a listener; empty where it cannot be computed.

    Parameters
    ----------
    results : of a run
    listener : one of its room
    levels_dba : to which the sounds are set, by option
    """
    if not (has_sound_in_room(results) and available()):
        return []
    speed = nearest_speed(results)
    at = results.sel(speed=speed, listener=listener)
    parts = [
        ingredients(results, option, listener, speed).louder(level - _given(at.sel(option=option)))
        for option, level in zip(options(results), levels_dba, strict=True)
    ]
    with suppress(ParameterError):  # louder than the standard goes: without it
        loud = loudness_of(parts, field="diffuse")
        return [rounding.fixed(one.loudness_sone) for one in loud]
    return []


def _given(at: xr.Dataset) -> float:
    """A-weighted level by air and by the feet with the values as given."""
    ways = [float(at[name]) for name in ("room_level", "room_plate_level") if name in at]
    return float(energy_sum(np.array(ways), axis=0))


def loudness_words(results: xr.Dataset) -> str:
    """How the loudness is computed, or what it needs."""
    if not has_sound_in_room(results):
        return ""
    return _HOW if available() else f"{NEEDED[0].upper()}{NEEDED[1:]}."
