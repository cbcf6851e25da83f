"""Unit of the samples, which this package writes into the comment of a sound file."""

import math
import re
from collections.abc import Iterable
from typing import Final

_BEFORE, _BEHIND = "vibroacoustics: ", " at full scale"
_ONE: Final = re.compile(r"(?P<factor>[0-9.e+-]+) (?P<unit>\S(?:.*\S)?)")


def scale_comment(scales: Iterable[tuple[float, str]]) -> str:
    """Comment of a file whose samples are in parts of a full scale.

    Parameters
    ----------
    scales : value at full scale and its unit, by channel

    Examples
    --------
    >>> scale_comment([(0.5, "Pa"), (1.0, "m/s²")])
    'vibroacoustics: 0.5 Pa, 1.0 m/s² at full scale'
    """
    words = ", ".join(f"{float(factor)!r} {unit}" for factor, unit in scales)
    return f"{_BEFORE}{words}{_BEHIND}"


def stated_scales(comment: str, channels: int) -> list[tuple[float, str]]:
    """Value at full scale and unit by channel; none where another wrote the comment."""
    if not (comment.startswith(_BEFORE) and comment.endswith(_BEHIND)):
        return []
    parts = comment.removeprefix(_BEFORE).removesuffix(_BEHIND).split(", ")
    scales = [scale for part in parts if (scale := _scale(part)) is not None]
    return scales if len(scales) == len(parts) == channels else []


def _scale(words: str) -> tuple[float, str] | None:
    match = _ONE.fullmatch(words)
    if match is None:
        return None
    try:
        factor = float(match["factor"])
    except ValueError:
        return None
    return (factor, match["unit"]) if 0.0 < factor < math.inf else None
