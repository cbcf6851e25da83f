"""Random values of a machine, from the ranges of what is not known."""

from collections.abc import Mapping, Sequence
from typing import Final

import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array
from ..machine.machine import Machine
from ..study.uncertainty import Range, Uncertainty

WIDE_RATIO: Final = 3.0
"""A range wider than this is drawn evenly over its logarithm."""

Draw = Mapping[tuple[str, str], float]
"""Drawn values in SI by table and field."""
AS_GIVEN: Final[Draw] = {}
"""The values of the file."""


def latin_hypercube(ranges: Sequence[Range], settings: Uncertainty) -> list[Draw]:
    """Sets of values drawn from their ranges (McKay, Beckman, Conover 1979); none without any."""
    if not ranges:
        return []
    sampler = scipy.stats.qmc.LatinHypercube(len(ranges), rng=settings.seed)
    return [_draw(ranges, row) for row in sampler.random(settings.random_samples)]


def with_draw(machine: Machine, given: Machine, draw: Draw) -> Machine:
    """A machine with drawn values; what an option has changed of the given one stays changed.

    Parameters
    ----------
    machine : as an option leaves it
    given : of the study
    draw : values by table and field
    """
    tables: dict[str, dict[str, float]] = {}
    for (table, field), value in draw.items():
        if getattr(getattr(machine, table), field) == getattr(getattr(given, table), field):
            tables.setdefault(table, {})[field] = value
    if not tables:
        return machine
    return machine.model_copy(
        update={
            table: getattr(machine, table).model_copy(update=values)
            for table, values in tables.items()
        }
    )


def _draw(ranges: Sequence[Range], shares: Array) -> Draw:
    values = {}
    for limits, share in zip(ranges, shares, strict=True):
        wide = limits.lowest > 0.0 and limits.highest / limits.lowest > WIDE_RATIO
        value = (
            limits.lowest * (limits.highest / limits.lowest) ** share
            if wide
            else limits.lowest + share * (limits.highest - limits.lowest)
        )
        values[limits.table, limits.field] = float(value)
    return values
