"""Tables of prominent tones, loudness and sharpness."""

import math
from contextlib import suppress
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.errors import ParameterError
from ..results.estimates import Estimate, estimate, is_sampled
from ..sound.ingredients import ingredients
from ..sound.loudness import Loudness, available, loudness_of
from ..sound.prominence import NO_TONE_DB
from .study import catalogue_receiver, few_speeds, options, speeds
from .tables import Table

LISTED_FROM: Final = 0.5
"""A tone is listed if its probability of being audible and prominent is larger."""
MOST_NAMES: Final = 3
HEAD: Final = ("Option", "Prominent tones", "Tone", "Hz", "dB", "excess, dB")
NOT_PROMINENT: Final = "not prominent"


class ProminentTone(NamedTuple):
    """A tone at a microphone.

    Attributes
    ----------
    name, frequency_hz : of its strongest line
    microphone : name
    level_db : with the weaker lines that belong to it, median, re 20 µPa
    excess_db : over its criterion
    probability : of being audible and prominent
    """

    name: str
    frequency_hz: float
    microphone: str
    level_db: float
    excess_db: Estimate
    probability: float


def has_sound(results: xr.Dataset) -> bool:
    """Return whether results hold what sounds are made of, and their tones."""
    return {"pressure_line", "noise_band_level", "tone_excess"} <= set(results)


def listed_tones(
    results: xr.Dataset, option: str, microphone: str, speed: float
) -> list[ProminentTone]:
    """Return the tones that are audible and prominent in more than half of the weighted samples.

    Parameters
    ----------
    results : of a run
    option, microphone, speed : of its coordinates

    Returns
    -------
    tones, the largest excess first
    """
    case = {"option": option, "receiver": microphone, "speed": speed}
    chance = results["tone_probability"].sel(case).values
    names = results["judged_tone"].values[chance > LISTED_FROM].tolist()
    listed = [_tone(results, name, case) for name in names]
    return sorted(listed, key=lambda tone: -tone.excess_db.value)


def nearest_tone(
    results: xr.Dataset, option: str, microphone: str, speed: float
) -> ProminentTone | None:
    """Return the tone with the largest excess, prominent or not; None without an audible tone."""
    case = {"option": option, "receiver": microphone, "speed": speed}
    excess = results["tone_excess"].sel(case).values
    top = int(np.argmax(excess))
    if excess[top] <= NO_TONE_DB:
        return None
    return _tone(results, str(results["judged_tone"].values[top]), case)


def excess_words(excess_db: Estimate) -> str:
    """Return the ends of the interval of an excess: dB, or that the tone is not prominent."""
    ends = [
        rounding.fixed(end) if end >= 0.0 else NOT_PROMINENT
        for end in (excess_db.low, excess_db.high)
    ]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def tone_tables(results: xr.Dataset) -> list[Table]:
    """Return tones, loudness and sharpness of every option at the published receiver, by speed."""
    name = catalogue_receiver(results)
    return [_table(results, name, speed) for speed in speeds(few_speeds(results))]


def _tone(results: xr.Dataset, name: str, case: dict[str, Any]) -> ProminentTone:
    where = {**case, "judged_tone": name}
    return ProminentTone(
        name,
        float(results["judged_tone_frequency"].sel(speed=case["speed"], judged_tone=name)),
        str(case["receiver"]),
        estimate(results, "tone_level", **where).value,
        estimate(results, "tone_excess", **where),
        estimate(results, "tone_probability", **where).value,
    )


def _table(results: xr.Dataset, microphone: str, speed: float) -> Table:
    parts = [ingredients(results, option, microphone, speed) for option in options(results)]
    loud: list[Loudness | None] = [None] * len(parts)
    if available():
        with suppress(ParameterError):  # louder than the standard goes: without it
            loud = list(loudness_of(parts))
    sampled = is_sampled(results, "tone_excess")
    rows = tuple(
        (
            option,
            _names(listed_tones(results, option, microphone, speed)),
            *_cells(nearest_tone(results, option, microphone, speed), sampled),
            *((_percent(_some_tone(results, option, microphone, speed)),) if sampled else ()),
            *_loudness_cells(loudness),
        )
        for option, loudness in zip(options(results), loud, strict=True)
    )
    of_samples = ("80 % interval, dB", "probability", "some tone") if sampled else ()
    with_loudness = () if None in loud else ("sone", "acum")
    head = (*HEAD, *of_samples, *with_loudness)
    caption = f"Prominent tones, and the tone with the largest excess, {microphone}, {speed:g} rpm"
    return Table(caption, head, rows, frozenset({0, 1, 2}))


def _cells(tone: ProminentTone | None, sampled: bool) -> tuple[str, ...]:
    if tone is None:
        return ("none", *[""] * (5 if sampled else 3))
    cells = (
        tone.name,
        rounding.fixed(tone.frequency_hz),
        rounding.level(tone.level_db),
        rounding.fixed(tone.excess_db.value),
    )
    if not sampled:
        return cells
    return (*cells, excess_words(tone.excess_db), _percent(tone.probability))


def _some_tone(results: xr.Dataset, option: str, microphone: str, speed: float) -> float:
    """Probability that some tone is prominent."""
    case = {"option": option, "receiver": microphone, "speed": speed}
    return estimate(results, "any_tone_probability", **case).value


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"


def _names(listed: list[ProminentTone]) -> str:
    names = [tone.name for tone in listed[:MOST_NAMES]]
    more = len(listed) - len(names)
    return ", ".join(names + ([f"{more} more"] if more else [])) or "none"


def _loudness_cells(loudness: Loudness | None) -> tuple[str, ...]:
    if loudness is None:
        return ()
    sharp = loudness.sharpness_acum
    return (
        rounding.three_digits(loudness.loudness_sone),
        rounding.fixed(sharp, 2) if math.isfinite(sharp) else "",
    )
