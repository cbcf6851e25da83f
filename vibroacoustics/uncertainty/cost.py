"""Cost of samples, from the time that a few take."""

from collections.abc import Sequence
from math import ceil
from typing import Final

import numpy as np
from scipy.special import logsumexp

from ..levels.agreement import effective_samples
from ..levels.nominal import Sound
from ..radiation.cost import Cost
from ..study.study import Study
from .evidence import Evidence
from .prior_ensemble import MOST_ROUNDS, MOST_SAMPLES
from .slider_variables import SETTINGS
from .sliders import MOST_CANDIDATES, MOST_SLIDERS, NODES, TRIED, machine_count

_LEAST_BATCHES: Final = 2
_MOST_BATCHES: Final = 10
"""Batches of the samples that shall be effective, with the studies of the package."""
_LEAST_SHARE: Final = 0.3
"""Share of the wanted samples that go on at least."""


def ensemble_cost(
    evidence: Evidence, sounds: Sequence[Sound], seconds: float, was_cached: bool
) -> Cost:
    """Estimate the cost of the samples at the published level.

    Parameters
    ----------
    evidence : evidence that weighs the samples
    sounds : sounds of a few samples
    seconds : processor time that they took
    was_cached : whether the transfer vectors are computed already
    """
    one_s = seconds / len(sounds)
    low, high = _expected(evidence, sounds, was_cached)
    how = f"{one_s:.2g} s for one of {low} to {high} samples, {len(sounds)} measured"
    return Cost("samples at the published level", low * one_s, high * one_s, how)


def samples_cost(study: Study, count: int, seconds: float) -> Cost:
    """Estimate the cost of all cases of the samples that go on.

    Parameters
    ----------
    study : with all speeds
    count : number of samples that were timed, at one speed
    seconds : processor time that they took
    """
    speeds, wanted = len(study.operation.speed_rpm), study.uncertainty.random_samples
    all_s = speeds * seconds / count
    how = f"{all_s:.2g} s for one of up to {wanted} samples, {count} measured at one speed"
    return Cost("samples of all cases", _LEAST_SHARE * wanted * all_s, wanted * all_s, how)


def sliders_cost(study: Study, count: int, alone_s: float, every_s: float) -> Cost:
    """Estimate the cost of the sliders.

    Parameters
    ----------
    study : with the number of samples
    count : number of samples that were timed, at one speed
    alone_s : processor time that they took without an option
    every_s : processor time that they took with all options
    """
    one_s, all_s = alone_s / count, every_s / count
    machines = machine_count(study.uncertainty.random_samples)
    low = machines + 2 * TRIED * MOST_CANDIDATES
    high = low + (NODES * machines + (NODES - 1) * TRIED) * MOST_SLIDERS
    how = (
        f"{one_s:.2g} s for one of {low} to {high} values without an option and {all_s:.2g} s for "
        f"one of {SETTINGS + machines} settings with all, {count} measured"
    )
    others_s = (SETTINGS + machines) * all_s
    return Cost("sliders", low * one_s + others_s, high * one_s + others_s, how)


def _expected(evidence: Evidence, sounds: Sequence[Sound], was_cached: bool) -> tuple[int, int]:
    """Number of samples until enough are effective, at least and at most.

    With computed transfer vectors, by how well the first few agree: half as many to twice as many.
    """
    wanted = evidence.nominal.study.uncertainty.random_samples
    most = min(MOST_ROUNDS * wanted, MOST_SAMPLES)
    if not was_cached:
        return min(_LEAST_BATCHES * wanted, most), min(_MOST_BATCHES * wanted, most)
    machine = evidence.nominal.study.machine
    published = evidence.published._replace(priors=evidence.published.priors[:1])
    log_weight = np.array(
        [
            logsumexp(evidence.log_weights(sound, machine, n, published))
            for n, sound in enumerate(sounds)
        ]
    )
    weight = np.exp(log_weight - log_weight.max()) if np.isfinite(log_weight).any() else 0.0
    needed = len(sounds) / max(effective_samples(weight * np.ones(len(sounds))), 0.5)
    low, high = (wanted * ceil(factor * needed) for factor in (0.5, 2.0))
    return min(low, most), min(high, most)
