"""Prominent tones of a run, and the tone with the largest excess."""

from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.decibel import NO_TONE_DB
from .estimates import Estimate, estimate

LISTED_FROM: Final = 0.5
"""A tone is listed if its probability of being audible and prominent is larger."""
_ORDER: Final = "order "
"""Begins the names of lines that are shaft orders."""


class ProminentTone(NamedTuple):
    """A tone at a microphone.

    Attributes
    ----------
    name, frequency_hz : name and frequency of its strongest line
    microphone : name
    level_db : level of this line, median, re 20 µPa
    excess_db : over its criterion
    probability : probability that it is audible and prominent
    """

    name: str
    frequency_hz: float
    microphone: str
    level_db: float
    excess_db: Estimate
    probability: float


def listed_tones(
    results: xr.Dataset, option: str, microphone: str, speed: float
) -> list[ProminentTone]:
    """Return the tones that are audible and prominent in more than half of the weighted samples.


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


def _tone(results: xr.Dataset, name: str, case: dict[str, Any]) -> ProminentTone:
    where = {**case, "judged_tone": name}
    return ProminentTone(
        name,
        float(results["judged_tone_frequency"].sel(speed=case["speed"], judged_tone=name)),
        str(case["receiver"]),
        _line_level(results, name, case),
        estimate(results, "tone_excess", **where),
        estimate(results, "tone_probability", **where).value,
    )


def _line_level(results: xr.Dataset, name: str, case: dict[str, Any]) -> float:
    """Level of the strongest line of a tone, dB: of an order as everywhere in the results."""
    order = float(name.removeprefix(_ORDER)) if name.startswith(_ORDER) else np.nan
    if order in results["order"].values:
        return estimate(results, "order_level", order=order, weighting="Z", **case).value
    return estimate(results, "tone_level", judged_tone=name, **case).value
