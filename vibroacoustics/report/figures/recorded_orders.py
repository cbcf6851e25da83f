"""Figures of a recording's orders: spectrum, orders over speed, order map."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .style import (
    Picture,
    draw,
    legend_below,
    line_looks,
    numbered_file_name,
    shortened,
    whole_number_ticks,
)

_MAP_RANGE_DB: Final = 60.0
_QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""


def recorded_order_figures(results: xr.Dataset) -> list[Picture]:
    """For each channel: mean spectrum, orders over speed in a run-up, and map if there is one."""
    is_run_up = results.sizes["speed"] > 1
    pictures = []
    for number, channel in enumerate(results["channel"].values, 1):
        own = results.sel(channel=channel)
        name = numbered_file_name(number, str(channel))
        pictures.append(_spectrum(own, str(channel), name))
        if is_run_up:
            pictures.append(_over_speed(own, str(channel), name))
        if "order_map" in results:
            pictures.append(_map(own, str(channel), name, is_run_up))
    return pictures


def _unit(own: xr.Dataset) -> str:
    return str(own["channel_unit"].item())


def _without_offset(lines: xr.DataArray, own: xr.Dataset) -> xr.DataArray:
    """Lines above the main lobe of an offset, which is no order."""
    return lines.sel(map_order=lines["map_order"] > 0.5 * own.attrs["band_order"])


def _logarithmic(axes: Axes, shown: xr.DataArray) -> None:
    """Logarithmic axis over what is shown, unless it is next to nothing."""
    highest = float(shown.max())
    if highest > 0.0:
        axes.set_yscale("log")
        axes.set_ylim(bottom=max(0.5 * float(shown.min()), _QUIETEST * highest), top=2.0 * highest)


def _spectrum(own: xr.Dataset, channel: str, name: str) -> Picture:
    spectrum = _without_offset(own["mean_order_spectrum"], own)

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        axes.plot(spectrum["map_order"], spectrum)
        _logarithmic(axes, spectrum)
        whole_number_ticks(axes)
        axes.set_xlabel("Shaft order")
        axes.set_ylabel(f"RMS of a line, {_unit(own)}")
        axes.set_title(shortened(channel), loc="left")

    return Picture(
        f"spectrum_{name}",
        f"Mean order spectrum of {channel}, to order {float(spectrum['map_order'][-1]):g}.",
        f"Mean order spectrum of {channel}: root of the mean power over the blocks.",
        draw(1, 2.6, paint, 0),
    )


def _over_speed(own: xr.Dataset, channel: str, name: str) -> Picture:
    cuts = own["block_order_rms"].sortby("block_speed")
    orders = cuts["order"].values

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        for order, look in zip(orders, line_looks(orders.size), strict=True):
            axes.plot(cuts["block_speed"], cuts.sel(order=order), label=f"{order:g}×", **look)
        _logarithmic(axes, cuts)
        axes.set_xlabel("Speed, rpm")
        axes.set_ylabel(f"RMS in the order's band, {_unit(own)}")
        axes.set_title(shortened(channel), loc="left")
        legend_below(axes, 4)

    return Picture(
        f"orders_{name}",
        f"Orders of {channel} over the speed.",
        f"Orders of {channel} over the speed, block by block.",
        draw(1, 2.6, paint, -(-orders.size // 4)),
    )


def _map(own: xr.Dataset, channel: str, name: str, is_run_up: bool) -> Picture:
    spectra = _without_offset(own["order_map"].transpose("block", "map_order"), own)
    spectra = spectra.sortby("block_speed") if is_run_up else spectra
    level = 20.0 * np.log10(np.maximum(np.abs(spectra.values), np.finfo(float).tiny))
    top = float(level.max())

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        shown = axes.pcolormesh(
            spectra["map_order"],
            spectra["block_speed" if is_run_up else "block_time"],
            level,
            vmin=top - _MAP_RANGE_DB,
            vmax=top,
            shading="nearest",
            rasterized=True,
        )
        figure = axes.get_figure()
        if figure is not None:
            figure.colorbar(shown, ax=axes, label=f"dB re 1 {_unit(own)} peak")
        axes.grid(visible=False)
        whole_number_ticks(axes)
        axes.set_xlabel("Shaft order")
        axes.set_ylabel("Speed, rpm" if is_run_up else "Time, s")
        axes.set_title(shortened(channel), loc="left")

    return Picture(
        f"map_{name}",
        f"Order map of {channel}.",
        f"Order map of {channel}: peak amplitude of each line, {_MAP_RANGE_DB:g} dB shown.",
        draw(1, 3.4, paint, 0),
    )
