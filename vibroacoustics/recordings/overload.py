"""Samples at full scale: the recorder may have been overloaded."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from .recorded import Recorded, Samples

PIECE: Final = 2**17
_LEAST_RUN: Final = 3
"""Samples in a row that have the extreme value; a tone has two at most, on either side of its
peak."""
_ALIKE: Final = 1e-7
"""Share of the range within which values are one: a period that is repeated has rounding errors."""
_LEAST_TIMES: Final = 6
"""Samples at the extreme anywhere."""
_LEAST_RATIO: Final = 3.0
"""Samples at the extreme over those at the next value: a tone in coarse steps has up to 2.4."""
_LEAST_BETWEEN: Final = 0.5
"""Share of the samples between the extremes; pulses, switches and constants have fewer."""


class Overload(NamedTuple):
    """Samples of a channel at full scale.

    Attributes
    ----------
    samples : number of them
    first : number of the first, from the begin of what was read
    """

    samples: int
    first: int


def overloads(recording: Recorded) -> list[Overload | None]:
    """Samples at full scale, by channel; None without any.

    Full scale is a limit of the number format, or else an extreme value that comes again and
    again, as where a signal was clipped.
    """
    limits = recording.limits or [None] * len(recording.samples)
    return [
        overload(samples, limit) for samples, limit in zip(recording.samples, limits, strict=True)
    ]


def overload(samples: Samples, limits: tuple[float, float] | None = None) -> Overload | None:
    """Samples of one channel at full scale; None without any.

    Parameters
    ----------
    samples : shape (time,)
    limits : lowest and highest value that the number format can hold; None without
    """
    if not samples.size:
        return None
    low, high = float(np.min(samples)), float(np.max(samples))
    if not low < high:
        return None
    clipped = [end for end in (low, high) if _is_clipped(samples, end, low, high, limits)]
    if not clipped or _share_between(samples, low, high) < _LEAST_BETWEEN:
        return None
    count, first = 0, samples.size
    for start, piece in _pieces(samples):
        at = np.flatnonzero(np.isin(piece, clipped))
        count += at.size
        first = min(first, start + int(at[0])) if at.size else first
    return Overload(count, first)


def _is_clipped(
    samples: Samples, end: float, low: float, high: float, limits: tuple[float, float] | None
) -> bool:
    if limits is not None:
        return (end == low and end <= limits[0]) or (end == high and end >= limits[1])
    if end == 0.0:
        return False  # silence, and signals of one sign
    if sum(int(np.count_nonzero(piece == end)) for _, piece in _pieces(samples)) < _LEAST_RUN:
        return False  # as of nearly all signals; what follows takes longer
    alike = _ALIKE * (high - low)
    count, run, beside, nearest = 0, 0, 0, np.inf
    for _, piece in _pieces(samples):
        away = np.abs(piece - end)
        at = away <= alike
        count += int(np.count_nonzero(at))
        run = max(run, _longest_run(at))
        least = float(np.min(away[~at], initial=np.inf))
        if least < nearest - alike:
            nearest, beside = least, 0
        beside += int(np.count_nonzero(np.abs(away - nearest) <= alike))
    is_repeated = run >= _LEAST_RUN or count >= _LEAST_TIMES
    return is_repeated and count >= _LEAST_RATIO * beside


def _longest_run(at: Samples) -> int:
    edges = np.flatnonzero(np.diff(np.concatenate([[False], at, [False]]).astype(np.int8)))
    return int(np.max(edges[1::2] - edges[::2], initial=0))


def _share_between(samples: Samples, low: float, high: float) -> float:
    between = sum(int(np.count_nonzero((p > low) & (p < high))) for _, p in _pieces(samples))
    return between / samples.size


def _pieces(samples: Samples) -> Iterator[tuple[int, Samples]]:
    """Pieces with their places: what is compared takes little memory."""
    return ((start, samples[start : start + PIECE]) for start in range(0, samples.size, PIECE))
