"""What the sound of every option is to an ear: tones, loudness and sharpness over results."""

from collections.abc import Callable
from itertools import product

import numpy as np
import xarray as xr

from .critical_bands import noise_criterion_db, prominence_criterion_db
from .ingredients import Ingredients, ingredients
from .loudness import loudness_of
from .tonality import Tone, tonal_spectrum, tones

MOST_EXCESS_DB = 60.0
"""Of a tone without any noise about it."""
NO_TONE_DB = -60.0


def excess_db(tone: Tone) -> float:
    """What a tone stands above the criterion of either ratio, dB; prominent from 0.

    Between -60 and 60 dB; -60 dB of a tone that is not audible.
    """
    if not tone.audible:
        return NO_TONE_DB
    over = max(
        tone.noise_ratio_db - noise_criterion_db(tone.frequency_hz),
        tone.prominence_db - prominence_criterion_db(tone.frequency_hz),
    )
    return float(np.clip(over, NO_TONE_DB, MOST_EXCESS_DB))


def most_prominent(judged: list[Tone]) -> Tone | None:
    """The tone with the largest excess; none where there are no tones."""
    return max(judged, key=excess_db, default=None)


def tone_excess(results: xr.Dataset) -> xr.DataArray:
    """Largest excess of a tone over the criterion of prominence, (option, receiver, speed), dB.

    Parameters
    ----------
    results : of a run
    """

    def largest(parts: list[Ingredients]) -> list[float]:
        all_tones = [tones(tonal_spectrum(part)) for part in parts]
        return [max(map(excess_db, judged), default=NO_TONE_DB) for judged in all_tones]

    return _of_every_case(results, largest)


def loudness(results: xr.Dataset) -> xr.DataArray:
    """Loudness, (option, receiver, speed), sone.

    Raises
    ------
    ParameterError
        mosqito is not installed.
    """
    return _of_every_case(results, lambda parts: [one.loudness_sone for one in loudness_of(parts)])


def sharpness(results: xr.Dataset) -> xr.DataArray:
    """Sharpness, (option, receiver, speed), acum; 0 of a sound that is hardly audible.

    Raises
    ------
    ParameterError
        mosqito is not installed.
    """
    return _of_every_case(
        results, lambda parts: [float(np.nan_to_num(o.sharpness_acum)) for o in loudness_of(parts)]
    )


def _of_every_case(
    results: xr.Dataset, figures: Callable[[list[Ingredients]], list[float]]
) -> xr.DataArray:
    dims = ("option", "receiver", "speed")
    names = [results[dim].values.tolist() for dim in dims]
    parts = [ingredients(results, str(o), str(r), float(s)) for o, r, s in product(*names)]
    values = np.reshape(figures(parts), tuple(map(len, names)))
    return xr.DataArray(values, dict(zip(dims, names, strict=True)), dims)
