"""Baselines from `orders.nc` of a recording, and from its map over speed and frequency."""

from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError, StorageError
from ...base.registry import register
from ...base.units import shaft_frequency_hz
from ...orders.recorded import operating_points
from ...results.storage import open_results
from ...study.baseline_files import BaselineContent, BaselineFile, BaselineReader
from ..narrow_spectra import NarrowSpectrum, of_spectra
from ..recorded_rows import band_row, of_each_speed, order_row

SPEED_STEP_RPM: Final = 100.0
"""Step of the operating points of a map, as `orders` has them."""
_WINDOW: Final = "hann"
"""Window of every analysis of this package."""


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
        return _of_orders(of_each_speed(results), channels)
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
        channel = None if named is None else named.channel
        if channel is not None and units.get(channel) != "Pa":
            raise ParameterError(
                f"{file.path}: channel {channel}: is no channel in Pa; there are "
                f"{', '.join(f'{name} [{unit}]' for name, unit in units.items())}"
            )
        candidates = [channel] if channel is not None else [receiver, f"pressure {receiver}"]
        in_pascal = [name for name in candidates if units.get(name) == "Pa"]
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
    apart = {(row["microphone"], row["speed_rpm"]): row for row in content.orders}
    measured = [
        order_row(results, channel, key, apart.get(key))
        for receiver, channel in channels.items()
        for key in product([receiver], results["speed"].values.tolist())
    ]
    of_key = {(row["microphone"], row["speed_rpm"]): row for row in measured}
    bands = []
    for row in content.third_octaves:
        key = (row["microphone"], row["speed_rpm"])
        levels = results["band_level"].sel(channel=channels[key[0]], weighting="Z")
        steady = levels if results.sizes["speed"] == 1 else None
        bands.append(band_row(row, of_key[key], apart.get(key), steady))
    return BaselineContent(bands, measured)


def _spectra(results: xr.Dataset, channels: dict[str, str]) -> list[NarrowSpectrum]:
    """Spectra of the blocks of a map, or the mean at a steady speed; none of a run-up without a
    map."""
    if "map_order" not in results:  # mean of several recordings
        return []
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


register(BaselineReader("recorded", (".nc",), read))
