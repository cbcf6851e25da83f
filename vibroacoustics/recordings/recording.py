"""The labelled form of a recording and what every recording must fulfil."""

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..base import vocabulary
from ..base.arrays import Array
from ..base.errors import ParameterError
from .quantities import Quantity, quantity
from .recorded import MINIMUM_SAMPLES, check_rate


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


def si_scale(
    names: Sequence[str], units: Sequence[str], calibration: Mapping[str, float]
) -> tuple[list[str], list[float]]:
    """SI unit of each channel, and the factor that takes its samples to it.

    Raises
    ------
    ParameterError
        A unit is unknown, a factor zero.
    """
    measured = [_quantity(name, unit) for name, unit in zip(names, units, strict=True)]
    factors = [
        _calibration(name, calibration) * kind.factor
        for name, kind in zip(names, measured, strict=True)
    ]
    return [kind.unit for kind in measured], factors


def scale_in_place(signal: Array, names: Sequence[str], factors: Sequence[float]) -> None:
    """Multiply the samples of each channel, shape (channel, time), by its factor.

    Raises
    ------
    ParameterError
        A sample is not finite.
    """
    for name, factor, samples in zip(names, factors, signal, strict=True):
        with np.errstate(over="ignore"):  # told in the next line
            np.multiply(samples, factor, out=samples)
        check_finite(name, samples)


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


def _quantity(name: str, unit: str) -> Quantity:
    try:
        return quantity(unit)
    except ParameterError as error:
        raise ParameterError(f"channel {name!r}: {error}") from None


def _calibration(name: str, calibration: Mapping[str, float]) -> float:
    factor = float(calibration.get(name, 1.0))
    if factor == 0.0 or not np.isfinite(factor):
        raise ParameterError(f"channel {name!r}: calibration factor {factor:g}: must not be zero")
    return factor


def check_finite(name: str, samples: Array) -> None:
    """Refuse samples of a channel that are not finite.

    Raises
    ------
    ParameterError
        Says how many there are and which is the first.
    """
    wrong = np.flatnonzero(~np.isfinite(samples))
    if wrong.size:
        raise ParameterError(
            f"channel {name!r}: {wrong.size} of {samples.size} samples are not finite, the first "
            f"is sample {wrong[0] + 1} ({samples[wrong[0]]})"
        )
