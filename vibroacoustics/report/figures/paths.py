"""Bars of the leading paths of sound, and of the forces into the feet."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import catalogue_receiver
from ..charts.needs import needs
from ..paths import at_path_speed, foot_forces, leading, path_speed, path_words
from ..titles import chosen
from .panels import each_panel, one_panel
from .style import COLOURS, Picture, numbered, png, wrap

_WITH, _AGAINST = COLOURS[3], COLOURS[1]


def path_figure(results: xr.Dataset, receiver: str) -> Picture:
    """Bars of a microphone's leading paths."""
    speed, files = path_speed(results), dict(numbered(results, "receiver"))
    return Picture(
        f"paths_{files[receiver]}",
        f"Shares of the leading paths of the modelled A-weighted energy at {receiver} as bars, to "
        "the left where a path works against the others; the numbers are in the table.",
        f"{receiver}, {speed:g} rpm, option {REFERENCE_OPTION}: shares add up to 100 % over all "
        "paths; to the left what works against the others.",
        png(path_shares(results, receiver)),
    )


@needs("path_share")
def path_shares(results: xr.Dataset, receiver: str | None = None) -> Figure:
    """Shares of the ten leading paths of the modelled A-weighted energy, a bar a path.

    Without a balancer, at the speed of the published level or the nearest that is kept.

    Parameters
    ----------
    results : of `run`; needs `path_share` (path_speed, option, path, receiver)
    receiver : a microphone; default: the catalogue's

    Raises
    ------
    ParameterError
        The results hold none, or there is no such microphone.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.path_shares(results).savefig("paths.png")
    """
    name = chosen(results, "receiver", receiver or catalogue_receiver(results))
    share = at_path_speed(results, name)["path_share"].values
    rows = leading(share)
    labels = [wrap(": ".join(path_words(results, row)), 34) for row in rows]

    def paint(axes: Axes) -> None:
        sizes = 100.0 * share[rows]
        colours = [_WITH if size >= 0.0 else _AGAINST for size in sizes]
        axes.barh(range(len(rows)), sizes, color=colours)
        axes.axvline(0.0, color="black", linewidth=0.8)
        axes.set_yticks(range(len(rows)), labels)
        axes.invert_yaxis()

    height = 0.7 + 0.33 * max(len(rows), 1)
    return one_panel(height, paint, "Share of the modelled energy, %")


def foot_figure(results: xr.Dataset, speed: float) -> Picture:
    """Bars of the forces into the feet."""
    return Picture(
        "paths_feet",
        "Peak force into each foot along x, y and z at the first and second order as bars; the "
        "numbers are in the table.",
        f"{speed:g} rpm, option {REFERENCE_OPTION}: force into each foot, peak.",
        png(_foot_bars(results, speed)),
    )


def _foot_bars(results: xr.Dataset, speed: float) -> Figure:
    forces = abs(foot_forces(results, speed).sum("source"))
    feet = [str(name).replace("_", " ") for name in forces["foot"].values]
    axes_names = [str(name) for name in forces["axis"].values]
    height = 0.8 / len(axes_names)

    def paint(axes: Axes, order: float) -> None:
        for number, axis in enumerate(axes_names):
            at = np.arange(len(feet)) + (number - 1) * height
            values = forces.sel(axis=axis, order=order).values
            axes.barh(at, values, height, color=COLOURS[1 + number], label=f"along {axis}")
        axes.set_yticks(range(len(feet)), [wrap(name) for name in feet])
        axes.invert_yaxis()

    return each_panel(
        forces["order"].values, 0.5 + 0.35 * len(feet), paint, "Force into the foot, N peak",
        title=lambda order: f"{order:g}×", columns=3, rows=1,
    )  # fmt: skip
