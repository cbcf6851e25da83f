"""Regimes of sampled values: a study with ranges narrowed to a part in which another law holds."""

from collections.abc import Iterator, Sequence

import numpy as np

from ..base.arrays import Array
from ..base.parameters import Parameters, Regime
from .ranges import owner_of
from .sampling import Sample, density
from .study import Study
from .uncertainty import Range


def regimes_of(study: Study) -> Iterator[tuple[str, Study]]:
    """Yield name and study of each regime that is a part of a sampled range.

    Parameters
    ----------
    study : whose ranges are narrowed, one after another
    """
    for number, limits in enumerate(study.ranges):
        for regime in _declared(study, limits):
            lowest = max(limits.lowest, regime.lowest)
            highest = min(limits.highest, regime.highest)
            if lowest < highest and (lowest, highest) != (limits.lowest, limits.highest):
                ends = {"lowest": lowest, "highest": highest}
                narrowed = (limits.model_copy(update=ends),)
                ranges = (*study.ranges[:number], *narrowed, *study.ranges[number + 1 :])
                yield regime.name, study.model_copy(update={"ranges": ranges})


def density_ratios(
    ranges: Sequence[Range], others: Sequence[Range], samples: Sequence[Sample]
) -> Array:
    """Compute prior densities with other ranges relative to those of samples, shape (sample,).

    Parameters
    ----------
    ranges : that the samples are from
    others : other ranges of the same values
    samples : values by table and field
    """
    ratio = np.ones(len(samples))
    for limits, other in zip(ranges, others, strict=True):
        if limits != other:
            values = [sample[limits.table, limits.field] for sample in samples]
            ratio *= [density(other, value) / density(limits, value) for value in values]
    return ratio


def _declared(study: Study, limits: Range) -> list[Regime]:
    """Regimes that the class of a value declares."""
    owner: Parameters = owner_of(study.machine, filter(None, limits.table.split(".")))
    metadata = type(owner).model_fields[limits.field].metadata
    return [item for item in metadata if isinstance(item, Regime)]
