"""Baselines from `orders.nc` of a recording, and from its map over speed and frequency."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_power, mean_square_level, power_of_level
from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ...base.units import shaft_frequency_hz
from ...base.vocabulary import NO_ANGLE_ZERO
from ...orders.recorded import operating_points
from ...results.storage import open_results
from ...study.baseline_files import BaselineContent, BaselineFile, BaselineReader
from ..narrow_spectra import BANDS, NarrowSpectrum, of_spectra

LEAST_COHERENCE: Final = 0.8
"""Of an order whose phase counts; noise in five independent blocks reaches it once in 600 times."""
SPEED_STEP_RPM: Final = 100.0
"""Of the operating points of a map, as `orders` has them."""
_WINDOW: Final = "hann"
"""Of every analysis of this package."""


def read(file: BaselineFile) -> BaselineContent:
    """Orders with phase where it held, and third octaves without them.

    Third octaves come from the order map of each block, at a steady speed also from the mean
    spectrum and, above the orders that were analysed, from the levels of the recording.

    Raises
    ------
    ParameterError
        The file is no such result, or no channel is a microphone of the study in Pa.
    """
    try:
        results = open_results(file.path)
    except StorageError as error:
        raise ParameterError(*error.args) from None
    if "channel_order" not in results and "speed_frequency_map" not in results:
        raise ParameterError(f"{file.path}: holds no orders of a recording and no map over speed")
    channels = _channels(file, results)
    try:
        if "speed_frequency_map" in results:
            return of_spectra(_of_map(results, channels), _WINDOW)
        return _of_orders(results, channels)
    except ParameterError as error:
        raise ParameterError(f"{file.path}: {error}") from None


def _channels(file: BaselineFile, results: xr.Dataset) -> dict[str, str]:
    """Channel of each microphone, in Pa."""
    units = dict(
        zip(
            results["channel"].values.tolist(), results["channel_unit"].values.tolist(), strict=True
        )
    )
    channels: dict[str, str] = {}
    for receiver in file.receivers:
        named = file.settings.microphones.get(receiver)
        asked = None if named is None else named.channel
        if asked is not None and units.get(asked) != "Pa":
            raise ParameterError(
                f"{file.path}: channel {asked}: is no channel in Pa; there are "
                f"{', '.join(f'{name} [{unit}]' for name, unit in units.items())}"
            )
        known = [asked] if asked is not None else [receiver, f"pressure {receiver}"]
        in_pascal = [name for name in known if units.get(name) == "Pa"]
        if in_pascal:
            channels[receiver] = in_pascal[0]
    if not channels:
        raise ParameterError(
            f"{file.path}: no channel in Pa is called as a receiver: name it, as in "
            f'measured.baseline.microphones.{file.receivers[0]} = {{ channel = "…" }}; there are '
            f"{', '.join(f'{name} [{unit}]' for name, unit in units.items())}"
        )
    return channels


def _of_map(results: xr.Dataset, channels: dict[str, str]) -> list[NarrowSpectrum]:
    """Spectra of all blocks at the operating points of a map over speed and frequency."""
    block_speed = results["block_speed"].values
    speeds, point = operating_points(block_speed, SPEED_STEP_RPM)
    frequency = results["map_frequency"].values
    return [
        NarrowSpectrum(receiver, float(speeds[p]), frequency, _square(block), float(speed))
        for receiver, channel in channels.items()
        for block, speed, p in zip(
            results["speed_frequency_map"].sel(channel=channel).transpose("block", ...).values,
            block_speed,
            point,
            strict=True,
        )
    ]


def _square(peak: ComplexArray) -> Array:
    return np.asarray(0.5 * np.abs(peak) ** 2)


def _of_orders(results: xr.Dataset, channels: dict[str, str]) -> BaselineContent:
    orders = [float(order) for order in results["order"].values if order > 0.0]
    spectra = _spectra(results, channels)
    content = of_spectra(spectra, _WINDOW, orders) if spectra else BaselineContent()
    tones = {(one["microphone"], one["speed_rpm"]): one for one in content.orders}
    measured = []
    for receiver, channel in channels.items():
        for speed in results["speed"].values.tolist():
            one = results.sel(channel=channel, speed=speed, order=orders)
            square = _tones(orders, tones.get((receiver, speed)))
            measured.append(
                {"microphone": receiver, "speed_rpm": speed, "order": tuple(orders)}
                | _levels_and_phases(one, square, str(results.attrs.get("angle_zero")))
            )
    bands = content.third_octaves
    if results.sizes["speed"] == 1 and "band_level" in results:
        bands = [_with_levels(one, results, channels, measured) for one in bands]
    return BaselineContent(bands, measured)


def _spectra(results: xr.Dataset, channels: dict[str, str]) -> list[NarrowSpectrum]:
    """Of the blocks of a map, or the mean at a steady speed; none of a run-up without a map."""
    speeds, order = results["speed"].values, results["map_order"].values
    if "order_map" in results:
        block_speed = results["block_speed"].values
        point = np.abs(block_speed[:, None] - speeds).argmin(axis=1)
        maps = results["order_map"].transpose("channel", "block", ...)
        return [
            NarrowSpectrum(
                receiver,
                float(speeds[p]),
                order * shaft_frequency_hz(float(block_speed[block])),
                _square(maps.sel(channel=channel).values[block]),
                float(block_speed[block]),
            )
            for receiver, channel in channels.items()
            for block, p in enumerate(point)
        ]
    if speeds.size > 1:
        return []
    frequency = order * shaft_frequency_hz(float(speeds[0]))
    mean = results["mean_order_spectrum"]
    return [
        NarrowSpectrum(receiver, float(speeds[0]), frequency, mean.sel(channel=channel).values ** 2)
        for receiver, channel in channels.items()
    ]


def _tones(orders: Sequence[float], tones: dict[str, Any] | None) -> Array:
    """Mean square of each order above the noise beside it, Pa²; not a number where unknown."""
    known = {} if tones is None else dict(zip(tones["order"], tones["level_db"], strict=True))
    level = np.array([known.get(order, np.nan) for order in orders])
    return np.asarray(REFERENCE_PRESSURE_PA**2 * power_of_level(level))


def _levels_and_phases(one: xr.Dataset, tone_square: Array, angle_zero: str) -> dict[str, Any]:
    """Of the coherent mean where the phase held, else of the power above the noise."""
    peak = one["channel_order"].values
    held = (one["channel_order_coherence"].values >= LEAST_COHERENCE) & (
        angle_zero != NO_ANGLE_ZERO
    )
    power = np.where(np.isnan(tone_square), one["channel_order_rms"].values ** 2, tone_square)
    level = mean_square_level(np.where(held, _square(peak), power), REFERENCE_PRESSURE_PA)
    phase = np.angle(peak).tolist()
    return {
        "level_db": tuple(level.tolist()),
        "phase_rad": tuple(
            value if known else None for value, known in zip(phase, held.tolist(), strict=True)
        ),
    }


def _with_levels(
    row: dict[str, Any],
    results: xr.Dataset,
    channels: dict[str, str],
    measured: Sequence[dict[str, Any]],
) -> dict[str, Any]:
    """Third octaves with those above the highest analysed order, less the orders in them."""
    levels = results["band_level"].sel(channel=channels[row["microphone"]], weighting="Z")
    highest = max(row["band_hz"])
    (orders,) = (one for one in measured if one["microphone"] == row["microphone"])
    hertz = np.array(orders["order"]) * shaft_frequency_hz(row["speed_rpm"])
    tone = power_of_level(np.array(orders["level_db"]))
    names, values = list(row["band_hz"]), list(row["level_db"])
    for band in BANDS:
        if band.nominal_hz <= highest or band.nominal_hz not in levels["band"].values:
            continue
        within = tone[(hertz >= band.lower_hz) & (hertz < band.upper_hz)].sum()
        left = max(float(power_of_level(levels.sel(band=band.nominal_hz).item())) - within, 0.0)
        names.append(band.nominal_hz)
        values.append(float(level_of_power(left)))
    return row | {"band_hz": tuple(names), "level_db": tuple(values)}


register(BaselineReader("recorded", (".nc",), read))
