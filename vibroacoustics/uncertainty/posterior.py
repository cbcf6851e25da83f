"""Samples of a study's ranges, weighted by data, and how far data are from the model before."""

from collections.abc import Callable, Sequence
from itertools import chain as joined
from typing import Final

import numpy as np
import xarray as xr
from scipy.special import logsumexp, ndtr

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, power_of_level
from ..base.progress import Progress
from ..base.quantiles import INTERVAL, weighted_quantiles
from ..base.vocabulary import stamped
from ..levels.agreement import LEVELS_DB, Datum
from ..levels.by_source import GAIN_BANDS
from ..levels.labelled import level
from ..levels.nominal import Sound
from ..levels.remainder import in_gain_bands
from ..levels.spectrum_data import SpectrumData
from ..study.samples import batches_of_samples, with_sample
from ..study.sampling import Sample
from .evidence import PAIRS, Evidence, with_gain
from .hammer_test import HammerTest
from .prior_ensemble import PriorEnsemble, Weighted, prior_ensemble_of
from .share_variables import level_shares

_LEAST_WEIGHT = 1e-4
"""Relative to the largest one: samples of less weight do not change a quantile."""


def spectrum_variables(
    evidence: Evidence,
    spectrum: SpectrumData,
    ensemble: PriorEnsemble,
    expected: Array,
    weight: Array,
) -> xr.Dataset:
    """Label measured third octaves, and those of the machine before and after the data.

    Parameters
    ----------
    evidence : data that weigh
    spectrum : one of them
    ensemble : weighted samples
    expected : bands before the data, without discrepancy, shape (sample, band), Pa²
    weight : weights of these samples, shape (sample,)
    """
    counting = np.flatnonzero(ensemble.weight[0] > _LEAST_WEIGHT)
    after = np.concatenate(
        [_bands(evidence, spectrum, ensemble, number) for number in counting.tolist()]
    )
    by_pair = np.repeat(ensemble.weight[0][counting], PAIRS)
    labelled = {
        "spectrum_measured": spectrum.level_dba,
        "spectrum_before": _quantiles(expected[:, spectrum.column], weight),
        "spectrum_after": _quantiles(after[:, spectrum.column], by_pair),
    }
    band_hz = [GAIN_BANDS[number].nominal_hz for number in spectrum.column.tolist()]
    return stamped(labelled, {"spectrum_band": band_hz, "datum_quantile": list(INTERVAL)})


def _quantiles(bands: Array, weight: Array) -> Array:
    level = np.asarray(level_of_power(bands / REFERENCE_PRESSURE_PA**2))
    return weighted_quantiles(level, weight, INTERVAL)


def _bands(
    evidence: Evidence, spectrum: SpectrumData, ensemble: PriorEnsemble, number: int
) -> Array:
    """Bands of the pairs of a sample at the point of a spectrum, shape (pair, band), Pa²."""
    sound, machine = ensemble.batch.sounds[number], ensemble.batch.machines[number]
    pairs = evidence.pairs_of(sound, machine, number)
    noise = in_gain_bands(evidence.unmodelled_pa2(pairs, machine))
    modelled = with_gain(evidence.mutual(sound, spectrum), pairs.discrepancy.gain)
    return np.asarray(modelled + evidence.growth(machine, spectrum) * noise)


_MOST: Final = 1000
"""Number of samples of the prior predictive of all data together."""


def conflict_variables(
    data: Sequence[Datum], expected: Array, weight: Array, generator: np.random.Generator
) -> xr.Dataset:
    """Label the data, what is expected of them, and the tails of the prior predictive.

    Parameters
    ----------
    data : published and measured ones
    expected : expected data of each sample with a solution, shape (datum, sample)
    weight : weights of the samples before the data, shape (sample,)
    generator : generator of random numbers
    """
    values, deviations = (
        np.array([getattr(datum, name) for datum in data]) for name in ("value", "deviation")
    )
    share = weight / weight.sum()
    below = ndtr((values[:, None] - expected) / deviations[:, None]) @ share
    labelled = {
        "datum_value": values,
        "datum_deviation": deviations,
        "datum_expected": [weighted_quantiles(row, weight, INTERVAL) for row in expected],
        "datum_tail": np.minimum(below, 1.0 - below),
        "conflict_tail": _tail_of_all(
            expected / deviations[:, None], values / deviations, share, generator
        ),
    }
    names = {"datum": [datum.name for datum in data], "datum_quantile": list(INTERVAL)}
    return stamped(labelled, names)


def _tail_of_all(
    expected: Array, values: Array, share: Array, generator: np.random.Generator
) -> float:
    """Probability that the density of the prior predictive is at most that at the data.

    Parameters
    ----------
    expected : relative to the deviations, shape (datum, sample)
    values : values of the data, relative to the deviations, shape (datum,)
    share : weights that sum to one, shape (sample,)
    generator : generator of random numbers
    """
    picked = generator.choice(share.size, _MOST, p=share)
    predicted = expected[:, picked] + generator.standard_normal((len(expected), _MOST))
    points = np.column_stack([predicted, values])
    square = sum((point[:, None] - row) ** 2 for point, row in zip(points, expected, strict=True))
    density = np.exp(-0.5 * np.asarray(square)) @ share
    return float((density[:-1] <= density[-1]).mean())


def posterior(
    evidence: Evidence,
    sounds_of: Callable[[list[Sample], int, int], list[Sound]],
    test: HammerTest | None,
    progress: Progress,
) -> tuple[PriorEnsemble, xr.Dataset]:
    """Weight as many samples as a study wants to be effective.

    Parameters
    ----------
    evidence : published data and measurements
    sounds_of : sounds of samples at the cases that weigh, given how many came before and how many
        are expected in all
    test : hammer test of the shell, where there is one; samples that do not agree with it are
        rejected
    progress : called with the number of samples that were held against the test

    Returns
    -------
    weighted samples, and their variables with the shares of the values in the level
    """
    study, published = evidence.nominal.study, evidence.published
    wanted, batches, prior_db = study.uncertainty.random_samples, batches_of_samples(study), None
    if test is not None:
        first = next(batches)
        prior_db = evidence.modelled_db(sounds_of(first, 0, 2 * len(first)))
        batches = test.agreeing(joined([first], batches), wanted, progress)

    def weigh(batch: list[Sample], before: int, expected: int) -> Weighted:
        sounds = sounds_of(batch, before, expected)
        machines = [with_sample(study.machine, study.machine, sample) for sample in batch]
        weights = [
            evidence.log_weights(sound, machine, before + n, published)
            for n, (sound, machine) in enumerate(zip(sounds, machines, strict=True))
        ]
        log_weight = np.reshape(
            [logsumexp(weight, axis=(1, 2)) for weight in weights], (len(batch), -1)
        )
        if test is not None:
            log_weight = log_weight + np.log(test.likelihood(before, len(batch)))[:, None]
        return Weighted(sounds, machines, evidence.modelled_db(sounds), log_weight.T)

    ensemble = prior_ensemble_of(batches, weigh, [prior.name for prior in published.priors], wanted)
    count = len(ensemble.samples)
    results = ensemble.labelled(study.ranges, published.level_dba)
    before: Array = np.ones(count)
    if test is not None and prior_db is not None:
        results = results.merge(test.labelled(prior_db + published.level_dba, count))
        before = test.likelihood(0, count)
    results = results.merge(level_shares(study.ranges, ensemble, before))
    return ensemble, results.merge(_beside_data(evidence, ensemble, before))


def _beside_data(evidence: Evidence, ensemble: PriorEnsemble, before: Array) -> xr.Dataset:
    """Conflict of the prior with the data, and shares of the energy; empty without data."""
    published, (sounds, machines, modelled_db, _) = evidence.published, ensemble.batch
    solved = np.flatnonzero(np.isfinite(modelled_db))
    if not published.data or not solved.size:
        return xr.Dataset()
    generator = np.random.default_rng(evidence.nominal.study.uncertainty.seed)
    prior = np.exp(published.priors[0].log_density)
    power = power_of_level(generator.choice(LEVELS_DB, len(sounds), p=prior))

    def expected(spectrum: SpectrumData | None) -> Array:
        rows = [
            evidence.expected(sounds[n], machines[n], power[n], spectrum) for n in solved.tolist()
        ]
        return np.array(rows)

    spectrum, weight = published.spectrum, before[solved]
    data, bands = published.data, expected(None)
    values = [datum.predicted(bands) for datum in data]
    if spectrum is not None:
        bands = expected(spectrum)
        data = (*data, *spectrum.data)
        values += [datum.predicted(bands) for datum in spectrum.data]
    results = conflict_variables(data, np.array(values), weight, generator)
    results = results.merge(_model_alone(evidence, sounds, solved, weight))
    if spectrum is not None and ensemble.suffices:
        results = results.merge(spectrum_variables(evidence, spectrum, ensemble, bands, weight))
    return results


def _model_alone(
    evidence: Evidence, sounds: Sequence[Sound], solved: IndexArray, weight: Array
) -> xr.Dataset:
    """A-weighted level of all modelled sources with discrepancy, before published data.

    Parameters
    ----------
    evidence : published data
    sounds : sounds of all samples
    solved : numbers of those with a solution, shape (solved,)
    weight : weights of these before the data, shape (solved,)
    """
    square = np.array(
        [
            with_gain(evidence.mutual(sounds[n]), evidence.discrepancy(n).gain).sum(axis=1)
            for n in solved.tolist()
        ]
    )
    each = np.repeat(weight, square.shape[1])
    quantiles = weighted_quantiles(level(square.ravel()), each, INTERVAL)
    return stamped({"model_level": quantiles}, {"datum_quantile": list(INTERVAL)})
