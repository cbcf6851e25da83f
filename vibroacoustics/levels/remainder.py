"""Unmodelled noise of the machine by speed and option, and insertion losses of options."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.errors import ParameterError
from ..machine.machine import Machine
from ..machine.option import Option
from ..machine.source import CaseKey
from ..study.study import Study
from .axes import LevelAxes
from .by_source import GAIN_BANDS, SourceSound, gain_band_number
from .declared_level import published_of
from .measured_points import UNMODELLED_BANDS


def airborne_factor(options: Mapping[str, Option], order_frequency: xr.DataArray) -> xr.DataArray:
    """Pressure with each option's insertion loss over that without it, (option, speed, order).

    Parameters
    ----------
    options : by name
    order_frequency : (speed, order), Hz
    """
    losses = [option.insertion_loss() for option in options.values()]
    factor = [
        np.ones(order_frequency.shape)
        if loss is None
        else loss.amplitude_factor(order_frequency.values)
        for loss in losses
    ]
    coords = {"option": list(options), **{n: order_frequency[n] for n in order_frequency.dims}}
    return xr.DataArray(factor, coords, ("option", *order_frequency.dims))


def airborne(options: Mapping[str, Option], results: xr.Dataset) -> xr.Dataset:
    """Return results whose velocities are less by each option's insertion loss."""
    factor = airborne_factor(options, results["order_frequency"])
    return results.assign(velocity_order=factor * results["velocity_order"])


def remaining_factor(options: Mapping[str, Option], frequency_hz: Array) -> Array:
    """Mean square of a sound with each option's insertion loss over that without, (option, band).

    Parameters
    ----------
    options : by name
    frequency_hz : midband frequency, Hz, shape (band,)
    """
    losses = [option.insertion_loss() for option in options.values()]
    factors = [1.0 if loss is None else loss.power_factor(frequency_hz) for loss in losses]
    return np.array([np.ones(len(frequency_hz)) * factor for factor in factors])


UNMODELLED_MIDDLE_HZ: Final[Array] = np.array([band.middle_hz for band in UNMODELLED_BANDS])
"""Middle frequencies of the third octaves of unmodelled noise."""


def unmodelled_square(
    study: Study, axes: LevelAxes, sound: Mapping[CaseKey, SourceSound], may_be_none: bool
) -> float:
    """Mean square that the model leaves of the published level at its microphone and speed, Pa².

    None without a published level.

    Parameters
    ----------
    study : with the published level
    axes : with its receiver
    sound : sound of the case without a balancer at its speed and operating point, and of other
        cases
    may_be_none : whether none is left where the model alone is louder, as in a sample

    Raises
    ------
    ParameterError
        The model alone is louder.
    """
    published = study.machine.overall_noise
    if published is None:
        return 0.0
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    alone = sound[study.catalogue_case].total[0, receiver]
    unmodelled = REFERENCE_PRESSURE_PA**2 * power_of_level(published.likely_level_dba) - alone
    if unmodelled <= 0.0 and not may_be_none:
        level = mean_square_level(alone, REFERENCE_PRESSURE_PA)
        raise ParameterError(
            f"machine: overall_noise.level_dba = {published.level_dba:g} dB(A): the model alone "
            f"gives {level:.1f} dB(A) at {study.catalogue_receiver}"
        )
    return float(max(unmodelled, 0.0))


def remaining(study: Study, axes: LevelAxes, machine: Machine, noise: Array) -> Array:
    """Compute unmodelled noise, A-weighted, shape (speed, option, receiver, band), Pa².

    The bands are `UNMODELLED_BANDS`. It grows with speed, each band passes the insertion loss of an
    option, and it spreads from the machine to the microphones.

    Parameters
    ----------
    study : options and speed of the published level
    axes : speeds, and spreading to the microphones
    machine : growth of the unmodelled noise
    noise : unmodelled noise at the published speed and microphone without an option, (band,), Pa²
    """
    growth = machine.remainder.speed_factor(np.array(axes.speeds), study.catalogue_speed_rpm)
    factor = remaining_factor(study.options, UNMODELLED_MIDDLE_HZ)
    return axes.spread(growth[:, None, None] * factor * noise)


def in_spectrum(machine: Machine, square: float) -> Array:
    """Return unmodelled noise of a mean square in `UNMODELLED_BANDS`, shape (band,), Pa²."""
    return np.asarray(square * machine.remainder.spectrum(UNMODELLED_MIDDLE_HZ))


def unmodelled_bands(study: Study, machine: Machine) -> Array:
    """Unmodelled noise at the published level, A-weighted, in `GAIN_BANDS`, shape (band,), Pa²."""
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(published_of(study).level_dba)
    return in_gain_bands(in_spectrum(machine, square))


def in_gain_bands(remaining: Array) -> Array:
    """Return unmodelled noise in `GAIN_BANDS`, shape (..., band), Pa².

    Parameters
    ----------
    remaining : in `UNMODELLED_BANDS`, shape (..., band), Pa²
    """
    bands = np.zeros((*remaining.shape[:-1], len(GAIN_BANDS)))
    bands[..., gain_band_number(UNMODELLED_MIDDLE_HZ)] = remaining
    return bands


def over_published(
    study: Study, axes: LevelAxes, sounds: Sequence[Mapping[CaseKey, SourceSound]]
) -> Array:
    """Return modelled minus published level, (sample,), dB; not a number without solution.

    Over 0 dB(A) where none is published.
    """
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    square = np.array([sound[study.catalogue_case].total[0, receiver] for sound in sounds])
    level = mean_square_level(np.nan_to_num(square), REFERENCE_PRESSURE_PA)
    return np.where(np.isnan(square), np.nan, level - published_of(study).level_dba)
