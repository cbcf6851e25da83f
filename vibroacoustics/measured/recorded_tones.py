"""Tones, loudness and sharpness of recorded sound."""

import warnings
from collections.abc import Sequence
from itertools import zip_longest
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import label_coordinates, stamped
from ..results import provenance
from ..sound.audibility import tonal_adjustment_db
from ..sound.drift import drift_octaves
from ..sound.loudness import recorded_loudness
from ..sound.mean_audibility import MeanAudibility, mean_audibility
from ..sound.recorded import narrow_bands, recorded_spectrum
from ..sound.tonality import Tone, tones

FIELDS: Final = {
    "recorded_tone_frequency": "frequency_hz",
    "recorded_tone_level": "level_db",
    "recorded_tone_to_noise": "noise_ratio_db",
    "recorded_tone_prominence": "prominence_db",
    "recorded_tone_share": "share",
    "recorded_tone_swing": "swing_db",
}
"""Variable and attribute of a tone."""


def recorded_tones(recording: xr.Dataset) -> xr.Dataset:
    """Find the tones of every channel in Pa, with its loudness and sharpness.

    Returns
    -------
    variables `recorded_tone_*` (channel, recorded_tone), `recorded_loudness` and
    `recorded_sharpness` (channel); tones above the noise of their critical band, the strongest
    first; `recorded_decisive_*` (channel, audible_spectrum), `recorded_audibility*` and
    `recorded_tonal_adjustment` (channel)

    Raises
    ------
    ParameterError
        No channel is in Pa, or the recording is too short.

    Warns
    -----
    UserWarning
        A channel is too loud for a loudness.
    """
    signal = recording["signal"]
    microphones = signal.isel(channel=signal["channel_unit"].values == "Pa")
    if not microphones.sizes["channel"]:
        units = ", ".join(sorted(set(map(str, signal["channel_unit"].values))))
        raise ParameterError(f"channels: none is in Pa (available: {units}); see --unit")
    rate_hz = float(recording.attrs["sample_rate_hz"])
    listed, loudness, means, remarks = [], [], [], list[str]()
    for name, channel in zip(microphones["channel"].values, microphones, strict=True):
        octaves = drift_octaves(channel.values, rate_hz)
        if octaves:
            direction = "rise" if octaves > 0.0 else "fall"
            remarks.append(
                f"channel {str(name)!r}: is no steady recording: its lines {direction} by about "
                f"{abs(octaves):.1g} octaves; tones are means over time; "
                "give a steady part, or use `orders`"
            )
        bands = narrow_bands(channel.values, rate_hz)
        judged = tones(recorded_spectrum(bands))
        listed.append([tone for tone in judged if tone.noise_ratio_db > 0.0])
        means.append(mean_audibility(channel.values, rate_hz))
        try:
            loud = recorded_loudness(bands)
            loudness.append((loud.loudness_sone, loud.sharpness_acum))
        except ParameterError as error:  # a channel that is too loud leaves the others theirs
            loudness.append((np.nan, np.nan))
            remarks.append(f"channel {str(name)!r}: no {error}")
    coords = {
        "channel": microphones["channel"].values,
        "recorded_tone": np.arange(1.0, max(map(len, listed)) + 1.0),
        "audible_spectrum": np.arange(1.0, len(means[0].decisive) + 1.0),
    }
    table = list(zip_longest(*listed)) or []
    values = {
        name: np.array([[_value(tone, field) for tone in rank] for rank in table])
        .reshape(len(table), len(listed))
        .T
        for name, field in FIELDS.items()
    }
    loud_values = dict(
        zip(("recorded_loudness", "recorded_sharpness"), np.transpose(loudness), strict=True)
    )
    results = stamped({**values, **loud_values, **_audibility(means)}, coords)
    results.attrs = provenance.of_recording(recording.attrs, "tones")
    for line in remarks:
        warnings.warn(f"{provenance.recording_name(recording.attrs)}: {line}", stacklevel=2)
    if remarks:
        older = [recording.attrs[key] for key in ("reading_remarks",) if key in recording.attrs]
        results.attrs["reading_remarks"] = "; ".join([*older, *remarks])
    return label_coordinates(results)


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
