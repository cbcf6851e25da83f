"""Ratios of a study's shaft orders with and without an option, at a microphone."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level, level_of_amplitude, level_of_power, power_of_level
from ..base.errors import ParameterError, SchemaError
from ..base.vocabulary import REFERENCE_OPTION
from ..orders.ratio_over_speed import used_speeds
from ..results.estimates import interval, is_sampled

LARGEST_RATIO_DB: Final = 20.0
_SAME_RATIO: Final = 1e-3
"""Distance of a ratio from 1, 0.01 dB or 0.06°, below which an order is not changed."""
_SAME_NOISE_DB: Final = 0.1
_LEAST_PA2: Final = REFERENCE_PRESSURE_PA**2 * 1e-2
"""Noise of a band below -20 dB counts as none."""


@dataclass(frozen=True)
class OrderRatio:
    """Ratio of an order with and without an option, of one sample.

    Attributes
    ----------
    line : name in the study
    order : multiple of the shaft's speed
    ratio : complex, shape (speed,)
    low, high : factors from this ratio's amplitude to the ends of the 80 % interval of all
        samples, shape (speed,); None where the study has no interval
    """

    line: str
    order: float
    ratio: ComplexArray
    low: Array | None = None
    high: Array | None = None


@dataclass(frozen=True)
class OptionRatios:
    """What an option changes at a microphone.

    Attributes
    ----------
    speed_rpm : of the study, rising, shape (speed,)
    orders : that the option changes, and that can be changed
    unchanged : why other lines that the option changes stay, by name
    """

    speed_rpm: Array
    orders: tuple[OrderRatio, ...]
    unchanged: dict[str, str]


def option_ratios(
    results: xr.Dataset, option: str, receiver: str, lowest_rpm: float, highest_rpm: float
) -> OptionRatios:
    """Ratios of complex peaks, summed over all sources, in the sample that the results show.

    Parameters
    ----------
    results : of a run
    option, receiver : names in the results
    lowest_rpm, highest_rpm : of the recording; ratios at other speeds are not judged

    Raises
    ------
    ParameterError
        The results hold no such option or microphone, or lack speeds of the recording.
    SchemaError
        The results hold no sound.
    """
    check_names(results, option, receiver)
    results = results.sortby("speed")
    pressure = results["pressure_line"].sel(receiver=receiver).sum("sound_source")
    before = pressure.sel(option=REFERENCE_OPTION).transpose("line", "speed").values
    after = pressure.sel(option=option).transpose("line", "speed").values
    speeds = results["speed"].values.astype(float)
    used = used_speeds(speeds, lowest_rpm, highest_rpm)
    orders, unchanged = [], {}
    rows = zip(results["line"].values, results["line_order"].values, before, after, strict=True)
    for name, order, old, new in rows:
        if order == 0.0 or np.all(np.abs(new - old)[used] <= _SAME_RATIO * np.abs(old[used])):
            continue
        reason = _reason(float(order), old[used], new[used])
        if reason:
            unchanged[str(name)] = reason
            continue
        ratio = new / np.where(old == 0.0, 1.0, old)
        ends = _interval(results, option, receiver, float(order), np.abs(ratio))
        orders.append(OrderRatio(str(name), float(order), ratio, *ends))
    return OptionRatios(speeds, tuple(orders), unchanged)


def check_names(results: xr.Dataset, option: str, receiver: str) -> None:
    """Refuse an option or a microphone that results do not hold.

    Raises
    ------
    ParameterError
        There is no such option or microphone, or the option is the reference.
    SchemaError
        The results hold no sound.
    """
    if "pressure_line" not in results:
        raise SchemaError("the results hold no sound at microphones: run the study again")
    options = [str(name) for name in results["option"].values if name != REFERENCE_OPTION]
    receivers = [str(name) for name in results["receiver"].values]
    for word, value, labels in (("option", option, options), ("response", receiver, receivers)):
        if value not in labels:
            raise ParameterError(f"{word} = {value}: must be one of {', '.join(labels)}")


def changed_noise_bands(results: xr.Dataset, option: str, receiver: str) -> list[float]:
    """Third octaves, Hz, in which the noise with an option differs by 0.1 dB or more.

    Parameters
    ----------
    results : of a run; without noise, none changes
    option, receiver : names in the results
    """
    if "noise_band_level" not in results:
        return []
    receivers = results.sel(receiver=receiver)
    squares = [
        _square(receivers, name, each)
        for each in (option, REFERENCE_OPTION)
        for name in ("noise_band_level", "unmodelled_band_level")
    ]
    with_option, without = (np.maximum(sum(squares[n : n + 2]), _LEAST_PA2) for n in (0, 2))
    change_db = np.max(np.abs(level_of_power(with_option / without)), axis=0)
    return [float(band) for band in results["noise_band"].values[change_db >= _SAME_NOISE_DB]]


def _square(results: xr.Dataset, name: str, option: str) -> Array:
    """Mean square by speed and third octave, Pa²; of the sample that the lines are of."""
    sampled = f"representative_{name}"
    level = results[sampled if sampled in results else name].sel(option=option)
    return REFERENCE_PRESSURE_PA**2 * power_of_level(level.transpose("speed", "noise_band").values)


def _reason(order: float, before: ComplexArray, after: ComplexArray) -> str:
    """Why a line that the option changes stays as it is; empty where it can be changed."""
    if not order > 0.0:
        return "no shaft order"
    if np.any(before == 0.0):
        return "the study has it with the option only"
    most_db = float(np.max(level_of_amplitude(np.abs(after / before))))
    if most_db > LARGEST_RATIO_DB:
        return f"the ratio reaches {most_db:.0f} dB, above {LARGEST_RATIO_DB:g} dB"
    return ""


def _interval(
    results: xr.Dataset, option: str, receiver: str, order: float, size: Array
) -> tuple[Array | None, Array | None]:
    """Factors to the ends of the interval; of the first order, the one that results hold."""
    if order != 1.0 or not is_sampled(results, "change_1x"):
        return None, None
    ends = interval(results, "change_1x").sel(option=option, receiver=receiver)
    low, high = (amplitude_of_level(ends[end].values) for end in ("low", "high"))
    size = np.where(size > 0.0, size, 1.0)
    return np.minimum(low / size, 1.0), np.maximum(high / size, 1.0)
