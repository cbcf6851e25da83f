"""Shares of the sources and of unmodelled noise in the energy at the published point."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from scipy.special import logsumexp

from ..base.arrays import Array
from ..base.decibel import power_of_level
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import stamped
from ..levels.agreement import Datum, effective_samples
from ..levels.nominal import Sound
from ..machine.machine import Machine
from .conflict import QUANTILES
from .evidence import PAIRS, Evidence, with_gain

UNMODELLED: Final = "unmodelled"
_HALF: Final = 0.5
_LEAST_WEIGHT: Final = 1e-4
"""Relative to the largest one: samples of less weight do not change a share."""


def energy_shares(
    evidence: Evidence, sounds: Sequence[Sound], machines: Sequence[Machine], before: Array
) -> xr.Dataset:
    """Label the shares with all published data, and with the level alone.

    Parameters
    ----------
    evidence : published data
    sounds, machines : of the samples
    before : weights of the samples before the data, shape (sample,)
    """
    data = evidence.published.data
    subsets = {"all data": data, "level alone": data[:1]} if len(data) > 1 else {"all data": data}
    by_subset = [
        _of_data(evidence, sounds, machines, before, subset) for subset in subsets.values()
    ]
    share, majority, effective = zip(*by_subset, strict=True)
    values = {
        "energy_share": share, "energy_majority": majority, "evidence_effective": effective,
    }  # fmt: skip
    coords = {
        "evidence": list(subsets),
        "energy_part": [*evidence.nominal.axes.sources, UNMODELLED],
        "datum_quantile": list(QUANTILES),
    }
    return stamped(values, coords)


def _of_data(
    evidence: Evidence,
    sounds: Sequence[Sound],
    machines: Sequence[Machine],
    before: Array,
    data: Sequence[Datum],
) -> tuple[Array, Array, float]:
    """Quantiles of the shares (part, quantile), probabilities of a majority, effective samples."""
    first = evidence.published.priors[:1]
    of_pairs = [
        evidence.log_weights(*sample, number, data, first)
        for number, sample in enumerate(zip(sounds, machines, strict=True))
    ]
    log_weight = [logsumexp(each) for each in of_pairs]
    weight = before * np.exp(np.array(log_weight) - max(log_weight))
    counting = np.flatnonzero(weight > _LEAST_WEIGHT * weight.max())
    shares = [
        _shares(evidence, sounds[number], machines[number], of_pairs[number], number)
        for number in counting.tolist()
    ]
    share, by_pair = np.concatenate(shares), np.repeat(weight[counting], PAIRS)
    ends = weighted_quantiles(share, by_pair, QUANTILES).T
    majority = np.average(share > _HALF, axis=0, weights=by_pair)
    return ends, majority, effective_samples(weight)


def _shares(
    evidence: Evidence, sound: Sound, machine: Machine, log_weights: Array, number: int
) -> Array:
    """Shares of each source and of unmodelled noise, shape (pair, part)."""
    pairs, mutual = evidence.pairs(log_weights, number), evidence.mutual(sound)
    gain = evidence.discrepancy(number).gain[pairs.discrepancy]
    alone = np.einsum("ksi,ssi->ks", gain, mutual)
    rest = evidence.unmodelled(machine).sum() * power_of_level(pairs.unmodelled_db)
    total = with_gain(mutual, gain).sum(axis=1) + rest
    return np.asarray(np.column_stack([alone, rest]) / total[:, None])
