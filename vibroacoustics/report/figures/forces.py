"""The resultant force of every option over one revolution."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...results.stored_study import options, speeds, words
from ..charts.needs import needs
from ..titles import chosen
from .panels import each_panel, lines
from .style import Picture, png, wrap


@needs("force", from_="`run` (above 100 speeds with operation.keep_time_series)")
def force_over_revolution(results: xr.Dataset, speed_rpm: float | None = None) -> Figure:
    """Force on the housing over crank angle: a panel an axis, a line an option.

    Parameters
    ----------
    results : of `run`; needs `force` (speed, option, source, axis, crank_angle), N
    speed_rpm : one of the results' speeds; default: the highest

    Raises
    ------
    ParameterError
        The results hold no force, or not this speed.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.force_over_revolution(results).savefig("force.png")
    """
    speed = max(speeds(results)) if speed_rpm is None else chosen(results, "speed", speed_rpm)
    total = _total(results, speed)
    degrees = np.rad2deg(results["crank_angle"].values)
    names = [wrap(name, 24) for name in options(results)]

    def paint(axes: Axes, along: xr.DataArray) -> None:
        lines(axes, degrees, names, along.values)
        axes.set_ylabel(f"Force along {along['axis'].item()}, N")
        axes.set_xlim(0.0, 360.0)
        axes.set_xticks(range(0, 361, 60))

    return each_panel(
        list(total), 1.8, paint, "Crank angle, degrees", columns=2, rows=(len(names) + 1) // 2,
        sharex=True, sharey=True,
    )  # fmt: skip


def force_figures(results: xr.Dataset) -> list[Picture]:
    """Force along each axis over the crank angle, at the highest speed; none where not kept."""
    if "force" not in results:
        return []
    speed = max(speeds(results))
    peak = float(abs(_total(results, speed)).max())
    return [
        Picture(
            "force_over_revolution",
            f"Resultant force along x, y and z over one revolution at {speed:g} rpm for every "
            f"option; the largest force is {peak:.3g} N.",
            f"Resultant force on the housing over one revolution at {speed:g} rpm, along "
            f"{words(results)['axes']}. All three on one scale; "
            "lines that coincide are dashed differently.",
            png(force_over_revolution(results)),
        )
    ]


def _total(results: xr.Dataset, speed_rpm: float) -> xr.DataArray:
    """Force of all sources together, (axis, option, crank_angle), N."""
    total = results["force"].sel(speed=speed_rpm).sum("source")
    return total.transpose("axis", "option", ...)
