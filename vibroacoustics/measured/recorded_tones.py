"""Tones, loudness and sharpness of recorded sound."""

import warnings
from collections.abc import Sequence
from itertools import zip_longest
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError
from ..base.vocabulary import label_coordinates, stamped
from ..results import provenance
from ..results.conditional import with_claims
from ..sound.audibility import tonal_adjustment_db
from ..sound.loudness import Loudness, recorded_loudness
from ..sound.mean_audibility import MeanAudibility, drift_octaves, mean_audibility
from ..sound.recorded import narrow_bands, recorded_spectrum
from ..sound.tonality import Tone, tones
from .tone_claims import VARIES_DB, ChannelSound, claims_of_channel

FIELDS: Final = {
    "recorded_tone_frequency": "frequency_hz",
    "recorded_tone_level": "level_db",
    "recorded_tone_to_noise": "noise_ratio_db",
    "recorded_tone_prominence": "prominence_db",
    "recorded_tone_share": "share",
    "recorded_tone_swing": "swing_db",
}
"""Variable and attribute of a tone."""
_FAST_S: Final = 0.125
"""Blocks of a level, s: the time constant F of IEC 61672-1."""
_LEAST_BLOCKS: Final = 8
_QUANTILES: Final = (0.05, 0.95)


def recorded_tones(recording: xr.Dataset) -> xr.Dataset:
    """Find the tones of every channel in Pa, with its loudness and sharpness.

    Returns
    -------
    variables `recorded_tone_*` (channel, recorded_tone), `recorded_loudness` and
    `recorded_sharpness` (channel); tones above the noise of their critical band, the strongest
    first; `recorded_decisive_*` (channel, audible_spectrum), `recorded_audibility*` and
    `recorded_tonal_adjustment` (channel). Attribute `conditional_claims`: which of these are bounds

    Raises
    ------
    ParameterError
        No channel is in Pa, or the recording is too short.

    Warns
    -----
    UserWarning
        A channel is too loud for a loudness, or its level varies.
    """
    signal = recording["signal"]
    microphones = signal.isel(channel=signal["channel_unit"].values == "Pa")
    if not microphones.sizes["channel"]:
        units = ", ".join(sorted(set(map(str, signal["channel_unit"].values))))
        raise ParameterError(f"channels: none is in Pa (available: {units}); see --unit")
    rate_hz = float(recording.attrs["sample_rate_hz"])
    listed, sounds, remarks = [], list[ChannelSound](), list[str]()
    for name, channel in zip(microphones["channel"].values, microphones, strict=True):
        octaves = drift_octaves(channel.values, rate_hz)
        if octaves:
            direction = "rise" if octaves > 0.0 else "fall"
            remarks.append(
                f"channel {str(name)!r}: is no steady recording: its lines {direction} by about "
                f"{abs(octaves):.1g} octaves; tones are means over time; "
                "give a steady part, or use `orders`"
            )
        variation_db = _variation_db(channel.values, rate_hz)
        if variation_db >= VARIES_DB:
            remarks.append(_variation(str(name), variation_db))
        bands = narrow_bands(channel.values, rate_hz)
        judged = tones(recorded_spectrum(bands))
        listed.append([tone for tone in judged if tone.noise_ratio_db > 0.0])
        mean = mean_audibility(channel.values, rate_hz)
        try:
            loud = recorded_loudness(bands)
        except ParameterError as error:  # a channel that is too loud leaves the others theirs
            loud = Loudness(np.nan, np.nan)
            remarks.append(f"channel {str(name)!r}: no {error}")
        sounds.append(ChannelSound(str(name), loud, mean, variation_db, octaves, rate_hz))
    coords = {
        "channel": microphones["channel"].values,
        "recorded_tone": np.arange(1.0, max(map(len, listed)) + 1.0),
        "audible_spectrum": np.arange(1.0, len(sounds[0].mean.decisive) + 1.0),
    }
    table = list(zip_longest(*listed)) or []
    values = {
        name: np.array([[_value(tone, field) for tone in rank] for rank in table])
        .reshape(len(table), len(listed))
        .T
        for name, field in FIELDS.items()
    }
    loud_values = {
        "recorded_loudness": np.array([each.loudness.loudness_sone for each in sounds]),
        "recorded_sharpness": np.array([each.loudness.sharpness_acum for each in sounds]),
    }
    results = stamped(
        {**values, **loud_values, **_audibility([each.mean for each in sounds])}, coords
    )
    results.attrs = provenance.of_recording(recording.attrs, "tones")
    results = with_claims(results, [claim for each in sounds for claim in claims_of_channel(each)])
    for line in remarks:
        warnings.warn(f"{provenance.recording_name(recording.attrs)}: {line}", stacklevel=2)
    if remarks:
        older = [recording.attrs[key] for key in ("reading_remarks",) if key in recording.attrs]
        results.attrs["reading_remarks"] = "; ".join([*older, *remarks])
    return label_coordinates(results)


def _variation_db(pressure_pa: Array, rate_hz: float) -> float:
    """Range of the level over time (L5 - L95), dB; 0 of a short or silent channel."""
    samples = round(_FAST_S * rate_hz)
    blocks = pressure_pa[: pressure_pa.size // samples * samples].reshape(-1, samples)
    if len(blocks) < _LEAST_BLOCKS or not blocks.any():
        return 0.0
    rms = np.sqrt(np.mean(blocks**2, axis=1))
    lowest, highest = np.quantile(level_of_amplitude(rms), _QUANTILES)
    return float(highest - lowest)


def _variation(name: str, variation_db: float) -> str:
    """A line on a channel whose level varies: ISO 532-1 has another method for such sound."""
    return (
        f"channel {name!r}: its level varies by {variation_db:.0f} dB (L5 - L95 of "
        f"{1e3 * _FAST_S:.0f} ms): loudness and sharpness are those of steady sound (ISO 532-1), "
        "N5 may be 1.7 times as high: analyse a steady part"
    )


def _audibility(means: Sequence[MeanAudibility]) -> dict[str, Array]:
    """Audibility of the tones of every channel, over its spectra and in the mean."""
    mean_db = np.array([mean.audibility_db for mean in means])
    return {
        "recorded_decisive_audibility": np.array([mean.spectra_db for mean in means]),
        "recorded_decisive_frequency": np.array(
            [[tone.frequency_hz if tone else np.nan for tone in mean.decisive] for mean in means]
        ),
        "recorded_audibility": mean_db,
        "recorded_audibility_uncertainty": np.array([mean.uncertainty_db for mean in means]),
        "recorded_tonal_adjustment": tonal_adjustment_db(mean_db),
    }


def tones_of(listed: xr.Dataset, channel: str) -> list[Tone]:
    """Tones of a channel, the strongest first."""
    columns = [listed[name].sel(channel=channel).values.tolist() for name in FIELDS]
    return [
        Tone(f"{values[0]:.1f} Hz", *values)
        for values in zip(*columns, strict=True)
        if np.isfinite(values[0])
    ]


def _value(tone: Tone | None, field: str) -> float:
    return np.nan if tone is None else float(getattr(tone, field))
