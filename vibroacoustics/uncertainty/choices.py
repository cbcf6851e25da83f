"""Value of a measurement of each unknown before an option is chosen, labelled."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from ..base.vocabulary import REFERENCE_OPTION, stamped
from ..study.study import Study
from .shares import Information, information_of

SOUND: Final = "sound"
SOUND_AND_FOOT_FORCE: Final = "sound and foot force"
_LEAST_RATIO: Final = 0.01
"""Least ratio of a foot force to that without a balancer; smaller ones are worth no more."""


def choice_information(study: Study, levels: xr.Dataset, pairs: int) -> xr.Dataset:
    """Value of knowing each sampled value for the choice among options that somebody would build.

    The utility is −(change of the total at the microphone of the published level), dB, or that
    less 20 lg of the ratio of the largest foot forces at 1×; at the speed where it is worst.

    Parameters
    ----------
    study : options and published level
    levels : variables of `sample_level_variables`, `first_order_by_sample` and `sampled_values`
    pairs : number of successive pairs of each sample
    """
    names = [name for name in levels["option"].values.tolist() if study.options[name].to_be_built]
    weight = levels["sample_weight"].values[0]
    if len(names) < 2 or not weight.any():
        return xr.Dataset()
    loss = _losses(levels.sel(receiver=study.catalogue_receiver))
    utility = -np.nan_to_num(loss.sel(option=names).max("speed").values)
    values = levels["sampled_value"].values[::pairs]
    information = [
        _choice_information(values, choice_utility, weight, pairs) for choice_utility in utility
    ]
    expected_utility = weight @ utility
    perfect_information = utility.max(axis=2) @ weight - expected_utility.max(axis=1)
    return stamped(
        {
            "choice_utility": expected_utility,
            "perfect_information": perfect_information,
            "parameter_information": [choice.gain for choice in information],
            "parameter_information_votes": [choice.votes for choice in information],
            "parameter_information_floor": [choice.floor for choice in information],
        },
        {
            "choice": loss["choice"].values.tolist(),
            "choice_option": names,
            "uncertain_parameter": levels["uncertain_parameter"].values.tolist(),
        },
    )


def _losses(levels: xr.Dataset) -> xr.DataArray:
    """Loss of an option by each choice, dB, dims choice, sample, option, speed."""
    axes = ("sample", "option", "speed")
    total = levels["level_total_by_sample"].transpose(*axes)
    force = levels["foot_force_1x_by_sample"].transpose(*axes)
    change = total - total.sel(option=REFERENCE_OPTION)
    ratio = (force / force.sel(option=REFERENCE_OPTION)).clip(min=_LEAST_RATIO)
    sound_and_force = change + level_of_amplitude(ratio)
    choices = xr.Variable("choice", [SOUND, SOUND_AND_FOOT_FORCE])
    return xr.concat([change, sound_and_force], choices)


def _choice_information(values: Array, utility: Array, weight: Array, pairs: int) -> Information:
    """Information for a choice; pairs of a sample have its values and their mean utility.

    Parameters
    ----------
    values : shape (sample, unknown)
    utility : shape (sample and pair, option)
    weight : shape (sample and pair,)
    """
    pair_weight = weight.reshape(-1, pairs)
    sample_weight = pair_weight.sum(axis=1)
    weighted_utility = np.einsum("sp,spo->so", pair_weight, utility.reshape(*pair_weight.shape, -1))
    divisor = np.where(sample_weight > 0.0, sample_weight, 1.0)[:, None]
    return information_of(values, weighted_utility / divisor, sample_weight)
