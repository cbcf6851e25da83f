"""Tones, loudness and sharpness of recorded sound as text, CSV, page and numbers."""

import math
from typing import Any, Final

import xarray as xr

from ..base import rounding
from ..measured.recorded_tones import tones_of
from ..report.blocks import Bullets
from ..report.html import html
from ..report.page import Page, Part
from ..report.tables import Table, to_csv, to_text
from ..sound.critical_bands import noise_criterion_db, prominence_criterion_db
from ..sound.loudness import NEEDED, available
from ..sound.tonality import Tone

MOST_TONES: Final = 20
TONE_HEAD: Final = ("Tone", "Hz", "dB", "over noise, dB", "over bands, dB")
_TIME_HEAD: Final = ("time, %", "swing, dB")
_PROMINENT: Final = {(True, True): "both", (True, False): "noise", (False, True): "bands"}
_COLUMNS: Final = (
    "channel", "frequency_hz", "level_db", "tone_to_noise_db", "tone_to_noise_criterion_db",
    "prominence_db", "prominence_criterion_db", "share_of_time", "swing_db", "prominent",
    "loudness_sone", "sharpness_acum",
)  # fmt: skip
_METHOD: Final = (
    "Tone-to-noise ratio and prominence ratio: ECMA-418-1, the criterion in brackets.",
    "A tone is prominent by one of the two ratios if it is audible and reaches its criterion.",
)


def tones_text(tones: xr.Dataset) -> str:
    """Tones of every channel with loudness and sharpness, for a terminal.

    Parameters
    ----------
    tones : from `recorded_tones`
    """
    texts = [
        "\n".join([to_text(table).rstrip("\n") if table.rows else table.caption, *loudness])
        for table, loudness in (_of_channel(tones, name) for name in _channels(tones))
    ]
    return "\n".join(texts if available() else [*texts, NEEDED])


def tones_csv(tones: xr.Dataset) -> bytes:
    """Every tone, a line each."""
    rows = []
    for name in _channels(tones):
        values = (tones[variable].sel(channel=name).item() for variable in _LOUDNESS)
        loudness = ["" if math.isnan(value) else value for value in values]
        rows += [(name, *_numbers(tone), _which(tone), *loudness) for tone in tones_of(tones, name)]
    return to_csv(_COLUMNS, rows)


def tones_html(tones: xr.Dataset) -> bytes:
    """Page with a table for each channel."""
    parts = []
    for number, name in enumerate(_channels(tones)):
        table, loudness = _of_channel(tones, name)
        blocks = (table, Bullets(tuple(loudness))) if loudness else (table,)
        parts.append(Part(f"channel_{number}", name, blocks))
    notes = _METHOD if available() else (*_METHOD, f"{NEEDED}.")
    parts.append(Part("method", "Method", (Bullets(notes),)))
    attrs = tones.attrs
    about = "Tones above the noise of their critical band, the strongest first."
    return html(Page(str(attrs["title"]), "Recording", attrs["created_utc"], tuple(parts), about))


def tone_numbers(tones: xr.Dataset) -> list[dict[str, Any]]:
    """Level of every tone, and loudness of every channel where it is available."""
    numbers = []
    for name in _channels(tones):
        numbers += [
            _number(
                tone.level_db, "dB", "recorded_tone_level", name, frequency_hz=tone.frequency_hz
            )
            for tone in tones_of(tones, name)
        ]
        for variable, unit in _LOUDNESS.items():
            value = tones[variable].sel(channel=name).item()
            if not math.isnan(value):
                numbers.append(_number(value, unit, variable, name))
    return numbers


_LOUDNESS: Final = {"recorded_loudness": "sone", "recorded_sharpness": "acum"}


def _number(
    value: float, unit: str, variable: str, channel: str, **selection: float
) -> dict[str, Any]:
    return {
        "value": value,
        "unit": unit,
        "variable": variable,
        "selection": {"channel": channel, **selection},
        "statistic": "value",
    }


def _channels(tones: xr.Dataset) -> list[str]:
    return [str(name) for name in tones["channel"].values]


def _of_channel(tones: xr.Dataset, name: str) -> tuple[Table, list[str]]:
    """Table of the strongest tones of a channel, and its loudness in words."""
    listed = tones_of(tones, name)
    rows = tuple((*tone_row(tone), *_times(tone), _which(tone)) for tone in listed[:MOST_TONES])
    caption = f"{name}: {len(listed)} listed above the noise of their critical band"
    if not rows:
        caption = f"{name}: no tone stands above the noise of its critical band"
    table = Table(caption, (*TONE_HEAD, *_TIME_HEAD, "prominent"), rows, frozenset({0, 7}))
    loudness, sharpness = (tones[variable].sel(channel=name).item() for variable in _LOUDNESS)
    if math.isnan(loudness):
        return table, []
    return table, [f"loudness {loudness:.3g} sone, sharpness {sharpness:.2f} acum"]


def _numbers(tone: Tone) -> tuple[float, ...]:
    return (
        tone.frequency_hz,
        tone.level_db,
        tone.noise_ratio_db,
        noise_criterion_db(tone.frequency_hz),
        tone.prominence_db,
        prominence_criterion_db(tone.frequency_hz),
        tone.share,
        tone.swing_db,
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


def _times(tone: Tone) -> tuple[str, str]:
    """Share of the time that a tone sounds, and how its level swings meanwhile."""
    return f"{100.0 * tone.share:.0f}", rounding.fixed(tone.swing_db)


def _which(tone: Tone) -> str:
    """By which of the two ratios it is prominent."""
    return _PROMINENT.get((tone.prominent_by_noise, tone.prominent_by_bands), "no")
