"""Levels, changes and forces of all cases with the samples that go on, labelled."""

from collections.abc import Mapping, Sequence

import xarray as xr

from ..base.arrays import Array, IndexArray
from ..levels.labelled import draw_variables
from ..levels.nominal import NominalSound, Sound
from ..levels.remainder import remainder_by_draw, remaining_by_draw
from ..machine.source import CaseKey
from .bank import Bank
from .draws import drawn_values
from .first_order import first_order_by_draw
from .share_variables import change_shares


def sample_variables(
    nominal: NominalSound,
    ensemble: Bank,
    chosen: tuple[IndexArray, Array],
    sounds: Sequence[Sound],
    first_order: Sequence[Mapping[CaseKey, Array]],
    results: xr.Dataset,
) -> xr.Dataset:
    """Label the sound and the forces of the samples that go on.

    Parameters
    ----------
    nominal : sound with the nominal values
    ensemble : all samples
    chosen : of `Bank.chosen`
    sounds : of all cases, by sample that goes on
    first_order : forces at 1x of the cases that move otherwise, by sample that goes on
    results : amplitudes with the nominal values
    """
    study, axes, (index, weight) = nominal.study, nominal.axes, chosen
    samples = ensemble.some(index)
    unmodelled = remainder_by_draw(study, ensemble.modelled_db[index])
    residual = remaining_by_draw(study, axes, sounds, samples, unmodelled[0])
    levels = draw_variables(axes, sounds, residual, unmodelled, weight, ensemble.prior_names)
    levels = levels.merge(first_order_by_draw(first_order, results))
    levels = levels.merge(drawn_values(study.ranges, samples))
    return levels.merge(change_shares(study, levels))
