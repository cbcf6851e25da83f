"""Sound files, WAV and FLAC, at a stated pressure at full scale that is one for a study."""

import io
from collections.abc import Callable
from itertools import product
from typing import Final

import numpy as np
import xarray as xr
from scipy.io import wavfile

from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level
from ..base.errors import ParameterError
from ..base.remembered import remembered
from ..recordings.riff import scale_comment, with_comment
from .ingredients import Ingredients, ingredients, positions

_STEPS: Final = [2e-5, 5e-5, *(float(f"{n}e{k}") for k in range(-4, 6) for n in (1, 2, 5))]
"""Steps from the threshold of hearing on, Pa."""
_CREST: Final = 5.5
"""Largest value of ten minutes of Gaussian noise over its effective value."""


def full_scale_of(results: xr.Dataset, calibration_db: float | None = None) -> float:
    """Pressure at full scale that no option exceeds at any microphone, listener and speed, Pa.

    A number 1, 2 or 5 times a power of ten, so that files of one study, made at different times,
    have the same gain.

    Parameters
    ----------
    results : results of a run, with its noise by third octave
    calibration_db : level of a tone that has to fit, too
    """
    highest = _highest(results)
    if calibration_db is not None:
        highest = max(highest, peak_of_tone(calibration_db))
    return next_full_scale(highest)


@remembered
def _highest(results: xr.Dataset) -> float:
    """Pressure that no option exceeds anywhere, Pa."""
    names = [results[dim].values.tolist() for dim in ("option", "speed")]
    microphones = results["receiver"].values.tolist()
    receivers = positions(results) if "room_pressure_line" in results else microphones
    cases = product(names[0], receivers, names[1])
    return max(_peak(ingredients(results, *case)) for case in cases)


def _peak(sound: Ingredients) -> float:
    noise = np.sqrt(np.sum(sound.bands.pressure_pa**2))
    return float(np.abs(sound.lines.pressure_pa).sum() + _CREST * noise)


def peak_of_tone(level_db: float) -> float:
    """Peak of a tone of calibration, Pa."""
    check_range("calibration", level_db, 0.0, 140.0, "dB")
    return float(np.sqrt(2.0) * REFERENCE_PRESSURE_PA * amplitude_of_level(level_db))


def next_full_scale(value: float) -> float:
    """The next of 1, 2, 5, 10, 20, …, 2e-5 at least: in pascal the threshold of hearing."""
    return next((step for step in _STEPS if step >= value * (1.0 - 1e-9)), value)


CALIBRATION_HZ: Final = 1000.0


def wav_bytes(sound: Array, sample_rate_hz: int, full_scale_pa: float, unit: str = "Pa") -> bytes:
    """A WAV file of 32-bit floats, its full scale in its comment."""
    content = io.BytesIO()
    wavfile.write(content, sample_rate_hz, sound.astype(np.float32))
    return with_comment(content.getvalue(), scale_comment([(full_scale_pa, unit)]))


def flac_bytes(sound: Array, sample_rate_hz: int, full_scale_pa: float) -> bytes:
    """A FLAC file of 24 bits, its full scale in its comment.

    Raises
    ------
    ParameterError
        soundfile is not installed.
    """
    try:
        import soundfile
    except ImportError:
        raise ParameterError(
            "format = flac: needs soundfile: pip install 'vibroacoustics[sound]'"
        ) from None
    content = io.BytesIO()
    with soundfile.SoundFile(
        content, "w", sample_rate_hz, channels=1, format="FLAC", subtype="PCM_24"
    ) as file:
        file.comment = scale_comment([(full_scale_pa, "Pa")])
        file.write(sound)
    return content.getvalue()


FORMATS: Final[dict[str, Callable[[Array, int, float], bytes]]] = {
    "wav": wav_bytes,
    "flac": flac_bytes,
}


def at_gain(pressure_pa: Array, full_scale_pa: float) -> Array:
    """Samples of a file, between -1 and 1.

    Raises
    ------
    ParameterError
        The sound exceeds full scale.
    """
    highest = float(np.max(np.abs(pressure_pa), initial=0.0))
    if highest > full_scale_pa:
        raise ParameterError(
            f"full scale = {full_scale_pa:g} Pa: the sound reaches {highest:.3g} Pa; give as much"
        )
    return pressure_pa / full_scale_pa


def calibration_tone(level_db: float, samples: int, sample_rate_hz: int) -> Array:
    """A tone of 1 kHz of a level, Pa."""
    turn = 2.0 * np.pi * CALIBRATION_HZ / sample_rate_hz
    return np.asarray(peak_of_tone(level_db) * np.sin(turn * np.arange(samples)))
