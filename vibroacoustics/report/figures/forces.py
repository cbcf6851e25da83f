"""The resultant force of every option over one revolution."""

import numpy as np
import xarray as xr

from ...results.stored_study import options, speeds, words
from ...results.titles import chosen
from ..charts.layout import wrapped
from ..charts.marks import Axis, Chart, Panel, lines
from ..charts.needs import needs


@needs("force", from_="`run` (above 100 speeds with operation.keep_time_series)")
def force_over_revolution(results: xr.Dataset, speed_rpm: float | None = None) -> Chart:
    """Force on the housing over crank angle: a panel an axis, a line an option.

    Parameters
    ----------
    results : of `run`; needs `force` (speed, option, source, axis, crank_angle), N
    speed_rpm : one of the results' speeds; default: the highest
    """
    speed = max(speeds(results)) if speed_rpm is None else chosen(results, "speed", speed_rpm)
    total = results["force"].sel(speed=speed).sum("source").transpose("axis", "option", ...)
    names = [wrapped(name, 24) for name in options(results)]
    degrees = np.rad2deg(results["crank_angle"].values)
    angles = tuple((float(angle), str(angle)) for angle in range(0, 361, 60))
    peak = float(abs(total).max())
    panels = tuple(
        Panel(
            Axis("Crank angle, degrees", limits=(0.0, 360.0), ticks=angles),
            Axis(f"Along {along['axis'].item()}, N", limits=(-1.05 * peak, 1.05 * peak)),
            lines(degrees, zip(names, along.values, strict=True)),
            height=2.0,
        )
        for along in total
    )
    return Chart(
        "force_over_revolution",
        f"Resultant force along x, y and z over one revolution at {speed:g} rpm for every option; "
        f"the largest force is {peak:.3g} N.",
        f"Resultant force on the housing over one revolution at {speed:g} rpm, along "
        f"{words(results)['axes']}. All three on one scale; lines that coincide are dashed "
        "differently.",
        panels,
    )
