"""Sound files: WAV of 32-bit floats and FLAC of 24 bits, at a stated pressure at full scale."""

import io
from collections.abc import Callable
from typing import Final

import numpy as np
from scipy.io import wavfile

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..recordings.riff import with_comment
from ..recordings.stated_scale import scale_comment
from .gain import peak_of_tone

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
