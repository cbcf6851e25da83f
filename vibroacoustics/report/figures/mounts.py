"""What the mounts let through."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base import rounding
from ...results.stored_study import first_order_hz
from ..charts.needs import needs
from ..shown_speeds import many_speeds
from .first_order import mark_first_order
from .panels import one_panel
from .style import COLOURS, Picture, frequency_ticks, png


@needs("mount_transmissibility")
def mount_transmissibility(results: xr.Dataset) -> Figure:
    """Sum of the foot forces per force over frequency, with 1x marked at every speed.

    Parameters
    ----------
    results : of `run`; needs `mount_transmissibility` (axis, mount_frequency), 1

    Raises
    ------
    ParameterError
        The results hold no transmissibility.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.mount_transmissibility(results).savefig("mounts.png")
    """
    transmitted = abs(results["mount_transmissibility"])
    attaching = []
    if "option_mount_transmissibility" in results:
        attaching = list(abs(results["option_mount_transmissibility"]).dropna("option"))

    def paint(axes: Axes) -> None:
        looks = zip(("-", "--", "-."), (COLOURS[3], COLOURS[2], COLOURS[5]), strict=True)
        for curve, (dash, colour) in zip(transmitted, looks, strict=True):
            label = f"along {curve['axis'].item()}"
            axes.loglog(curve["mount_frequency"], curve, dash, color=colour, label=label)
            for option in attaching:
                with_bodies = f"{label}, {option['option'].item()}"
                along = option.sel(axis=curve["axis"])
                axes.loglog(
                    along["mount_frequency"], along, dash, color=colour, lw=0.7, label=with_bodies
                )
        mark_first_order(axes, results, "black", "1× at the speeds of the study")
        axes.axhline(1.0, color="#888888", linewidth=0.8)
        frequency_ticks(axes, transmitted["mount_frequency"].values)

    y = "Sum of foot forces per force, 1"
    return one_panel(3.0, paint, "Frequency, Hz", y, columns=2, rows=2)


def mount_figures(results: xr.Dataset) -> list[Picture]:
    """Transmissibility along each axis, with the 1x line marked at every speed."""
    return [
        Picture(
            "mount_transmissibility",
            "Transmissibility of the mounts along x, y and z against frequency, above one around "
            "the natural frequencies and falling above them.",
            "Sum of the foot forces per force at the centre of mass, along the same axis. "
            f"Below 1 the mounts isolate. 1× lies at {_first_order(results)}.",
            png(mount_transmissibility(results)),
        )
    ]


def _first_order(results: xr.Dataset) -> str:
    """Frequencies of 1×: the first two, or the range of many."""
    shaft = first_order_hz(results)
    if many_speeds(results):
        return f"{rounding.span(shaft, rounding.fixed)} Hz"
    marks = " and ".join(f"{frequency:.1f} Hz" for frequency in shaft[:2])
    return marks if len(shaft) <= 2 else f"{marks} and further speeds"
