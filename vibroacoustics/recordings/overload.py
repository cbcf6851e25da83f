"""Samples at full scale: the recorder may have been overloaded."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from .recorded import Recorded, Samples

PIECE: Final = 2**17
_ALIKE: Final = 1e-7
"""Share of the range within which values are equal: a repeated period has rounding errors."""
_FINEST: Final = 1e-5
"""Finest step that is considered, share of the range: tables have few digits."""
_LEAST_RUN: Final = 3
"""Equal samples in a row; a tone has two at most, on either side of its peak, in fine steps."""
_SHARP: Final = 32.0
"""Steps from the extreme to the next value: a peak of three samples within a step has 6.25 at
most."""
_LEAST_RATIO: Final = 3.0
"""Samples at the extreme over those beside it: a tone with a few samples a period has up to 2."""
_CLUSTER: Final = 2.5
"""Steps over which equal samples of a tone may be spread by its drift."""
_FINE: Final = 1e-3
"""Share of the range; in coarser steps a tone of a few samples a period keeps to a few values."""
_LEAST_SIDE: Final = 0.05
"""Share of the range that an extreme is beyond zero: silence is no full scale."""
_MOST_AT_REST: Final = 0.6
"""Share of the samples at one extreme: more are a signal at rest between pulses."""
_NEAR_VALUES: Final = 6
"""Values next to the extreme, by which steps are recognised."""
_PARTS: Final = (1, 2, 3)
"""Steps that may make the smallest difference of these values."""
_UNEVEN: Final = 0.05
"""Unevenness of steps, share of the smallest."""
_MANY_VALUES: Final = 5
"""A channel of fewer, such as an idle one, is overloaded at both extremes or not at all."""


class Overload(NamedTuple):
    """Samples of a channel at full scale.

    Attributes
    ----------
    samples : number of them
    first : number of the first, from the begin of what was read
    between : share of all samples that lie between the lowest and the highest value
    """

    samples: int
    first: int
    between: float


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
    ends = _ends_at(limits, low, high) or _clipped_ends(samples, low, high)
    if not ends:
        return None
    count, between, first = 0, 0, samples.size
    for start, piece in _pieces(samples):
        clipped = np.flatnonzero(np.isin(piece, ends))
        count += clipped.size
        between += int(np.count_nonzero((piece > low) & (piece < high)))
        first = min(first, start + int(clipped[0])) if clipped.size else first
    return Overload(count, first, between / samples.size)


def _ends_at(limits: tuple[float, float] | None, low: float, high: float) -> list[float]:
    """Extreme values that are limits of the number format."""
    if limits is None:
        return []
    return [low] * (low <= limits[0]) + [high] * (high >= limits[1])


def _clipped_ends(samples: Samples, low: float, high: float) -> list[float]:
    """Extreme values that come again and again; those of equal magnitude count together."""
    spread = high - low
    least = _LEAST_SIDE * spread
    ends = [low] * (low <= -least) + [high] * (high >= least)
    is_even = len(ends) == 2 and abs(low + high) <= _ALIKE * spread
    groups = [ends] if is_even else [[end] for end in ends]
    most = samples.size * (1.0 if is_even else _MOST_AT_REST)
    groups = [group for group in groups if _LEAST_RUN <= _times(samples, group) <= most]
    if not groups:
        return []  # as of nearly all signals; what follows takes longer
    start = max(0, (samples.size - PIECE) // 2)
    values = np.unique(samples[start : start + PIECE]).astype(float)
    clipped = [
        end for group in groups if _is_clipped(samples, group, values, spread) for end in group
    ]
    return clipped if values.size >= _MANY_VALUES or len(clipped) == 2 else []


def _times(samples: Samples, ends: list[float]) -> int:
    return sum(int(np.count_nonzero(np.isin(piece, ends))) for _, piece in _pieces(samples))


def _is_clipped(samples: Samples, ends: list[float], values: Samples, spread: float) -> bool:
    """Whether a signal was clipped at these extremes.

    Beside them are samples as far from the next value as a tone moves off its zero while its
    peak moves by a step.
    """
    step = max(_step(_away(values, ends), _ALIKE * spread), _FINEST * spread)
    count, run, nearest, alike = 0, 0, np.inf, _ALIKE * spread
    for _, piece in _pieces(samples):
        away = _away(piece, ends)
        count += int(np.count_nonzero(away <= alike))
        run = max(run, *(_longest_run(np.abs(piece - end) <= alike) for end in ends))
        others = away[away > min(_CLUSTER * step, _FINE * spread)]
        nearest = min(nearest, float(np.min(others, initial=np.inf)))
    beside = sum(
        int(np.count_nonzero((away > alike) & (away <= nearest + np.sqrt(step * spread))))
        for away in (_away(piece, ends) for _, piece in _pieces(samples))
    )
    is_run, is_sharp = run >= _LEAST_RUN, nearest > _SHARP * step
    has_many = values.size >= _MANY_VALUES
    ratio = _LEAST_RATIO * (1 if has_many else len(ends))
    is_frequent = 0 < ratio * beside <= count
    is_plain = has_many and (is_sharp or step < _FINE * spread)
    return (is_run and is_sharp) or (is_frequent and (is_run or is_plain))


def _away(samples: Samples, ends: list[float]) -> Samples:
    """Distance from the nearest of the extremes."""
    return np.asarray(np.min([np.abs(samples - end) for end in ends], axis=0))


def _step(away: Samples, alike: float) -> float:
    """Step of which the distances next to the extremes are multiples; 0 without."""
    near = np.sort(away)
    steps = np.diff(near[np.diff(near, prepend=-np.inf) > alike][:_NEAR_VALUES])
    if not steps.size:
        return 0.0
    for parts in _PARTS if steps.size == _NEAR_VALUES - 1 else _PARTS[:1]:
        multiples = steps * parts / steps.min()
        if np.max(np.abs(multiples - np.round(multiples))) < _UNEVEN:
            return float(steps.min() / parts)
    return 0.0


def _longest_run(is_clipped: Samples) -> int:
    edges = np.flatnonzero(np.diff(np.concatenate([[False], is_clipped, [False]]).astype(np.int8)))
    return int(np.max(edges[1::2] - edges[::2], initial=0))


def _pieces(samples: Samples) -> Iterator[tuple[int, Samples]]:
    """Pieces with their places: what is compared takes little memory."""
    return ((start, samples[start : start + PIECE]) for start in range(0, samples.size, PIECE))
