"""Colour maps over speed and frequency, of a study or a recording."""

from typing import Final

import numpy as np
import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.plane import Plane, plane_of
from ...results.stored_study import catalogue_receiver
from ..charts.layout import shortened
from ..charts.marks import Axis, Chart, Image, Mark, Note, Panel, Segments
from ..charts.needs import needs
from ..file_names import numbered

MAP_RANGE_DB: Final = 60.0
_GUIDES: Final = (1, 2, 5, 10, 20, 50)
"""Orders that are drawn as thin lines on a map."""
_WHITE: Final = "#ffffff"


@needs(
    "speed_frequency_map", "pressure_line", any_of=True,
    from_="`run`, or `speed_frequency_map`, command `map`",
)  # fmt: skip
def speed_frequency_map(
    results: xr.Dataset, channel: str | None = None, option: str = REFERENCE_OPTION
) -> Chart:
    """Level of a channel over speed and frequency, dB re 20 µPa or 1 unit peak, unweighted.

    Thin lines: shaft orders 1, 2, 5, 10 … Of a recording at a steady speed over the time instead.
    Of a study the lines of all sources, without their noise.

    Parameters
    ----------
    results : of `speed_frequency_map`, needs `speed_frequency_map` (channel, block,
        map_frequency); or of `run`, needs `pressure_line`
    channel : channel or microphone; default: the first, or that of the catalogue's noise
    option : of a study
    """
    plane = plane_of(results, channel, option)
    top = float(plane.level_db.max())
    scale = (top - MAP_RANGE_DB, top)
    colours = Image(plane.frequency_hz, plane.along, plane.level_db, scale, plane.unit)
    guides = _guides(plane) if plane.is_speed else ()
    y = Axis("Speed, rpm" if plane.is_speed else "Time, s")
    panel = Panel(Axis("Frequency, Hz"), y, (colours, *guides), shortened(plane.title, 90), 3.8)
    if "speed_frequency_map" in results:
        return Chart(
            f"speed_map_{dict(numbered(results, 'channel'))[plane.title]}",
            f"Spectra of {plane.title} over speed and frequency.",
            f"{plane.title} over speed and frequency: level of each line, {MAP_RANGE_DB:g} dB "
            "shown.",
            (panel,), wide=True,
        )  # fmt: skip
    microphone = channel or catalogue_receiver(results)
    return Chart(
        "speed_frequency_map",
        f"Level of the lines at {microphone} over speed and frequency.",
        f"Lines of all sources at {microphone} over speed and frequency, option {option}, "
        f"unweighted, {MAP_RANGE_DB:g} dB shown; noise is not in it.",
        (panel,), wide=True,
    )  # fmt: skip


def _guides(plane: Plane) -> tuple[Mark, ...]:
    """Return thin lines at some orders, with their number where they leave the map."""
    highest = float(plane.frequency_hz[-1])
    lowest, fastest = float(plane.along[0]), float(plane.along[-1])
    order = np.array(_GUIDES)
    end_rpm = np.minimum(fastest, 60.0 * highest / order)
    is_long = end_rpm >= lowest + 0.1 * (fastest - lowest)  # enough to be read
    order, end_rpm = order[is_long], end_rpm[is_long]
    start, end = order * lowest / 60.0, order * end_rpm / 60.0
    rays = Segments(start, np.full(start.shape, lowest), end, end_rpm, "", _WHITE, width=0.6)
    notes = (
        Note(x, y, f"{k}×", _WHITE, "right", (-3.0, -9.0))
        for x, y, k in zip(end.tolist(), end_rpm.tolist(), order, strict=True)
    )
    return rays, *notes
