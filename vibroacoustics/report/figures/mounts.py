"""What the mounts let through."""

import xarray as xr

from ...base import rounding
from ...results.stored_study import first_order_hz
from ..charts.layout import COLOURS
from ..charts.marks import Axis, Chart, Line, Panel, Segments, frequency_axis
from ..charts.needs import needs
from ..shown_speeds import many_speeds
from .first_order import first_order_mark


@needs("mount_transmissibility")
def mount_transmissibility(results: xr.Dataset) -> Chart:
    """Sum of the foot forces per force over frequency, with 1x marked at every speed.

    Parameters
    ----------
    results : of `run`; needs `mount_transmissibility` (axis, mount_frequency), 1
    """
    nominal, attaching, curves = abs(results["mount_transmissibility"]), [], []
    if "option_mount_transmissibility" in results:
        attaching = list(abs(results["option_mount_transmissibility"]).dropna("option"))
    frequency = nominal["mount_frequency"].values
    looks = zip(nominal, ["-", "--", "-."], (COLOURS[3], COLOURS[2], COLOURS[5]), strict=True)
    for curve, dash, colour in looks:
        axis = curve["axis"].item()
        curves.append(Line(frequency, curve, f"along {axis}", colour=colour, dash=dash))
        for option in attaching:
            label = f"along {axis}, {option['option'].item()}"
            curves.append(
                Line(frequency, option.sel(axis=axis), label, colour=colour, dash=dash, width=0.7)
            )
    first = first_order_mark(results, "1× at the speeds of the study", "#000000")
    unity = Segments([frequency[0]], [1.0], [frequency[-1]], [1.0], colour="#888888", width=0.8)
    y = Axis("Sum of foot forces per force, 1", "log")
    panel = Panel(
        frequency_axis("Frequency, Hz", frequency), y, (*curves, first, unity), height=3.0
    )
    return Chart(
        "mount_transmissibility",
        "Transmissibility of the mounts along x, y and z against frequency, above 1 around the "
        "natural frequencies and falling above them.",
        "Sum of the foot forces per force at the centre of mass, along the same axis. Below 1 the "
        f"mounts isolate. 1× is at {_first_order(results)}.",
        (panel,),
    )


def _first_order(results: xr.Dataset) -> str:
    """Frequencies of 1×: the first two, or the range of many."""
    shaft = first_order_hz(results)
    if many_speeds(results):
        return f"{rounding.span(shaft, rounding.fixed)} Hz"
    marks = " and ".join(f"{frequency:.1f} Hz" for frequency in shaft[:2])
    return marks if len(shaft) <= 2 else f"{marks} and further speeds"
