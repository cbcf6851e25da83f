"""Analysis of tones, loudness and sharpness of recorded sound."""

import math
from collections.abc import Iterator
from typing import Final

import xarray as xr

from ..base import rounding
from ..measured.recorded_tones import tones_of
from ..report.analysis import Analysis, origin
from ..report.blocks import Block, Bullets, Part, Text
from ..report.tables import Cell, DataTable, Table, columns_of
from ..results.number import Number
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


def analysis_of_tones(tones: xr.Dataset) -> Analysis:
    """Return tones of every channel with loudness and sharpness."""
    parts: list[Part] = []
    shown: list[Block] = []
    for number, name in enumerate(_channels(tones)):
        blocks = tuple(_of_channel(tones, name))
        parts.append(Part(f"channel_{number}", name, blocks))
        shown += blocks
    needed = () if available() else (f"{NEEDED}.",)
    parts.append(Part("method", "Method", (Bullets((*_METHOD, *needed)),)))
    return Analysis(
        "tones",
        about="Tones above the noise of their critical band, the strongest first.",
        parts=tuple(parts),
        shown=(*shown, *map(Text, needed)),
        tables={"tones.csv": _rows(tones)},
        numbers=tuple(_loudness(tones)),
        **origin(tones, "Recording"),
    )


def _rows(tones: xr.Dataset) -> DataTable:
    """Every tone, a row each."""
    rows: list[tuple[str | float, ...]] = []
    for name in _channels(tones):
        values = (tones[variable].sel(channel=name).item() for variable in _LOUDNESS)
        loudness = ["" if math.isnan(value) else value for value in values]
        rows += [(name, *_numbers(tone), _which(tone), *loudness) for tone in tones_of(tones, name)]
    return columns_of(_COLUMNS, rows)


def _loudness(tones: xr.Dataset) -> Iterator[Number]:
    """Loudness and sharpness of every channel where they are available."""
    for name in _channels(tones):
        for variable, unit in _LOUDNESS.items():
            value = tones[variable].sel(channel=name).item()
            if not math.isnan(value):
                text = f"{value:.3g}" if unit == "sone" else f"{value:.2f}"
                yield Number(value, unit, variable, {"channel": name}, text=text)


_LOUDNESS: Final = {"recorded_loudness": "sone", "recorded_sharpness": "acum"}


def _channels(tones: xr.Dataset) -> list[str]:
    return [str(name) for name in tones["channel"].values]


def _of_channel(tones: xr.Dataset, name: str) -> Iterator[Table | Bullets | Text]:
    """Table of the strongest tones of a channel, and its loudness in words."""
    listed = tones_of(tones, name)
    if listed:
        rows = tuple(_tone(tone, name) for tone in listed[:MOST_TONES])
        caption = f"{name}: {len(listed)} listed above the noise of their critical band"
        yield Table(caption, (*TONE_HEAD, *_TIME_HEAD, "prominent"), rows, frozenset({0, 7}))
    else:
        yield Text(f"{name}: no tone stands above the noise of its critical band")
    loudness, sharpness = (tones[variable].sel(channel=name).item() for variable in _LOUDNESS)
    if not math.isnan(loudness):
        yield Bullets((f"loudness {loudness:.3g} sone, sharpness {sharpness:.2f} acum",))


def _tone(tone: Tone, channel: str) -> tuple[Cell, ...]:
    """Row of a tone."""
    name, hertz, level, *ratios = tone_row(tone)
    at = {"channel": channel, "frequency_hz": tone.frequency_hz}
    number = Number(tone.level_db, "dB", "recorded_tone_level", at, text=level)
    times = f"{100.0 * tone.share:.0f}", rounding.fixed(tone.swing_db)
    return (name, hertz, number, *ratios, *times, _which(tone))


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


def _which(tone: Tone) -> str:
    """By which of the two ratios it is prominent."""
    return _PROMINENT.get((tone.prominent_by_noise, tone.prominent_by_bands), "no")
