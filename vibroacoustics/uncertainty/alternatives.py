"""Level and shares of the energy with less evidence or another prior, at the published point."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from scipy.special import logsumexp

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import stamped
from ..levels.agreement import effective_samples
from ..levels.energy import UNMODELLED
from ..levels.nominal import Sound
from ..levels.published import Published
from ..machine.machine import Machine
from ..results.estimates import QUANTILES
from .evidence import PAIRS, Evidence

LEVEL_ALONE: Final = "level alone"
OTHER_PRIOR: Final = "other prior"
WITHOUT_SPECTRUM: Final = "without the spectrum"
_LEAST_WEIGHT: Final = 1e-4
"""Relative to the largest one: samples of less weight do not change a share."""


class _Alternative(NamedTuple):
    """Data and one prior of the unmodelled noise."""

    name: str
    published: Published


class _Statistics(NamedTuple):
    """Statistics with an alternative.

    Attributes
    ----------
    share : low end, mean and high end of the shares of the energy, shape (3, part)
    level : low end, median and high end of the level of the machine, shape (3,), dB(A)
    effective : number of samples
    """

    share: Array
    level: Array
    effective: float


def alternative_variables(
    evidence: Evidence, sounds: Sequence[Sound], machines: Sequence[Machine], before: Array
) -> xr.Dataset:
    """Label level and shares with the published level alone and with the second prior.

    Parameters
    ----------
    evidence : published data and priors
    sounds, machines : of the samples
    before : weights of the samples before the data, shape (sample,)
    """
    alternatives = _alternatives(evidence)
    if not alternatives:
        return xr.Dataset()
    statistics_of = [
        _statistics(evidence, sounds, machines, before, alternative) for alternative in alternatives
    ]
    rows = {"_10_percent": 0, "": 1, "_90_percent": 2}
    values = {
        f"alternative_{name}{suffix}": [
            getattr(statistics, name)[row] for statistics in statistics_of
        ]
        for name in ("share", "level")
        for suffix, row in rows.items()
    }
    coords = {
        "alternative": [alternative.name for alternative in alternatives],
        "energy_part": [*evidence.nominal.axes.sources, UNMODELLED],
    }
    return stamped(
        {**values, "alternative_effective": [statistics.effective for statistics in statistics_of]},
        coords,
    )


def _alternatives(evidence: Evidence) -> list[_Alternative]:
    """Alternatives to all data with the first prior that the study has."""
    every, (first, *others) = evidence.published, evidence.published.priors
    without = every._replace(spectrum=None, priors=(first,))
    alone = without._replace(data=every.data[:1])
    chosen: list[tuple[str, Published]] = []
    if len(every.data) > 1 or every.spectrum is not None:
        chosen.append((LEVEL_ALONE, alone))
    if len(every.data) > 1 and every.spectrum is not None:
        chosen.append((WITHOUT_SPECTRUM, without))
    chosen += [(OTHER_PRIOR, every._replace(priors=(prior,))) for prior in others]
    return [_Alternative(*each) for each in chosen]


def _statistics(
    evidence: Evidence,
    sounds: Sequence[Sound],
    machines: Sequence[Machine],
    before: Array,
    alternative: _Alternative,
) -> _Statistics:
    of_pairs = [
        evidence.log_weights(*sample, number, alternative.published)
        for number, sample in enumerate(zip(sounds, machines, strict=True))
    ]
    log_weight = [logsumexp(each) for each in of_pairs]
    weight: Array = before * np.exp(np.array(log_weight) - max(log_weight))
    counting = np.flatnonzero(weight > _LEAST_WEIGHT * weight.max())
    parts = np.concatenate(
        [
            _parts(evidence, sounds[number], machines[number], of_pairs[number], number)
            for number in counting.tolist()
        ]
    )
    by_pair = np.repeat(weight[counting], PAIRS)
    total = parts.sum(axis=1)
    share = parts / total[:, None]
    low, high = weighted_quantiles(share, by_pair, QUANTILES)
    level = np.asarray(level_of_power(total / REFERENCE_PRESSURE_PA**2))
    ends = weighted_quantiles(level, by_pair, (QUANTILES[0], 0.5, QUANTILES[1]))
    mean = np.average(share, axis=0, weights=by_pair)
    return _Statistics(np.stack([low, mean, high]), ends, effective_samples(weight))


def _parts(
    evidence: Evidence, sound: Sound, machine: Machine, log_weights: Array, number: int
) -> Array:
    """Energy of sources, with half of their interference, and unmodelled noise, (pair, part)."""
    pairs, mutual = evidence.pairs(log_weights, number), evidence.mutual(sound)
    root = np.sqrt(pairs.discrepancy.gain)
    of_sources = np.einsum("ksi,kti,sti->ks", root, root, mutual)
    noise = evidence.unmodelled_pa2(pairs, machine).sum(axis=1)
    return np.asarray(np.column_stack([of_sources, noise]))
