"""What the report says of tones, loudness and sharpness."""

import math
from contextlib import suppress

import xarray as xr

from ..base import rounding
from ..base.errors import ParameterError
from ..sound.critical_bands import noise_criterion_db, prominence_criterion_db
from ..sound.ingredients import Ingredients, ingredients
from ..sound.loudness import Loudness, available, loudness_of
from ..sound.of_results import most_prominent
from ..sound.tonality import Tone, prominent, tonal_spectrum, tones
from .study import catalogue_receiver, few_speeds, options, speeds
from .tables import Table

MOST_NAMES = 3
TONE_HEAD = ("Tone", "Hz", "dB", "over noise, dB", "over bands, dB")


def has_sound(results: xr.Dataset) -> bool:
    """Whether results hold what sounds are made of."""
    return {"pressure_line", "noise_band_level"} <= set(results)


def tone_tables(results: xr.Dataset) -> list[Table]:
    """Tones, loudness and sharpness of every option at the catalogue's microphone, by speed."""
    name = catalogue_receiver(results)
    return [_table(results, name, speed) for speed in speeds(few_speeds(results))]


def _table(results: xr.Dataset, microphone: str, speed: float) -> Table:
    parts = [ingredients(results, option, microphone, speed) for option in options(results)]
    loud: list[Loudness | None] = [None] * len(parts)
    if available():
        with suppress(ParameterError):  # louder than the standard goes: without it
            loud = list(loudness_of(parts))
    rows = tuple(
        (option, *_tone_cells(part), *_loudness_cells(one))
        for option, part, one in zip(options(results), parts, loud, strict=True)
    )
    with_loudness = () if None in loud else ("sone", "acum")
    head = ("Option", "Prominent tones", *TONE_HEAD, *with_loudness)
    caption = f"Prominent tones, and the one that stands out most, at {microphone}, {speed:g} rpm"
    return Table(caption, head, rows, frozenset({0, 1, 2}))


def _tone_cells(parts: Ingredients) -> tuple[str, ...]:
    judged = tones(tonal_spectrum(parts))
    nearest = most_prominent(judged)
    if nearest is None:
        return ("none", "none", "", "", "", "")
    return (_names(prominent(judged)), *tone_row(nearest))


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


def _names(judged: list[Tone]) -> str:
    names = [tone.name for tone in judged[:MOST_NAMES]]
    more = len(judged) - len(names)
    return ", ".join(names + ([f"{more} more"] if more else [])) or "none"


def _loudness_cells(loudness: Loudness | None) -> tuple[str, ...]:
    if loudness is None:
        return ()
    sharp = loudness.sharpness_acum
    return (
        rounding.three_digits(loudness.loudness_sone),
        rounding.fixed(sharp, 2) if math.isfinite(sharp) else "",
    )
