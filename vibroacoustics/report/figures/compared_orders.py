"""Order spectra of two results on top of each other."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .style import COLOURS, Picture, draw, file_name, legend_below, plain

_MOST_PANELS: Final = 4
_QUIETEST: Final = 1e-6
"""Lowest amplitude that is drawn, as a share of the largest."""


def compared_order_figures(compared: xr.Dataset) -> list[Picture]:
    """For each channel: both spectra at each speed, or each order over many speeds."""
    return [_picture(compared.sel(channel=name)) for name in compared["channel"].values]


def _picture(own: xr.Dataset) -> Picture:
    by_speed = own.sizes["speed"] <= _MOST_PANELS
    across, within = ("speed", "order") if by_speed else ("order", "speed")
    places = own[across].values[:_MOST_PANELS]
    channel = str(own["channel"].item())
    labels = (own.attrs.get("first", "this"), own.attrs.get("second", "other"))
    largest = max(float(abs(own[name]).max()) for name in ("channel_order", "compared_order"))

    def paint(panels: Sequence[Axes]) -> None:
        for axes, place in zip(panels, places, strict=True):
            for name, label, colour, marker, size in (
                ("channel_order", labels[0], COLOURS[3], "o", 8),
                ("compared_order", labels[1], COLOURS[1], "x", 6),
            ):
                height = abs(own[name].sel({across: place}))
                shown = height.where(height > _QUIETEST * largest)
                if by_speed:
                    axes.vlines(height[within], _QUIETEST * largest, shown, color=colour, alpha=0.4)
                axes.semilogy(
                    height[within], shown, marker, color=colour, label=plain(label),
                    markersize=size, fillstyle="none",
                )  # fmt: skip
            axes.set_title(f"{place:.0f} rpm" if by_speed else f"order {place:g}", loc="left")
            axes.set_ylim(0.5 * float(np.nanmin(_drawn(own, largest))), 2.0 * largest)
            axes.set_ylabel(f"Peak, {own['channel_unit'].item()}")
        panels[-1].set_xlabel("Shaft order" if by_speed else "Speed, rpm")
        legend_below(panels[0])

    return Picture(
        f"compared_{file_name(channel)}",
        f"Orders of {channel} in both results.",
        f"{channel}: {labels[0]} (circles) and {labels[1]} (crosses).",
        draw(len(places), 2.2, paint, sharex=True),
    )


def _drawn(own: xr.Dataset, largest: float) -> NDArray[np.float64]:
    sizes = np.concatenate(
        [np.abs(own[name].values).ravel() for name in ("channel_order", "compared_order")]
    )
    drawn: NDArray[np.float64] = sizes[sizes > _QUIETEST * largest]
    return drawn if drawn.size else np.array([1.0])
