"""Prominent tones, loudness and sharpness of every option."""

import math
from itertools import product
from typing import Any, Final

import xarray as xr

from ...base import rounding
from ...base.constants import LOWEST_AUDIBLE_TONE_HZ, LOWEST_PROMINENT_TONE_HZ
from ...base.decibel import SILENCE_DB
from ...base.registry import register
from ...base.units import shaft_frequency_hz
from ...results.estimates import Estimate, estimate, is_sampled
from ...results.prominent_tones import ProminentTone, listed_tones, nearest_tone
from ...results.stored_study import catalogue_receiver, nearest_speed, options, speeds
from ..blocks import Block, Text
from ..shown_speeds import few_speeds
from ..tables import DataTable, Table, columns_of
from . import Section, hold, text

MOST_NAMES: Final = 3
HEAD: Final = ("Option", "Prominent", "Tone", "Hz", "dB", "excess, dB")
AUDIBILITY: Final = "decisive_audibility"
AUDIBILITY_HEAD: Final = ("audibility, dB", "K_T, dB")
NOT_PROMINENT: Final = "not prominent"
NOT_RATED: Final = "not rated: no noise is modelled"
NO_LOUDNESS: Final = (
    "The results have no loudness: they are of a version that computed it with mosqito only. Run "
    "the study again."
)


def excess_words(excess_db: Estimate) -> str:
    """Return the ends of the interval of an excess: dB, or that the tone is not prominent."""
    ends = (excess_db.low, excess_db.high)
    words = [rounding.fixed(end) if end >= 0.0 else NOT_PROMINENT for end in ends]
    return " to ".join(dict.fromkeys(words))


def tone_table(results: xr.Dataset) -> Table:
    """Return tones, loudness and sharpness of every option at microphone and published speed."""
    microphone, speed = catalogue_receiver(results), nearest_speed(results)
    loud = _loudness(results, microphone, speed)
    sampled = is_sampled(results, "tone_excess")
    rows = []
    for option in options(results):
        case = {"option": option, "receiver": microphone, "speed": speed}
        cells = [_names(listed_tones(results, option, microphone, speed))]
        cells += _cells(nearest_tone(results, option, microphone, speed), sampled)
        if sampled:
            cells.append(_percent(estimate(results, "any_tone_probability", **case).value))
        cells += _audibility(results, case)
        if not has_noise(results, case):
            cells = [NOT_RATED, *[""] * (len(cells) - 1)]
        rows.append((option, *cells, *loud.get(option, ())))
    of_samples = ("probability", "some tone") if sampled else ()
    headings = AUDIBILITY_HEAD if AUDIBILITY in results else ()
    with_loudness = ("sone", "acum") if loud else ()
    head = (*HEAD, *of_samples, *headings, *with_loudness)
    caption = f"Prominent tones, and the tone with the largest excess, {microphone}, {speed:g} rpm"
    return Table(caption, head, tuple(rows), frozenset({0, 1, 2}))


def tone_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return the tone with the largest excess, and the loudness, by option, speed, microphone."""
    rows: list[tuple[str | float, ...]] = []
    chosen = few_speeds(results)
    cases = product(options(results), speeds(chosen), map(str, results["receiver"].values))
    for option, speed, microphone in cases:
        tone = nearest_tone(results, option, microphone, speed)
        case = {"option": option, "speed": speed, "receiver": microphone}
        values = [
            float(results[name].sel(case)) if name in results else ""
            for name in (
                "any_tone_probability",
                AUDIBILITY,
                "tonal_adjustment",
                "loudness",
                "sharpness",
            )
        ]
        cells: tuple[str | float, ...] = ("",) * 7
        if not has_noise(results, case):
            values[:3] = ("", "", "")
        elif tone is not None:
            excess, share = tone.excess_db, tone.probability
            cells = (tone.name, tone.frequency_hz, tone.level_db, *excess, share)
        rows.append((option, speed, microphone, *cells, *values))
    head = ("option", "speed_rpm", "receiver", "tone", "frequency_hz", "level_db",
            "excess_10_percent_db", "excess_db", "excess_90_percent_db", "probability",
            "some_tone_probability", "audibility_db", "tonal_adjustment_db", "loudness_sone",
            "sharpness_acum")  # fmt: skip
    return {"tones.csv": columns_of(head, rows)}


def has_noise(results: xr.Dataset, case: dict[str, Any]) -> bool:
    """Whether there is any noise beside the lines, by which a tone can be rated."""
    levels = [
        float(results[name].sel(case).max())
        for name in ("noise_band_level", "unmodelled_band_level")
        if name in results
    ]
    return not levels or max(levels) > SILENCE_DB


def _audibility(results: xr.Dataset, case: dict[str, Any]) -> tuple[str, ...]:
    """Audibility and adjustment, with their intervals where they are sampled."""
    if AUDIBILITY not in results:
        return ()
    texts = []
    for variable, write in ((AUDIBILITY, rounding.fixed), ("tonal_adjustment", "{:g}".format)):
        low, value, high = map(write, estimate(results, variable, **case))
        texts.append(value if low == high else f"{value} ({low} to {high})")
    return tuple(texts)


def _cells(tone: ProminentTone | None, sampled: bool) -> tuple[str, ...]:
    if tone is None:
        return ("none", *[""] * (4 if sampled else 3))
    excess = rounding.fixed(tone.excess_db.value)
    cells = tone.name, rounding.fixed(tone.frequency_hz), rounding.level(tone.level_db)
    if not sampled:
        return (*cells, excess)
    return (*cells, f"{excess} ({excess_words(tone.excess_db)})", _percent(tone.probability))


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"


def _names(listed: list[ProminentTone]) -> str:
    names = [tone.name for tone in listed[:MOST_NAMES]]
    more = len(listed) - len(names)
    return ", ".join(names + ([f"{more} more"] if more else [])) or "none"


def _loudness(results: xr.Dataset, microphone: str, speed: float) -> dict[str, tuple[str, str]]:
    """Loudness and sharpness by option; empty where some loudness is not in the results."""
    if "loudness" not in results:
        return {}
    here = results[["loudness", "sharpness"]].sel(receiver=microphone, speed=speed)
    if here["loudness"].isnull().any():
        return {}
    loud = map(rounding.three_digits, here["loudness"].values.tolist())
    sharp = [rounding.fixed(s, 2) if math.isfinite(s) else "" for s in here["sharpness"].values]
    return dict(zip(options(results), zip(loud, sharp, strict=True), strict=True))


_HOW = (
    "A tone is listed if it is audible and prominent (ECMA-418-1){samples}. The excess is the "
    "larger one over the criteria of tone-to-noise and prominence ratio. The noise is that of the "
    "sources and the unmodelled noise. Audibility: level of the most audible tone over its masked "
    "threshold (ISO/PAS 20065); K_T: adjustment for it, ISO 1996-2, table J.1. {loudness} Other "
    "speeds and microphones are in tones.csv."
)
_LOUDNESS = "Loudness: ISO 532-1 (sone); sharpness: DIN 45692 (acum)."


def _blocks(results: xr.Dataset) -> list[Block]:
    samples = " in more than half of the samples" if is_sampled(results, "tone_excess") else ""
    loudness = _LOUDNESS if "loudness" in results else NO_LOUDNESS
    how = Text(_HOW.format(samples=samples, loudness=loudness), "note")
    return [tone_table(results), *text(orders_below_range(nearest_speed(results))), how]


def orders_below_range(speed_rpm: float) -> str:
    """Say which orders of a shaft are below the range of both methods; empty where none is."""
    highest = math.ceil(LOWEST_AUDIBLE_TONE_HZ / shaft_frequency_hz(speed_rpm)) - 1
    if not highest:
        return ""
    orders = "1× is" if highest == 1 else f"1× to {highest}× are"
    return (
        f"At {speed_rpm:g} rpm {orders} not rated: tones below {LOWEST_PROMINENT_TONE_HZ:g} Hz "
        f"(ECMA-418-1) or {LOWEST_AUDIBLE_TONE_HZ:g} Hz (audibility) are outside of the methods."
    )


_applies = hold("pressure_line", "noise_band_level", "tone_excess")
register(Section("tones", "Tones and loudness", _blocks, _applies, 38.0, tables=tone_data))
