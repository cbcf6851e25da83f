"""Tones, loudness and sharpness of recorded sound as text."""

import math

import xarray as xr

from ..base import rounding
from ..base.errors import ParameterError
from ..report.tables import Table, to_text
from ..sound.critical_bands import noise_criterion_db, prominence_criterion_db
from ..sound.loudness import NEEDED, available, recorded_loudness
from ..sound.recorded import narrow_bands, recorded_spectrum
from ..sound.tonality import Tone, tones

MOST_TONES = 20
TONE_HEAD = ("Tone", "Hz", "dB", "over noise, dB", "over bands, dB")
_COURSE_HEAD = ("time, %", "swing, dB")
_PROMINENT = {(True, True): "both", (True, False): "noise", (False, True): "bands"}


def tones_text(recording: xr.Dataset) -> str:
    """Tones of every channel in Pa, with loudness and sharpness where mosqito is installed.

    Parameters
    ----------
    recording : as from `read_recording`

    Raises
    ------
    ParameterError
        No channel is in Pa, or the recording is too short.
    """
    signal = recording["signal"]
    microphones = signal.isel(channel=signal["channel_unit"].values == "Pa")
    if not microphones.sizes["channel"]:
        units = ", ".join(sorted(set(map(str, signal["channel_unit"].values))))
        raise ParameterError(f"channels: none is in Pa (there are {units}); see --unit")
    rate = float(recording.attrs["sample_rate_hz"])
    texts = [_of_channel(channel, rate) for channel in microphones]
    return "\n".join(texts if available() else [*texts, f"{NEEDED}\n"]).rstrip("\n")


def _of_channel(channel: xr.DataArray, sample_rate_hz: float) -> str:
    name = str(channel["channel"].item())
    bands = narrow_bands(channel.values, sample_rate_hz)
    judged = [tone for tone in tones(recorded_spectrum(bands)) if tone.noise_ratio_db > 0.0]
    rows = tuple((*tone_row(tone), *_course(tone), _which(tone)) for tone in judged[:MOST_TONES])
    caption = f"{name}: {len(judged)} tones above the noise of their critical band"
    text = (
        to_text(Table(caption, (*TONE_HEAD, *_COURSE_HEAD, "prominent"), rows, frozenset({0, 7})))
        if rows
        else f"{name}: no tone stands above the noise of its critical band\n"
    )
    if not available():
        return text
    loud = recorded_loudness(bands)
    return (
        f"{text}loudness {loud.loudness_sone:.3g} sone, sharpness {loud.sharpness_acum:.2f} acum\n"
    )


def tone_row(tone: Tone) -> tuple[str, ...]:
    """Cells under `TONE_HEAD`: ratios with the criterion in brackets."""
    return (
        tone.name,
        rounding.fixed(tone.frequency_hz),
        rounding.level(tone.level_db),
        _ratio(tone.noise_ratio_db, noise_criterion_db(tone.frequency_hz)),
        _ratio(tone.prominence_db, prominence_criterion_db(tone.frequency_hz)),
    )


def _ratio(value_db: float, criterion_db: float) -> str:
    value = rounding.fixed(value_db) if math.isfinite(value_db) else "∞"
    return f"{value} ({rounding.fixed(criterion_db)})"


def _course(tone: Tone) -> tuple[str, str]:
    """Share of the time that a tone sounds, and how its level swings meanwhile."""
    return f"{100.0 * tone.share:.0f}", rounding.fixed(tone.swing_db)


def _which(tone: Tone) -> str:
    """By which of the two ratios it is prominent."""
    return _PROMINENT.get((tone.prominent_by_noise, tone.prominent_by_bands), "no")
