"""The resultant force of every option over one revolution."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..study import options, speeds, words
from .style import Picture, draw, legend_below, line_looks, wrap


def force_figures(results: xr.Dataset) -> list[Picture]:
    """Force along each axis over the crank angle, at the highest speed; none where not kept."""
    if "force" not in results:
        return []
    speed = max(speeds(results))
    total = results["force"].sel(speed=speed).sum("source").transpose("axis", "option", ...)
    degrees = np.rad2deg(results["crank_angle"].values)
    names = options(results)
    looks = line_looks(len(names))

    def paint(panels: Sequence[Axes]) -> None:
        for axes, along in zip(panels, total, strict=True):
            for curve, name, look in zip(along.values, names, looks, strict=True):
                axes.plot(degrees, curve, label=wrap(name, 24), **look)
            axes.set_ylabel(f"Force along {along['axis'].item()}, N")
            axes.set_xlim(0.0, 360.0)
            axes.set_xticks(range(0, 361, 60))
        panels[-1].set_xlabel("Crank angle, degrees")
        legend_below(panels[0])

    png = draw(total.sizes["axis"], 1.8, paint, (len(names) + 1) // 2, sharex=True, sharey=True)
    peak = float(abs(total).max())
    return [
        Picture(
            "force_over_revolution",
            f"Resultant force along x, y and z over one revolution at {speed:g} rpm for every "
            f"option; the largest force is {peak:.3g} N.",
            f"Resultant force on the housing over one revolution at {speed:g} rpm, along "
            f"{words(results)['axes']}. All three on one scale; "
            "lines that coincide are dashed differently.",
            png,
        )
    ]
