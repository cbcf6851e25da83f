"""Random values of an inside, from the ranges of what is not known."""

from collections.abc import Sequence
from typing import Final

import scipy  # loads its subpackages when they are needed

from ..mechanics.rotation import Array
from ..parameters.inside import Doubt, Inside, InsideSettings

WIDE_RATIO: Final = 3.0
"""A range wider than this is drawn evenly over its logarithm."""


def latin_hypercube(settings: InsideSettings) -> list[Inside]:
    """Insides whose uncertain values are drawn from their ranges (McKay, Beckman, Conover 1979)."""
    sampler = scipy.stats.qmc.LatinHypercube(len(settings.doubts), rng=settings.seed)
    return [
        _drawn(settings.inside, settings.doubts, row)
        for row in sampler.random(settings.random_samples)
    ]


def _drawn(inside: Inside, doubts: Sequence[Doubt], shares: Array) -> Inside:
    tables: dict[str, dict[str, float]] = {}
    for doubt, share in zip(doubts, shares, strict=True):
        wide = doubt.lowest > 0.0 and doubt.highest / doubt.lowest > WIDE_RATIO
        value = (
            doubt.lowest * (doubt.highest / doubt.lowest) ** share
            if wide
            else doubt.lowest + share * (doubt.highest - doubt.lowest)
        )
        tables.setdefault(doubt.table, {})[doubt.field] = float(value)
    return inside.model_copy(
        update={
            table: getattr(inside, table).model_copy(update=values)
            for table, values in tables.items()
        }
    )
