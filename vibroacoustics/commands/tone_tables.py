"""Analysis of tones, loudness and sharpness of recorded sound."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.constants import LOWEST_AUDIBLE_TONE_HZ, LOWEST_PROMINENT_TONE_HZ
from ..measured.recorded_tones import tones_of
from ..report.analysis import Analysis, origin
from ..report.blocks import Block, Bullets, Part, Text
from ..report.tables import Cell, DataTable, Table, columns_of
from ..results.claim_kinds import ADJUSTMENT, LOUDNESS, SHARPNESS
from ..results.conditional import ClaimKind, claim_of, claims_of, named, stated
from ..results.number import VALUE, Number
from ..sound.audibility import NO_TONE_AUDIBILITY_DB
from ..sound.critical_bands import noise_criterion_db, prominence_criterion_db
from ..sound.tonality import Tone

MOST_TONES: Final = 20
TONE_CLAIMS: Final = tuple(
    kind.name.replace(" ", "_") for kind in (LOUDNESS, SHARPNESS, ADJUSTMENT)
)
TONE_HEAD: Final = ("Tone", "Hz", "dB", "over noise, dB", "over bands, dB")
_TIME_HEAD: Final = ("time, %", "swing, dB")
_PROMINENT: Final = {(True, True): "both", (True, False): "noise", (False, True): "bands"}
_COLUMNS: Final = (
    "channel", "frequency_hz", "level_db", "tone_to_noise_db", "tone_to_noise_criterion_db",
    "prominence_db", "prominence_criterion_db", "share_of_time", "swing_db", "prominent",
    "loudness_sone", "sharpness_acum", *TONE_CLAIMS,
)  # fmt: skip
_METHOD: Final = (
    "Tone-to-noise ratio and prominence ratio: ECMA-418-1, the criterion in brackets.",
    "A tone is prominent by one of the two ratios if it is audible and reaches its criterion.",
    "Audibility: ISO/PAS 20065 in spectra of 3 s, its interval holds 90 %; adjustment: "
    "ISO 1996-2:2017, table J.1.",
)
_BELOW_RANGE: Final = (
    f"Not rated: tones below {LOWEST_PROMINENT_TONE_HZ:g} Hz (ECMA-418-1) and "
    f"{LOWEST_AUDIBLE_TONE_HZ:g} Hz (audibility). That is 1× of a shaft below "
    f"{60.0 * LOWEST_AUDIBLE_TONE_HZ:.0f} rpm, 2× below "
    f"{30.0 * LOWEST_AUDIBLE_TONE_HZ:.0f} rpm."
)


def analysis_of_tones(tones: xr.Dataset) -> Analysis:
    """Return tones of every channel with loudness and sharpness."""
    parts: list[Part] = []
    shown: list[Block] = []
    for number, name in enumerate(_channels(tones)):
        blocks = tuple(_of_channel(tones, name))
        parts.append(Part(f"channel_{number}", name, blocks))
        shown += blocks
    parts.append(Part("method", "Method", (Bullets((_BELOW_RANGE, *_METHOD)),)))
    return Analysis(
        "tones",
        about="Tones above the noise of their critical band, the strongest first.",
        parts=tuple(parts),
        shown=(*shown, Text(_BELOW_RANGE)),
        tables={"tones.csv": _rows(tones), "audibility.csv": _over_time(tones)},
        numbers=tuple(_numbers_of(tones)),
        claims=claims_of(tones),
        **origin(tones, "Recording"),
    )


def _rows(tones: xr.Dataset) -> DataTable:
    """Every tone, a row each."""
    rows: list[tuple[str | float, ...]] = []
    for name in _channels(tones):
        values = (tones[variable].sel(channel=name).item() for variable in _LOUDNESS)
        loudness = ["" if math.isnan(value) else value for value in values]
        claims = [stated(claim) for claim in claims_of(tones) if claim.subject == name]
        rows += [
            (name, *_numbers(tone), _which(tone), *loudness, *claims)
            for tone in tones_of(tones, name)
        ]
    return columns_of(_COLUMNS, rows)


def _over_time(tones: xr.Dataset) -> DataTable:
    """Most audible tone of every spectrum of 3 s."""
    rows: list[tuple[str | float, ...]] = []
    for name in _channels(tones):
        here = tones.sel(channel=name)
        columns = (here[f"recorded_decisive_{of}"].values for of in ("audibility", "frequency"))
        for number, (audibility_db, hertz) in enumerate(zip(*columns, strict=True), start=1):
            rows.append((name, number, audibility_db, "" if math.isnan(hertz) else hertz))
    return columns_of(("channel", "spectrum", "audibility_db", "frequency_hz"), rows)


def _numbers_of(tones: xr.Dataset) -> Iterator[Number]:
    """Loudness and sharpness of every channel where they are available, audibility, adjustment."""
    for name in _channels(tones):
        for variable, unit in (_LOUDNESS | dict.fromkeys(_RATED, "dB")).items():
            value = tones[variable].sel(channel=name).item()
            if math.isnan(value):
                continue
            text, statistic = rounding.fixed(value), VALUE
            if variable in _CLAIMS:
                claim = claim_of(tones, _CLAIMS[variable].name, name)
                text, statistic = claim.short, claim.bound or VALUE
            yield Number(value, unit, variable, {"channel": name}, statistic, text=text)


_RATED: Final = (
    "recorded_audibility", "recorded_audibility_uncertainty", "recorded_tonal_adjustment",
)  # fmt: skip
_LOUDNESS: Final = {"recorded_loudness": "sone", "recorded_sharpness": "acum"}
_CLAIMS: Final[dict[str, ClaimKind]] = {
    "recorded_loudness": LOUDNESS, "recorded_sharpness": SHARPNESS,
    "recorded_tonal_adjustment": ADJUSTMENT,
}  # fmt: skip
"""Kind of the claim that a variable is the value of."""


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
        yield Text(f"{name}: no tone exceeds the noise of its critical band")
    loud = (named(claim_of(tones, kind.name, name)) for kind in (LOUDNESS, SHARPNESS))
    yield Bullets((_audibility(tones, name), ", ".join(loud)))


def _audibility(tones: xr.Dataset, name: str) -> str:
    """Mean audibility of the tones of a channel and the adjustment for them."""
    here = tones.sel(channel=name)
    spectra_db = here["recorded_decisive_audibility"].values
    adjustment = named(claim_of(tones, ADJUSTMENT.name, name))
    if not np.any(spectra_db > NO_TONE_AUDIBILITY_DB):
        return f"no audible tone in {spectra_db.size} spectra of 3 s: {adjustment}"
    hertz = here["recorded_decisive_frequency"].values[int(np.argmax(spectra_db))]
    mean_db, uncertainty_db = (here[name].item() for name in _RATED[:2])
    return (
        f"mean audibility {rounding.level(mean_db)} ± {rounding.level(uncertainty_db)} dB in "
        f"{spectra_db.size} spectra of 3 s, most audible {rounding.fixed(hertz)} Hz: {adjustment}"
    )


def _tone(tone: Tone, channel: str) -> tuple[Cell, ...]:
    """Row of a tone."""
    name, hertz, level, *ratios = tone_row(tone)
    coordinates = {"channel": channel, "frequency_hz": tone.frequency_hz}
    number = Number(tone.level_db, "dB", "recorded_tone_level", coordinates, text=level)
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
    """Name the ratio by which it is prominent."""
    return _PROMINENT.get((tone.prominent_by_noise, tone.prominent_by_bands), "no")
