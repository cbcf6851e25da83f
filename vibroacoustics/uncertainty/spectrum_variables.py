"""Measured third octaves beside the model, before and after they weigh the samples."""

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power
from ..base.quantiles import INTERVAL, weighted_quantiles
from ..base.vocabulary import stamped
from ..levels.by_source import GAIN_BANDS
from ..levels.remainder import in_gain_bands
from ..levels.spectrum_data import SpectrumData
from .evidence import PAIRS, Evidence, with_gain
from .prior_ensemble import PriorEnsemble

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
