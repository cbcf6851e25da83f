"""Loudness and sharpness of the sound of every option over results."""

from itertools import product

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import stamped
from .ingredients import Ingredients, ingredients
from .loudness import loudness_of
from .zwicker import SoundField

_AT_RECEIVERS = ("pressure_line", "noise_band_level", "unmodelled_band_level")
_IN_ROOM = ("room_pressure_line", "noise_band_level")


def hearing_variables(results: xr.Dataset) -> xr.Dataset:
    """Label loudness and sharpness of every option, at the microphones and in a room.

    They are not a number at a microphone and speed at which some option is louder than the
    standard allows; sharpness is none either of a sound that is hardly audible.

    Parameters
    ----------
    results : with the sound of every option
    """
    labelled = xr.Dataset()
    if set(_AT_RECEIVERS) <= set(results):
        loud, sharp = _of_every_case(results, "receiver", "free")
        labelled = _stamped(results, "receiver", {"loudness": loud, "sharpness": sharp})
    if set(_IN_ROOM) <= set(results):
        loud, _ = _of_every_case(results, "listener", "diffuse")
        labelled = labelled.merge(_stamped(results, "listener", {"loudness_in_room": loud}))
    return labelled


def with_hearing(results: xr.Dataset) -> xr.Dataset:
    """Return results with loudness and sharpness, which those of some runs lack."""
    return results if "loudness" in results else results.merge(hearing_variables(results))


def _stamped(results: xr.Dataset, where: str, values: dict[str, Array]) -> xr.Dataset:
    return stamped(values, {dim: results[dim].values for dim in ("speed", "option", where)})


def _of_every_case(results: xr.Dataset, where: str, field: SoundField) -> Array:
    """Loudness and sharpness, shape (2, speed, option, position)."""
    speeds, options, positions = (
        results[dim].values.tolist() for dim in ("speed", "option", where)
    )
    groups = [
        [ingredients(results, option, position, speed) for option in options]
        for speed, position in product(speeds, positions)
    ]
    values = np.array(_of_groups(groups, field))
    return np.moveaxis(values.reshape(len(speeds), len(positions), len(options), 2), (3, 2), (0, 2))


def _of_groups(groups: list[list[Ingredients]], field: SoundField) -> list[list[list[float]]]:
    """Loudness and sharpness of groups of sounds; not a number in a group with too loud a sound."""
    try:
        loud = loudness_of([part for group in groups for part in group], field)
    except ParameterError:
        if len(groups) == 1:
            return [[[np.nan, np.nan]] * len(groups[0])]
        half = len(groups) // 2
        return _of_groups(groups[:half], field) + _of_groups(groups[half:], field)
    size = len(groups[0])
    pairs = [[sound.loudness_sone, sound.sharpness_acum] for sound in loud]
    return [pairs[first : first + size] for first in range(0, len(pairs), size)]
