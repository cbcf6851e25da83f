"""What a measured baseline leaves to be explained, band by band, in place of the remainder."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..base.vocabulary import REFERENCE_OPTION, check, stamp
from ..machine.source import CaseKey
from ..mechanics.added import third_octave_number
from ..study.baseline import HIGHEST_HZ, LOWEST_HZ, Baseline
from ..study.study import Study
from .axes import LevelAxes
from .bands import bands_between
from .by_source import SourceSound
from .insertion_loss import remaining_share
from .weighting import WEIGHTING

BASELINE_BANDS: Final = bands_between(3, LOWEST_HZ, HIGHEST_HZ)
"""Third octaves that a baseline may have."""


def with_baseline(
    study: Study, axes: LevelAxes, sound: Mapping[CaseKey, SourceSound], remaining: Array
) -> Array:
    """A-weighted mean square beside the model, shape (speed, option, receiver), Pa².

    At microphones with a baseline it is what the model of the machine without an option leaves of
    it, band by band as energy, so that new = measured - modelled (none) + modelled (option); an
    option takes its insertion loss off. Elsewhere it is the remainder.

    Parameters
    ----------
    study : its baseline, and options
    axes : of the levels
    sound : of every case
    remaining : of the remainder, shape (speed, option), Pa²
    """
    left = np.repeat(remaining[:, :, None], len(axes.receivers), axis=2)
    if study.measured is None or study.measured.baseline is None:
        return left
    for column, receiver in enumerate(axes.receivers):
        for row, speed in enumerate(axes.speeds):
            rest = _rest(study.measured.baseline, axes, sound, receiver, speed)
            if rest is None:
                continue
            middle_hz, square = rest
            weighted = np.maximum(square, 0.0) * power_of_level(WEIGHTING["A"](middle_hz))
            total = weighted.sum()
            share = remaining_share(study.options, middle_hz, weighted) if total > 0.0 else 0.0
            left[row, :, column] = total * share
    return left


def baseline_variables(
    study: Study, axes: LevelAxes, sound: Mapping[CaseKey, SourceSound]
) -> xr.Dataset:
    """What the model explains of each band of the baseline; empty where there is none.

    Parameters
    ----------
    study : its baseline
    axes : of the levels
    sound : of every case, the values as given
    """
    if study.measured is None or study.measured.baseline is None:
        return xr.Dataset()
    share = np.full((len(axes.speeds), len(axes.receivers), len(BASELINE_BANDS)), np.nan)
    numbers = {band.middle_hz: number for number, band in enumerate(BASELINE_BANDS)}
    for column, receiver in enumerate(axes.receivers):
        for row, speed in enumerate(axes.speeds):
            rest = _rest(study.measured.baseline, axes, sound, receiver, speed)
            modelled = _modelled(axes, sound, receiver, speed)
            for middle_hz, left in zip(*rest, strict=True) if rest is not None else ():
                known = modelled.get(middle_hz, 0.0)
                share[row, column, numbers[middle_hz]] = known / (left + known)
    coords = {
        "speed": list(axes.speeds),
        "receiver": list(axes.receivers),
        "baseline_band": [band.nominal_hz for band in BASELINE_BANDS],
    }
    return check(xr.Dataset({"baseline_share": stamp("baseline_share", share, coords)}))


def _rest(
    baseline: Baseline,
    axes: LevelAxes,
    sound: Mapping[CaseKey, SourceSound],
    receiver: str,
    speed: float,
) -> tuple[Array, Array] | None:
    """Exact midband frequencies and mean squares of the baseline less the model, Pa²."""
    spectra = baseline.at(receiver)
    if not spectra:
        return None
    numbers = third_octave_number(np.array(spectra[0].band_hz)) - third_octave_number(
        np.array(BASELINE_BANDS[0].middle_hz)
    )
    middle_hz = np.array([BASELINE_BANDS[int(number)].middle_hz for number in numbers])
    modelled = _modelled(axes, sound, receiver, speed)
    known = np.array([modelled.get(middle, 0.0) for middle in middle_hz.tolist()])
    speeds = [one.speed_rpm for one in spectra]
    levels = _over_speed(speed, speeds, np.array([one.level_db for one in spectra]))
    return middle_hz, REFERENCE_PRESSURE_PA**2 * power_of_level(levels) - known


def _over_speed(speed: float, speeds: Sequence[float], levels: Array) -> Array:
    """Levels at a speed, by straight lines between those that were measured."""
    return np.array([np.interp(speed, speeds, of_band) for of_band in levels.T])


def _modelled(
    axes: LevelAxes, sound: Mapping[CaseKey, SourceSound], receiver: str, speed: float
) -> dict[float, float]:
    """Mean square of the machine without an option in each band, by midband frequency, Pa²."""
    column = list(axes.receivers).index(receiver)
    square = sound[(speed, REFERENCE_OPTION)].band[:, column].sum(axis=0)
    middles = (band.middle_hz for band in axes.bands)
    return dict(zip(middles, square.tolist(), strict=True))
