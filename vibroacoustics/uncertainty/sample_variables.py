"""Levels, changes and forces of all cases with the samples that go on, labelled."""

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..levels.labelled import sample_level_variables
from ..levels.nominal import NominalSound, Sound
from ..levels.remainder import remaining_by_sample
from ..machine.source import CaseKey
from .bank import Bank
from .choices import choice_information
from .every_sample import sampled_values
from .evidence import PAIRS, Evidence
from .first_order import first_order_by_sample


def sample_variables(
    nominal: NominalSound,
    evidence: Evidence,
    ensemble: Bank,
    chosen: tuple[IndexArray, IndexArray],
    sounds: Sequence[Sound],
    first_order: Sequence[Mapping[CaseKey, Array]],
    results: xr.Dataset,
) -> xr.Dataset:
    """Label the sound and the forces of the samples that go on, each with `PAIRS` pairs.

    Parameters
    ----------
    nominal : sound with the nominal values
    evidence : what weighs the samples
    ensemble : all samples
    chosen : of `Bank.chosen`
    sounds : of all cases, by sample that goes on
    first_order : forces at 1x of the cases that move otherwise, by sample that goes on
    results : amplitudes with the nominal values
    """
    study, axes, published = nominal.study, nominal.axes, evidence.published
    samples = [ensemble.samples[number] for number in chosen[0].tolist()]
    of_sample = first_order_by_sample(first_order, results)
    of_sample = of_sample.merge(sampled_values(study.ranges, samples))
    pair_sounds, machines, levels_db, weights = [], [], [], []
    for number, count, sound in zip(*map(list, chosen), sounds, strict=True):
        machine = ensemble.batch.machines[number]
        at_evidence = ensemble.batch.sounds[number], machine
        of_pairs = evidence.log_weights(*at_evidence, number, published.data, published.priors)
        pairs = evidence.pairs(of_pairs, number)
        pair_sounds += evidence.discrepancy(number).some(pairs.discrepancy).sounds(sound)
        machines += [machine] * PAIRS
        levels_db.append(pairs.unmodelled_db)
        weights.append(count * pairs.weight)
    weight = np.concatenate(weights, axis=1)
    weight = weight / weight.sum(axis=1, keepdims=True)
    level_db = published.level_dba + np.concatenate(levels_db)
    rest = REFERENCE_PRESSURE_PA**2 * power_of_level(level_db) * bool(published.data)
    residual = remaining_by_sample(study, axes, pair_sounds, machines, rest)
    levels = sample_level_variables(axes, pair_sounds, residual, rest, weight, ensemble.prior_names)
    repeated = of_sample.isel(sample=np.repeat(np.arange(len(samples)), PAIRS))
    levels = levels.merge(repeated.assign_coords(sample=levels["sample"]))
    return levels.merge(choice_information(study, levels, PAIRS))
