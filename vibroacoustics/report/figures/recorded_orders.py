"""Figures of a recording's orders: spectrum, orders over speed, order map."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .style import Picture, draw, file_name, legend_below, line_looks, plain

_MAP_RANGE_DB: Final = 60.0
_QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""


def recorded_order_figures(results: xr.Dataset) -> list[Picture]:
    """For each channel: mean spectrum, orders over speed in a run-up, and map if there is one."""
    pictures = []
    for channel in results["channel"].values:
        own = results.sel(channel=channel)
        pictures.append(_spectrum(own, str(channel)))
        if results.sizes["speed"] > 1:
            pictures.append(_over_speed(own, str(channel)))
        if "order_map" in results:
            pictures.append(_map(own, str(channel)))
    return pictures


def _unit(own: xr.Dataset) -> str:
    return str(own["channel_unit"].item())


def _spectrum(own: xr.Dataset, channel: str) -> Picture:
    spectrum = own["mean_order_spectrum"]

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        axes.semilogy(spectrum["map_order"], spectrum)
        axes.set_ylim(bottom=_QUIETEST * float(spectrum.max()))
        axes.set_xlabel("Shaft order")
        axes.set_ylabel(f"RMS of a line, {_unit(own)}")
        axes.set_title(plain(channel), loc="left")

    return Picture(
        f"spectrum_{file_name(channel)}",
        f"Mean order spectrum of {channel}, to order {float(spectrum['map_order'][-1]):g}.",
        f"Mean order spectrum of {channel}: root of the mean power over the blocks.",
        draw(1, 2.6, paint, 0),
    )


def _over_speed(own: xr.Dataset, channel: str) -> Picture:
    cuts = own["block_order_rms"].sortby("block_speed")
    orders = cuts["order"].values

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        for order, look in zip(orders, line_looks(orders.size), strict=True):
            axes.semilogy(cuts["block_speed"], cuts.sel(order=order), label=f"{order:g}×", **look)
        axes.set_ylim(bottom=_QUIETEST * float(cuts.max()))
        axes.set_xlabel("Speed, rpm")
        axes.set_ylabel(f"RMS in the order's band, {_unit(own)}")
        axes.set_title(plain(channel), loc="left")
        legend_below(axes, 4)

    return Picture(
        f"orders_{file_name(channel)}",
        f"Orders of {channel} over the speed.",
        f"Orders of {channel} over the speed, block by block.",
        draw(1, 2.6, paint, -(-orders.size // 4)),
    )


def _map(own: xr.Dataset, channel: str) -> Picture:
    spectra = own["order_map"].transpose("block", "map_order")
    level = 20.0 * np.log10(np.maximum(np.abs(spectra.values), np.finfo(float).tiny))
    top = float(level.max())
    rising = bool(np.ptp(spectra["block_speed"].values) > 0.02 * spectra["block_speed"].mean())
    along = spectra["block_speed"] if rising else spectra["block_time"]
    order = np.argsort(along.values, kind="stable")

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        shown = axes.pcolormesh(
            spectra["map_order"],
            along.values[order],
            level[order],
            vmin=top - _MAP_RANGE_DB,
            vmax=top,
            shading="nearest",
            rasterized=True,
        )
        figure = axes.get_figure()
        if figure is not None:
            figure.colorbar(shown, ax=axes, label=f"dB re 1 {_unit(own)} peak")
        axes.grid(visible=False)
        axes.set_xlabel("Shaft order")
        axes.set_ylabel("Speed, rpm" if rising else "Time, s")
        axes.set_title(plain(channel), loc="left")

    return Picture(
        f"map_{file_name(channel)}",
        f"Order map of {channel}.",
        f"Order map of {channel}: peak amplitude of each line, {_MAP_RANGE_DB:g} dB shown.",
        draw(1, 3.4, paint, 0),
    )
