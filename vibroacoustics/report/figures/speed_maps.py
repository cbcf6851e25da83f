"""Colour maps over speed and frequency, of a study or a recording."""

from typing import Final

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.plane import Plane, plane_of
from ..charts.needs import needs
from .panels import level_map, one_panel
from .style import WIDTH_INCH, shortened

MAP_RANGE_DB: Final = 60.0
_GUIDES: Final = (1, 2, 5, 10, 20, 50)
"""Orders that are drawn as thin lines on a map."""


@needs(
    "speed_frequency_map", "pressure_line", any_of=True,
    from_="`run`, or `speed_frequency_map`, command `map`",
)  # fmt: skip
def speed_frequency_map(
    results: xr.Dataset,
    channel: str | None = None,
    option: str = REFERENCE_OPTION,
    width_inch: float = WIDTH_INCH,
) -> Figure:
    """Level of a channel over speed and frequency, dB re 20 µPa or 1 unit peak, unweighted.

    Thin lines: shaft orders 1, 2, 5, 10 … Of a recording at a steady speed over the time instead.
    Of a study the lines of all sources, without their noise.

    Parameters
    ----------
    results : of `speed_frequency_map`, needs `speed_frequency_map` (channel, block,
        map_frequency); or of `run`, needs `pressure_line`
    channel : channel or microphone; default: the first, or that of the catalogue's noise
    option : of a study
    width_inch : of the figure

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such channel or option.

    Examples
    --------
    >>> mapped = va.open_results("speed_map.nc")
    >>> va.plot.speed_frequency_map(mapped).savefig("speed_map.png")
    """
    plane = plane_of(results, channel, option)

    def paint(axes: Axes) -> None:
        unit = plane.unit
        level_map(axes, plane.frequency_hz, plane.along, plane.level_db, MAP_RANGE_DB, unit)
        if plane.is_speed:
            _guides(axes, plane)

    y = "Speed, rpm" if plane.is_speed else "Time, s"
    title = shortened(plane.title)
    return one_panel(3.4, paint, "Frequency, Hz", y, title, width_inch=width_inch)


def _guides(axes: Axes, plane: Plane) -> None:
    """Thin lines at some orders, with their number where they leave the map."""
    highest = float(plane.frequency_hz[-1])
    lowest, fastest = float(plane.along[0]), float(plane.along[-1])
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
