"""Ratios of a study's shaft orders with and without an option, in a response of the study."""

from dataclasses import dataclass
from itertools import combinations
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level, level_of_amplitude, level_of_power, power_of_level
from ..base.errors import ParameterError, SchemaError
from ..base.vocabulary import REFERENCE_OPTION
from ..orders.ratio_over_speed import interpolation_error, largest_gap, used_speeds
from ..results.estimates import interval, is_sampled
from ..results.order_comparison import NEGLIGIBLE, channel_orders, channel_units

LARGEST_RATIO_DB: Final = 20.0
_LARGEST_ERROR: Final = 1.0
"""Relative error of interpolation, 6 dB, above which an order is not changed."""
_TOO_FAR: Final = "the study's speeds are too far apart to interpolate its ratio"
PRESSURE_UNIT: Final = "Pa"
"""Unit of the responses at microphones."""
_SAME_RATIO: Final = 1e-3
"""Distance of a ratio from 1, 0.01 dB or 0.06°, below which an order is not changed."""
_SAME_ORDER: Final = 1e-6
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
        samples, and the error of interpolation, shape (speed,); None where one is unknown
    error : largest relative error of interpolation, not a number where it is unknown
    """

    line: str
    order: float
    ratio: ComplexArray
    low: Array | None = None
    high: Array | None = None
    error: float = 0.0


@dataclass(frozen=True)
class OptionRatios:
    """Ratios of responses with an option to those without it.

    Attributes
    ----------
    speed_rpm : speed of the study, rising, shape (speed,)
    gap : largest distance of neighbouring speeds that are used, over the lower one
    orders : that the option changes, and that can be changed
    unchanged : why other lines that the option changes stay, by name
    """

    speed_rpm: Array
    gap: float
    orders: tuple[OrderRatio, ...]
    unchanged: dict[str, str]


def option_ratios(
    results: xr.Dataset, option: str, response: str, lowest_rpm: float, highest_rpm: float
) -> OptionRatios:
    """Ratios of complex peaks, summed over all sources, in the sample that the results show.

    Parameters
    ----------
    results : results of a run
    option : name in the results
    response : microphone, or channel of the study as `channel_orders` names it
    lowest_rpm, highest_rpm : lowest and highest speed of the study's shaft in the recording; ratios
        at other speeds are not judged
    """
    check_names(results, option, response)
    results = results.sortby("speed")
    before, after = (_peaks(results, name, response) for name in (REFERENCE_OPTION, option))
    largest = max(float(np.max(np.abs(peaks[peaks["line_order"] != 0.0].values), initial=0.0))
                  for peaks in (before, after))  # fmt: skip
    before, after = (peaks.where(abs(peaks) > NEGLIGIBLE * largest, 0.0)
                     for peaks in (before, after))  # fmt: skip
    speeds = results["speed"].values.astype(float)
    used = used_speeds(speeds, lowest_rpm, highest_rpm)
    orders, unchanged = [], {}
    rows = zip(before["line"].values, before["line_order"].values, before.values, after.values,
               strict=True)  # fmt: skip
    for name, order, old, new in rows:
        if order == 0.0 or np.all(np.abs(new - old)[used] <= _SAME_RATIO * np.abs(old[used])):
            continue
        studied = used[(old[used] != 0.0) | (new[used] != 0.0)]  # others are above its frequencies
        reason = _reason(float(order), old[studied], new[studied])
        ratio = new / np.where(old == 0.0, 1.0, old)
        error = 0.0 if reason else interpolation_error(speeds[studied], ratio[None, studied])[0]
        if reason or error > _LARGEST_ERROR:
            unchanged[str(name)] = reason or _TOO_FAR
            continue
        ratio = ratio[_nearest(speeds, studied)]
        ends = _interval(results, option, response, float(order), np.abs(ratio), error)
        orders.append(OrderRatio(str(name), float(order), ratio, *ends, error))
    _check_apart(orders)
    return OptionRatios(speeds, largest_gap(speeds[used]), tuple(orders), unchanged)


def _peaks(results: xr.Dataset, option: str, response: str) -> xr.DataArray:
    """Complex peaks of all sources together, (line, speed), with the coordinate `line_order`."""
    if response in results["receiver"].values:
        at_option = results["pressure_line"].sel(receiver=response, option=option)
        return at_option.sum("sound_source").transpose("line", "speed")
    orders = channel_orders(results, option).sel(channel=response).rename(order="line")
    names = [f"order {order:g}" for order in orders["line"].values]
    labelled = orders.assign_coords(line=names, line_order=("line", orders["line"].values))
    return labelled.transpose("line", "speed")


def _check_apart(orders: list[OrderRatio]) -> None:
    """Refuse lines of two shafts at one order, which a recording cannot separate."""
    for first, second in combinations(orders, 2):
        if abs(first.order - second.order) <= _SAME_ORDER * first.order:
            raise ParameterError(
                f"results: lines {first.line!r} and {second.line!r} are both at order "
                f"{first.order:g} of the shaft: a recording cannot separate them"
            )


def response_units(results: xr.Dataset) -> dict[str, str]:
    """Unit of each response of a study by its name: microphones, and channels of `channel_orders`.

    Raises
    ------
    SchemaError
        The results hold no sound.
    """
    if "pressure_line" not in results:
        raise SchemaError("the results hold no sound at microphones: run the study again")
    microphones = dict.fromkeys(map(str, results["receiver"].values), PRESSURE_UNIT)
    if "force_order" not in results:
        return microphones
    return {**microphones, **channel_units(channel_orders(results))}


def check_names(results: xr.Dataset, option: str, response: str) -> None:
    """Refuse an option or a response that results do not hold.

    Raises
    ------
    ParameterError
        There is no such option or response, or the option is the reference.
    SchemaError
        The results hold no sound.
    """
    responses = list(response_units(results))
    options = [str(name) for name in results["option"].values if name != REFERENCE_OPTION]
    for word, value, labels in (("option", option, options), ("response", response, responses)):
        if value not in labels:
            raise ParameterError(f"{word} = {value}: must be one of {', '.join(labels)}")


def changed_noise_bands(results: xr.Dataset, option: str, response: str) -> list[float]:
    """Third octaves, Hz, in which the noise with an option differs by 0.1 dB or more.

    Results hold noise at microphones alone. Another response is judged by all of them.

    Parameters
    ----------
    results : results of a run; without noise, none changes
    option, response : names in the results
    """
    if "noise_band_level" not in results:
        return []
    every = results["receiver"].values
    microphones = results.sel(receiver=[response] if response in every else every)
    squares = [
        _square(microphones, name, each)
        for each in (option, REFERENCE_OPTION)
        for name in ("noise_band_level", "unmodelled_band_level")
    ]
    with_option, without = (np.maximum(sum(squares[n : n + 2]), _LEAST_PA2) for n in (0, 2))
    change_db = np.max(np.abs(level_of_power(with_option / without)), axis=(0, 1))
    return [float(band) for band in results["noise_band"].values[change_db >= _SAME_NOISE_DB]]


def _square(results: xr.Dataset, name: str, option: str) -> Array:
    """Mean square (receiver, speed, third octave), Pa²; of the sample that the lines are of."""
    sampled = f"representative_{name}"
    level = results[sampled if sampled in results else name].sel(option=option)
    dims = [dim for dim in ("receiver", "speed", "noise_band") if dim in level.dims]
    square = REFERENCE_PRESSURE_PA**2 * power_of_level(level.transpose(*dims).values)
    return square if "receiver" in dims else square[None]


def _nearest(speed_rpm: Array, studied: IndexArray) -> IndexArray:
    """Number of the nearest of some speeds for each speed."""
    distance = np.abs(speed_rpm[:, None] - speed_rpm[studied])
    return np.asarray(studied[np.argmin(distance, axis=1)])


def _reason(order: float, before: ComplexArray, after: ComplexArray) -> str:
    """Say why a line that the option changes stays as it is; empty where it can be changed."""
    if not order > 0.0:
        return "no shaft order"
    if np.any(before == 0.0):
        return "the study has it with the option only"
    most_db = float(np.max(level_of_amplitude(np.abs(after / before))))
    if most_db > LARGEST_RATIO_DB:
        return f"the ratio exceeds {LARGEST_RATIO_DB:g} dB"
    return ""


def _interval(
    results: xr.Dataset, option: str, response: str, order: float, size: Array, error: float
) -> tuple[Array | None, Array | None]:
    """Factors to the ends of the interval of an order, of all samples at a microphone."""
    if not is_sampled(results, "order_change") or response not in results["receiver"].values:
        return None, None
    if np.isnan(error):
        return None, None
    if order not in results["order"].values:
        return None, None
    ends = interval(results, "order_change").sel(option=option, receiver=response, order=order)
    low, high = (amplitude_of_level(ends[end].values) for end in ("low", "high"))
    size = np.where(size > 0.0, size, 1.0)
    wider = 1.0 + error
    return np.minimum(low / size, 1.0) / wider, np.maximum(high / size, 1.0) * wider
