"""Values from their ranges: Latin hypercubes, and the ranges that other values narrow."""

from collections.abc import Iterator, Mapping, Sequence
from math import exp, log
from typing import Final

import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array
from .uncertainty import Range, Uncertainty

WIDE_RATIO: Final = 3.0
"""A range wider than this is sampled evenly over its logarithm."""

Sample = Mapping[tuple[str, str], float]
"""Sampled values in SI by table, dotted from the machine, and field."""


def latin_hypercubes(ranges: Sequence[Range], settings: Uncertainty) -> Iterator[list[Sample]]:
    """Samples of values from their ranges (McKay, Beckman, Conover 1979), one set after another."""
    sampler = scipy.stats.qmc.LatinHypercube(len(ranges), rng=settings.seed)
    while True:
        yield [sample_at(ranges, row) for row in sampler.random(settings.random_samples)]


def sample_at(ranges: Sequence[Range], shares: Array) -> Sample:
    """The sample whose values so large shares of their ranges lie below, shape (range,)."""
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


def density(limits: Range, value: float) -> float:
    """Compute the probability density of a value that is sampled from a range; 0 outside.

    For a whole number it is the probability.
    """
    lowest, highest = limits.lowest, limits.highest
    if not lowest <= value <= highest:
        return 0.0
    if limits.integer:
        return 1.0 / (highest - lowest + 1.0)
    if _is_wide(limits):
        return 1.0 / (value * log(highest / lowest))
    return 1.0 / (highest - lowest)


def narrowed(limits: Range, value: float, least: float, greatest: float) -> float:
    """A sampled value moved into the part of its range between two limits, at the same share of it.

    Evenly spread values stay so. Where nothing of the range is left the value stays.

    Parameters
    ----------
    limits : range that the value was sampled from
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
