"""The labelled form of a recording and what every recording must fulfil."""

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..base import vocabulary
from ..base.arrays import Array
from ..base.errors import ParameterError
from .recorded import MINIMUM_SAMPLES, check_rate
from .scaling import scale_in_place, si_scale


def label_recording(
    signal: ArrayLike,
    sample_rate_hz: float,
    names: Sequence[str],
    units: Sequence[str],
    calibration: Mapping[str, float] | None = None,
) -> xr.Dataset:
    """Label samples as a recording; a simulated signal takes the same form as a measured one.

    Parameters
    ----------
    signal : shape (channel, time), in the channels' units
    sample_rate_hz : actual sample rate
    names : names of the channels, each once
    units : units of the channels, from the list in quantities.py; the samples are taken to SI
    calibration : factor by channel, the channel's unit per unit of its samples; default: 1

    Returns
    -------
    `signal` (channel, time) in SI units, with the coordinates `channel_unit` and
    `calibration_factor` (both factors together) and the attribute `sample_rate_hz`

    Raises
    ------
    ParameterError
        A unit is unknown, a name is there twice, a sample is not finite, a factor is zero, there
        are fewer than two samples.

    Examples
    --------
    >>> recording = va.label_recording([[0.0, 9.81]], 1000.0, ["ring"], ["g"])
    >>> recording["signal"].values.round(2), str(recording["channel_unit"].item())
    (array([[ 0. , 96.2]]), 'm/s²')
    """
    return label_in_place(
        np.array(signal, dtype=float, ndmin=2), sample_rate_hz, names, units, calibration or {}
    )


def label_in_place(
    signal: Array,
    sample_rate_hz: float,
    names: Sequence[str],
    units: Sequence[str],
    calibration: Mapping[str, float],
) -> xr.Dataset:
    """Label samples as a recording in the memory that they are in; see `label_recording`.

    Parameters
    ----------
    signal : shape (channel, time); its values are taken to SI
    sample_rate_hz, names, units, calibration : see `label_recording`
    """
    _check_form(signal, sample_rate_hz, names, units)
    si_units, factors = si_scale(names, units, calibration)
    scale_in_place(signal, names, factors)
    time = np.arange(signal.shape[1], dtype=float)
    time /= sample_rate_hz
    coords = {
        "channel": list(names),
        "time": time,
        "channel_unit": ("channel", si_units),
        "calibration_factor": ("channel", factors),
    }
    recording = xr.Dataset({"signal": vocabulary.stamp("signal", signal, coords)})
    recording.attrs["sample_rate_hz"] = float(sample_rate_hz)
    return vocabulary.label_coordinates(vocabulary.check(recording))


def _check_form(
    signal: Array, sample_rate_hz: float, names: Sequence[str], units: Sequence[str]
) -> None:
    if signal.ndim != 2 or not len(names) == len(units) == len(signal) > 0:
        raise ParameterError(
            f"signal has the shape {signal.shape} for {len(names)} names and {len(units)} units"
        )
    if signal.shape[1] < MINIMUM_SAMPLES:
        raise ParameterError(
            f"has {signal.shape[1]} samples a channel; at least {MINIMUM_SAMPLES} are needed"
        )
    check_rate(sample_rate_hz)
    twice = sorted(name for name, times in Counter(names).items() if times > 1)
    if twice or not all(names):
        raise ParameterError(f"channel names must be unique and not empty: {twice or ['']}")
