"""Level, shares and changes by options with the alternatives to a study, labelled."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_amplitude, level_of_power
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import HIGH, LOW, SUFFIXES, stamped
from ..levels.agreement import effective_samples
from ..levels.energy import UNMODELLED
from ..results.estimates import QUANTILES
from ..study.regimes import density_ratios
from ..study.study import Study
from .alternative_sounds import CHANGES, ComputedSamples, SampleSound, sounds_of_alternatives
from .alternatives import alternatives_of
from .evidence import PAIRS, Evidence
from .prior_ensemble import PriorEnsemble

_LEAST_WEIGHT = 1e-4
"""Relative to the largest one: samples of less weight do not change a quantile."""


def alternative_variables(
    evidence: Evidence, ensemble: PriorEnsemble, before: Array, computed: ComputedSamples
) -> xr.Dataset:
    """Label what the first screen of a report shows, with each alternative.

    Level and shares are those of the prior ensemble at the published point; changes by options are
    those of the samples that were computed in all cases.

    Parameters
    ----------
    evidence : data of the study
    ensemble : samples of the prior
    before : weights of the samples before the published data, shape (sample,)
    computed : samples with all cases
    """
    study, axes = evidence.nominal.study, evidence.nominal.axes
    alternatives = alternatives_of(study)
    if not alternatives:
        return xr.Dataset()
    chosen = np.maximum(ensemble.weight[0], _LEAST_WEIGHT**2)[list(computed.numbers)]
    cases = (len(CHANGES), len(axes.speeds), len(axes.options))
    rows = []
    sounds = sounds_of_alternatives(evidence, ensemble, computed, alternatives)
    for each, of_samples in zip(alternatives, sounds, strict=True):
        ratio = density_ratios(study.ranges, each.study.ranges, ensemble.samples)
        weight = before * ratio * _likelihood(of_samples)
        of_computed = np.array(computed.counts) * weight[list(computed.numbers)] / chosen
        changes = [of_samples[number].changes for number in computed.numbers]
        rows.append(
            _at_published([sound.parts for sound in of_samples], weight, len(axes.sources) + 1)
            | _changes(changes, of_computed, cases, study)
        )
    coords = {
        "alternative": [each.name for each in alternatives],
        "energy_part": [*axes.sources, UNMODELLED],
        "alternative_quantity": list(CHANGES),
        "speed": list(axes.speeds),
        "option": list(axes.options),
    }
    labelled = {f"alternative_{name}": [row[name] for row in rows] for name in rows[0]}
    return stamped(labelled, coords)


def _likelihood(sounds: Sequence[SampleSound]) -> Array:
    """Likelihood of the samples, the largest is 1, shape (sample,)."""
    log_weight = np.array([sound.log_weight for sound in sounds])
    largest = log_weight.max(initial=-np.inf)
    return np.asarray(np.exp(log_weight - (largest if np.isfinite(largest) else 0.0)))


def _at_published(
    parts: Sequence[Array | None], weight: Array, count: int
) -> dict[str, Array | float]:
    """Level and shares of the energy at the published point, by variable.

    Parameters
    ----------
    parts : energy of the parts of each sample, shape (pair, part), Pa²
    weight : weights of the samples, shape (sample,)
    count : number of parts
    """
    energy, by_pair = _rows(parts, weight, (count,))
    total = energy.sum(axis=1)
    share, level = energy / total[:, None], level_of_power(total / REFERENCE_PRESSURE_PA**2)
    values = _ends("level", np.asarray(level), by_pair) | _ends("share", share, by_pair)
    mean = np.average(share, axis=0, weights=by_pair)
    return values | {"share": mean, "effective": effective_samples(weight)}


def _changes(
    changes: Sequence[Array | None], weight: Array, cases: tuple[int, ...], study: Study
) -> dict[str, Array | float]:
    """Changes by options and probabilities that they are measurable, by variable.

    Parameters
    ----------
    changes : changes of each sample, shape (pair, quantity, speed, option), dB
    weight : weights of the samples, shape (sample,)
    cases : numbers of quantities, speeds and options
    study : smallest changes that could be measured
    """
    change, by_pair = _rows(changes, weight, cases)
    least = study.scoring.measurable
    limits = (
        (least.level_db, level_of_amplitude(1.0 + least.force_ratio)),
        (-least.level_db, level_of_amplitude(1.0 - least.force_ratio)),
    )
    grown, fallen = (np.array(limit)[:, None, None] for limit in limits)
    return _ends("change", change, by_pair) | {
        "increase": np.average(change > grown, axis=0, weights=by_pair),
        "decrease": np.average(change < fallen, axis=0, weights=by_pair),
        "change_effective": effective_samples(weight),
    }


def _rows(
    values: Sequence[Array | None], weight: Array, shape: tuple[int, ...]
) -> tuple[Array, Array]:
    """Return values of the pairs that count, and their weights; not a number where none does."""
    counting = [
        (of_sample, share)
        for of_sample, share in zip(values, weight.tolist(), strict=True)
        if of_sample is not None and share > _LEAST_WEIGHT * weight.max()
    ]
    if not counting:
        return np.full((PAIRS, *shape), np.nan), np.ones(PAIRS)
    rows, shares = zip(*counting, strict=True)
    return np.concatenate(rows), np.repeat(shares, PAIRS)


def _ends(name: str, values: Array, weight: Array) -> dict[str, Array | float]:
    """Median and ends of the interval by variable; values of shape (row, ...)."""
    ends = weighted_quantiles(values, weight, (QUANTILES[0], 0.5, QUANTILES[1]))
    suffixes = (SUFFIXES[LOW], "", SUFFIXES[HIGH])
    return {f"{name}{suffix}": row for suffix, row in zip(suffixes, ends, strict=True)}
