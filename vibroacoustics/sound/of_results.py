"""Loudness and sharpness of the sound of every option over results."""

from collections.abc import Iterable
from contextlib import suppress
from itertools import product

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import stamped
from .ingredients import ingredients
from .loudness import NEEDED, SoundField, available, loudness_of

_AT_RECEIVERS = ("pressure_line", "noise_band_level", "unmodelled_band_level")
_IN_ROOM = ("room_pressure_line", "noise_band_level")


def hearing_variables(results: xr.Dataset) -> xr.Dataset:
    """Label loudness and sharpness of every option, at the microphones and in a room.

    They are not a number at a microphone and speed at which some option is louder than the
    standard allows; sharpness is none either of a sound that is hardly audible.

    Parameters
    ----------
    results : with the sound of every option

    Raises
    ------
    ParameterError
        mosqito is not installed.
    """
    if not available():
        raise ParameterError(NEEDED)
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
    dims = ("speed", "option", where)
    speeds, options, positions = (results[dim].values.tolist() for dim in dims)
    values = np.full((2, len(speeds), len(options), len(positions)), np.nan)
    for (s, speed), (p, position) in product(enumerate(speeds), enumerate(positions)):
        with suppress(ParameterError):  # louder than the standard goes
            values[:, s, :, p] = _of_options(results, options, position, speed, field)
    return values


def _of_options(
    results: xr.Dataset, options: Iterable[str], position: str, speed: float, field: SoundField
) -> Array:
    """Loudness and sharpness of the options at a position and speed, shape (2, option)."""
    parts = [ingredients(results, option, position, speed) for option in options]
    loud = loudness_of(parts, field)
    return np.array([[one.loudness_sone, one.sharpness_acum] for one in loud]).T
