"""Figures of a recording over speed: spectra, levels, tracked orders."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .map_levels import map_level
from .needs import chosen, needs
from .style import Picture, draw, legend_below, line_looks, numbered_file_name, png, shortened

_MAP_RANGE_DB: Final = 60.0
_STEADY_RATIO: Final = 0.02
"""A speed that stays within this share of its mean is no run-up."""
_GUIDES: Final = (1, 2, 5, 10, 20, 50)
"""Orders that are drawn as thin lines on a map."""


@needs("speed_frequency_map", from_="`speed_frequency_map`, command `map`")
def speed_frequency_map(mapped: xr.Dataset, channel: str | None = None) -> Figure:
    """Spectra of a channel over speed and frequency (Campbell map), dB re 20 µPa or 1 unit peak.

    Thin lines: shaft orders 1, 2, 5, 10 … Of a steady speed over the time instead.

    Parameters
    ----------
    mapped : of `speed_frequency_map`; needs `speed_frequency_map` (channel, block, map_frequency)
    channel : one of the dataset's channels; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> mapped = va.open_results("speed_map.nc")
    >>> va.plot.speed_frequency_map(mapped).savefig("campbell.png")
    """
    name = chosen(mapped, "channel", channel)
    varies = _varies(mapped["block_speed"])
    along = "block_speed" if varies else "block_time"
    spectra = mapped["speed_frequency_map"].sel(channel=name).sortby(along)
    level, label = map_level(spectra.values, str(mapped["channel_unit"].sel(channel=name).item()))
    top = float(level.max())

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        shown = axes.pcolormesh(
            spectra["map_frequency"], spectra[along], level,
            vmin=top - _MAP_RANGE_DB, vmax=top, shading="nearest", rasterized=True,
        )  # fmt: skip
        figure = axes.get_figure()
        if figure is not None:
            figure.colorbar(shown, ax=axes, label=label)
        axes.grid(visible=False)
        if varies:
            _guides(axes, spectra)
        axes.set_xlabel("Frequency, Hz")
        axes.set_ylabel("Speed, rpm" if varies else "Time, s")
        axes.set_title(shortened(str(name)), loc="left")

    return draw(1, 3.4, paint, 0)


@needs("block_level", from_="`speed_frequency_map` of a channel of sound pressure")
def run_up_levels(mapped: xr.Dataset, channel: str | None = None) -> Figure:
    """Level of a channel of sound pressure over speed, dB re 20 µPa: a line a weighting.

    Of a steady speed over the time instead.

    Parameters
    ----------
    mapped : of `speed_frequency_map`; needs `block_level` (channel, block, weighting), dB
    channel : one of the channels of sound pressure; default: the first of them

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> mapped = va.open_results("speed_map.nc")
    >>> va.plot.run_up_levels(mapped).savefig("run_up_levels.png")
    """
    of_pressure = mapped.sel(channel=mapped["channel_unit"] == "Pa")
    name = chosen(of_pressure, "channel", channel)
    varies = _varies(mapped["block_speed"])
    along = "block_speed" if varies else "block_time"
    level = of_pressure["block_level"].sel(channel=name).sortby(along)

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        names = [str(weighting) for weighting in level["weighting"].values]
        for weighting, look in zip(names, line_looks(len(names)), strict=True):
            label = "unweighted" if weighting == "Z" else f"{weighting}-weighted"
            axes.plot(level[along], level.sel(weighting=weighting), label=label, **look)
        axes.set_xlabel("Speed, rpm" if varies else "Time, s")
        axes.set_ylabel("Level, dB re 20 µPa")
        axes.set_title(shortened(str(name)), loc="left")
        legend_below(axes, 3)

    return draw(1, 2.6, paint, 1)


@needs("tracked_order", from_="`track_orders`, command `track`")
def tracked_orders(tracked: xr.Dataset, channel: str | None = None) -> Figure:
    """Amplitude of each tracked order of a channel over speed, peak: a line an order.

    Of a steady speed over the time instead.

    Parameters
    ----------
    tracked : of `track_orders`; needs `tracked_order` (channel, track_time, order)
    channel : one of the dataset's channels; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel.

    Examples
    --------
    >>> tracked = va.open_results("tracked_orders.nc")
    >>> va.plot.tracked_orders(tracked).savefig("tracked.png")
    """
    name = chosen(tracked, "channel", channel)
    size = abs(tracked["tracked_order"].sel(channel=name))
    varies = _varies(tracked["track_speed"])
    along = tracked["track_speed"] if varies else tracked["track_time"]
    numbers = size["order"].values

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        for order, look in zip(numbers, line_looks(numbers.size), strict=True):
            axes.plot(along, size.sel(order=order), label=f"{order:g}×", **look)
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel("Speed, rpm" if varies else "Time, s")
        axes.set_ylabel(f"Peak, {tracked['channel_unit'].sel(channel=name).item()}")
        axes.set_title(shortened(str(name)), loc="left")
        legend_below(axes, 4)

    return draw(1, 2.6, paint, -(-numbers.size // 4))


def tracked_order_figures(tracked: xr.Dataset) -> list[Picture]:
    """For each channel: tracked orders over the speed."""
    return [
        Picture(
            f"tracked_{numbered_file_name(number, name)}",
            f"Tracked orders of {name}.",
            f"Tracked orders of {name}: peak amplitude, bandwidth "
            f"{tracked.attrs['bandwidth_hz']:g} Hz.",
            png(tracked_orders(tracked, name)),
        )
        for number, name in enumerate(map(str, tracked["channel"].values), 1)
    ]


def speed_map_figures(mapped: xr.Dataset) -> list[Picture]:
    """For each channel the map; of sound pressure its level too."""
    pictures = []
    for number, name in enumerate(map(str, mapped["channel"].values), 1):
        file = numbered_file_name(number, name)
        pictures.append(
            Picture(
                f"speed_map_{file}",
                f"Spectra of {name} over speed and frequency.",
                f"{name} over speed and frequency: level of each line, {_MAP_RANGE_DB:g} dB shown.",
                png(speed_frequency_map(mapped, name)),
            )
        )
        if mapped["channel_unit"].sel(channel=name) == "Pa":
            pictures.append(
                Picture(
                    f"levels_{file}",
                    f"Level of {name} over the speed.",
                    f"Level of {name} over the speed, block by block.",
                    png(run_up_levels(mapped, name)),
                )
            )
    return pictures


def _varies(speed_rpm: xr.DataArray) -> bool:
    """Whether a speed is that of a run-up."""
    return bool(np.ptp(speed_rpm.values) > _STEADY_RATIO * float(speed_rpm.mean()))


def _guides(axes: Axes, spectra: xr.DataArray) -> None:
    """Thin lines at some orders, with their number where they leave the map."""
    highest, lowest = float(spectra["map_frequency"][-1]), float(spectra["block_speed"][0])
    fastest = float(spectra["block_speed"][-1])
    for order in _GUIDES:
        end_rpm = min(fastest, 60.0 * highest / order)
        if end_rpm < lowest + 0.1 * (fastest - lowest):
            break  # too short to read
        ends_hz = [order * lowest / 60.0, order * end_rpm / 60.0]
        axes.plot(ends_hz, [lowest, end_rpm], color="white", linewidth=0.5, alpha=0.7)
        axes.annotate(
            f"{order}×", (ends_hz[1], end_rpm), xytext=(-2, -2), textcoords="offset points",
            color="white", fontsize=7, ha="right", va="top",
        )  # fmt: skip
