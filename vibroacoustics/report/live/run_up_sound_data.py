"""Sound of a run-up for the page: envelopes of 16 bits, the residual of 8 bits by the µ-law."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...base.arrays import Array
from ...results.over_speed.run_up_sound import RunUpSound
from .assets import packed

MU: Final = 255.0
"""Constant of the µ-law (ITU-T G.711): of 8 bits, its noise is 35 dB below a loud residual."""
_LARGEST: Final = 32767


def sound_data(sound: RunUpSound) -> dict[str, Any]:
    """Values for the script that plays a run-up; see `mu_law` and `RunUpSound`."""
    peak = max(float(np.abs(sound.residual).max()), 1e-30)
    parts = np.stack([sound.envelope.real, sound.envelope.imag], axis=1)
    largest = np.maximum(np.abs(parts).max(axis=(1, 2)), 1e-30)
    scaled = np.round(parts / largest[:, None, None] * _LARGEST).astype("<i2")
    return {
        "start_s": sound.start_s,
        "rate_hz": sound.sample_rate_hz,
        "residual": packed(mu_law(sound.residual / peak).tobytes()),
        "residual_peak": peak,
        "orders": sound.order.tolist(),
        "envelope_rate_hz": sound.envelope_rate_hz,
        "envelopes": packed(scaled.tobytes()),
        "envelope_peaks": largest.tolist(),
        "shaft_hz": sound.shaft_hz.round(5).tolist(),
    }


def mu_law(sample: Array) -> NDArray[np.uint8]:
    """Samples from -1 to 1 as 8 bits: 128 + 127 sign(x) ln(1 + µ|x|) / ln(1 + µ).

    Examples
    --------
    >>> from vibroacoustics.report.live.run_up_sound_data import mu_law
    >>> mu_law(np.array([-1.0, 0.0, 1.0]))
    array([  1, 128, 255], dtype=uint8)
    """
    size = np.log1p(MU * np.abs(sample)) / np.log1p(MU)
    return np.asarray(np.round(128.0 + 127.0 * np.sign(sample) * size), dtype=np.uint8)
