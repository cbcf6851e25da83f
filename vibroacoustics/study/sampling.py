"""Values from their ranges: Latin hypercubes, and the ranges that other values narrow."""

from collections.abc import Iterator, Mapping, Sequence
from math import exp, log
from typing import Final

import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array
from .uncertainty import Range, Uncertainty

WIDE_RATIO: Final = 3.0
"""A range wider than this is drawn evenly over its logarithm."""

Draw = Mapping[tuple[str, str], float]
"""Drawn values in SI by table, dotted from the machine, and field."""


def latin_hypercubes(ranges: Sequence[Range], settings: Uncertainty) -> Iterator[list[Draw]]:
    """Sets of values drawn from their ranges (McKay, Beckman, Conover 1979), one after another."""
    sampler = scipy.stats.qmc.LatinHypercube(len(ranges), rng=settings.seed)
    while True:
        yield [draw_at(ranges, row) for row in sampler.random(settings.random_samples)]


def draw_at(ranges: Sequence[Range], shares: Array) -> Draw:
    """The draw whose values so large shares of their ranges lie below, shape (range,)."""
    return {
        (limits.table, limits.field): _value(limits, float(share))
        for limits, share in zip(ranges, shares, strict=True)
    }


def _value(limits: Range, share: float) -> float:
    """The value that so large a share of the range lies below."""
    lowest, highest = limits.lowest, limits.highest
    if limits.integer:  # each as often as any other
        return int(min(lowest + share * (highest - lowest + 1.0), highest))
    if _is_wide(limits):
        return float(lowest * (highest / lowest) ** share)
    return float(lowest + share * (highest - lowest))


def narrowed(limits: Range, value: float, least: float, greatest: float) -> float:
    """A drawn value moved into the part of its range between two limits, at the same share of it.

    Evenly spread values stay so. Where nothing of the range is left the value stays.

    Parameters
    ----------
    limits : range that the value was drawn from
    value : in it
    least, greatest : that the value may be
    """
    lowest, highest = max(limits.lowest, least), min(limits.highest, greatest)
    if lowest >= highest or (lowest, highest) == (limits.lowest, limits.highest):
        return value
    if _is_wide(limits):
        share = log(value / limits.lowest) / log(limits.highest / limits.lowest)
        return lowest * exp(share * log(highest / lowest))
    share = (value - limits.lowest) / (limits.highest - limits.lowest)
    return lowest + share * (highest - lowest)


def _is_wide(limits: Range) -> bool:
    return limits.lowest > 0.0 and limits.highest / limits.lowest > WIDE_RATIO
