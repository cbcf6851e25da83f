"""Levels around a machine in its loudest third octaves."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import power_of_level
from ..base.vocabulary import stamped
from ..mechanics.received_sound import ReceivedSound
from .bands import Band
from .by_source import filled_thirds, membership, weighting_power
from .labelled import level

_MOST_BANDS: Final = 3
_QUIETER_DB: Final = 40.0
"""Third octaves so far below the loudest are not shown."""
_MOST_IN_BAND: Final = 10
"""Frequencies in a third octave between which transfer vectors are interpolated."""
_DIRECTIONS: Final[Array] = 2.0 * np.pi * np.arange(36) / 36
_PLANES: Final = ("horizontal", "vertical")


def band_energy(sound: ReceivedSound, bands: Sequence[Band], weighting: str = "A") -> Array:
    """Compute mean squares of all sources together, shape (receiver, band), Pa²."""
    hertz = sound.lines.frequency_hz
    sounds = np.nan_to_num(hertz) > 0.0
    weight = weighting_power(weighting, np.where(sounds, hertz, 1.0)) * sounds
    energy = 0.5 * np.abs(sound.pressure.sum(axis=0)) ** 2 * weight @ membership(hertz, bands)
    for part in sound.noise:
        audible = part.power * weighting_power(weighting, part.frequency_hz)
        energy += audible @ membership(part.frequency_hz, bands)
    return np.asarray(energy)


def shift_to_medians(
    results: xr.Dataset, sound: Sequence[ReceivedSound], bands: Sequence[Band], receiver: int
) -> Array:
    """Levels of a study at a microphone less those of one sample, shape (option, band), dB.

    Parameters
    ----------
    results : `sources_band_level` of the speed and the options of `sound`, medians
    sound : at the microphones, of each option
    bands : third octaves
    receiver : number of the microphone
    """
    medians = results["sources_band_level"].isel(receiver=receiver)
    nominal = [band.nominal_hz for band in bands]
    wanted = medians.sel(noise_band=nominal).transpose("option", "noise_band").values
    of_sample = [level(band_energy(case, bands, "Z")[receiver]) for case in sound]
    return np.asarray(wanted - np.array(of_sample))


def loudest_bands(sound: ReceivedSound, receiver: int, highest_hz: float) -> list[Band]:
    """Choose the loudest third octaves at a microphone; none that is far below the loudest."""
    thirds = filled_thirds(highest_hz)
    energy = band_energy(sound, thirds)[receiver]
    ranked = np.argsort(-energy, kind="stable")[:_MOST_BANDS]
    audible = energy[ranked] >= power_of_level(-_QUIETER_DB) * energy.max()
    return [thirds[number] for number in np.sort(ranked[audible])]


def frequencies_of(bands: Sequence[Band], sound: Sequence[ReceivedSound]) -> Array:
    """Choose frequencies at which transfer vectors give the sound in third octaves.

    The lines and the edges of each band; evenly spaced ones where there are too many lines.
    """
    lines_hz = np.concatenate([case.lines.frequency_hz for case in sound])
    chosen: list[float] = []
    for band in bands:
        low, high = band.lower_hz, band.upper_hz
        within = set(lines_hz[(lines_hz > low) & (lines_hz < high)].tolist())
        few = len(within) <= _MOST_IN_BAND - 2
        chosen += [low, *within, high] if few else np.linspace(low, high, _MOST_IN_BAND).tolist()
    return np.array(sorted(set(chosen)))


def points_around(position_m: Sequence[float]) -> dict[str, Array]:
    """Return points in all directions of a horizontal and a vertical plane, by number.

    Parameters
    ----------
    position_m : position of a microphone about the centre of mass, x, y, z; its distance is that of
        the points, its azimuth that of the vertical plane
    """
    radius, azimuth = np.linalg.norm(position_m), np.arctan2(position_m[1], position_m[0])
    along, across = radius * np.cos(_DIRECTIONS), radius * np.sin(_DIRECTIONS)
    horizontal = np.stack([along, across, np.zeros_like(along)], axis=1)
    vertical = np.stack([along * np.cos(azimuth), along * np.sin(azimuth), across], axis=1)
    return {str(number): point for number, point in enumerate([*horizontal, *vertical])}


def polar_variables(
    options: Sequence[str],
    bands: Sequence[Band],
    position_m: Sequence[float],
    names: Sequence[str],
    sound: Sequence[ReceivedSound],
    shift_db: Array | float = 0.0,
) -> xr.Dataset:
    """Label the levels in all directions.

    Parameters
    ----------
    options : shown ones
    bands : third octaves
    position_m : position of the microphone, as for `points_around`
    names : names of the points that have sound
    sound : at these, of each option
    shift_db : added to the levels, shape (option, band)
    """
    levels = level(np.array([band_energy(case, bands) for case in sound]))
    levels = levels + np.expand_dims(shift_db, 1) if np.ndim(shift_db) else levels
    every = np.full((len(options), len(bands), len(_PLANES) * _DIRECTIONS.size), np.nan)
    every[..., [int(name) for name in names]] = np.moveaxis(levels, 1, 2)
    values = {
        "polar_level": every.reshape(*every.shape[:2], len(_PLANES), -1),
        "polar_radius": np.linalg.norm(position_m),
        "polar_azimuth": np.arctan2(position_m[1], position_m[0]),
    }
    coords = {
        "shown_option": list(options),
        "polar_band": [band.nominal_hz for band in bands],
        "polar_plane": list(_PLANES),
        "polar_direction": _DIRECTIONS,
    }
    return stamped(values, coords)
