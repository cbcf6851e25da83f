"""Orders over the speed as lines, and levels over speed and frequency as colours."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.order_cuts import OrderCuts, order_cuts
from ...results.over_speed.plane import Plane, plane_of
from ...results.stored_study import catalogue_receiver
from ..charts.axes import MAP_RANGE_DB, amplitude_axis, level_axis, level_image
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Mark, Note, Panel, Segments
from ..charts.needs import needs
from ..file_names import numbered
from .levels_over_speed import FEW_POINTS

_OF_RESULTS: Final = ("-", "--")


@needs(
    "block_order_rms", "compared_order_rms", "pressure_line", any_of=True,
    from_="`run`, `analyse_orders` or `compare`",
)  # fmt: skip
def orders_over_speed(
    orders: xr.Dataset, channel: str | None = None, option: str = REFERENCE_OPTION
) -> Chart:
    """Order cuts of a channel over the speed: a line an order.

    Sound pressure levels are unweighted, dB re 20 µPa. A study or a comparison shows the eight
    strongest orders, after weighting by A where they are sound; of a comparison solid lines are the
    first result, dashed ones the second. With `order_limit` (of `check_limits`), limits are drawn
    in the colours of their orders.

    Parameters
    ----------
    orders : result of `analyse_orders`, needs `block_order_rms` (channel, block, order); of
        `compare`, needs `compared_order_rms`; or of `run`, needs `pressure_line`
    channel : named as in `compare`; default: of a study the microphone of the catalogue's noise,
        else the first
    option : option of a study
    """
    cuts = order_cuts(orders, channel, option)
    words, by, title = "", ".", shortened(cuts.channel, 60)
    if "block_order_rms" in orders:
        name, by = f"orders_{dict(numbered(orders, 'channel'))[cuts.channel]}", ", block by block."
    elif len(cuts.rms) > 1:
        name = f"over_speed_{dict(numbered(orders, 'channel'))[cuts.channel]}"
        by, title = ". Solid: A, dashed: B.", f"{title}; solid A, dashed B"
    else:
        name, words = "orders_over_speed", f", option {option}"
    return Chart(
        name,
        f"Orders of {cuts.channel} over the speed.",
        f"Orders of {cuts.channel}{words} over the speed{by}",
        (Panel(Axis("Speed, rpm"), _axis(cuts), tuple(_lines(cuts)), title, 2.8),),
        wide=True,
    )


def _lines(cuts: OrderCuts) -> Iterator[Line]:
    """Yield each order of all results, and its limit."""
    marker = "o" if cuts.speed_rpm.size <= FEW_POINTS else ""
    several = len(cuts.rms) > 1
    for number, order in enumerate(cuts.order):
        colour = COLOURS[number % len(COLOURS)]
        for result, rms in enumerate(cuts.shown(cuts.rms[:, number])):
            name = "" if result else f"{order:g}×"
            looks = (colour, _OF_RESULTS[result]) if several else ("", "")
            yield Line(cuts.speed_rpm, rms, name, None, *looks, marker)
        if cuts.limits is not None:
            name, shown = "" if number else "limits", cuts.shown(cuts.limits[number])
            yield Line(cuts.speed_rpm, shown, name, None, colour, "-", marker and "_", 0.8)


def _axis(cuts: OrderCuts) -> Axis:
    """Return levels down to a range below the highest; of others a logarithmic axis."""
    limits = np.empty(0) if cuts.limits is None else cuts.limits
    if cuts.unit == "Pa":
        shown = cuts.shown(np.concatenate([cuts.rms.ravel(), limits.ravel()]))
        return level_axis("Level, dB re 20 µPa", shown)
    return amplitude_axis(f"RMS in the order's band, {cuts.unit}", cuts.rms, limits)


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
    For a study: the lines of all sources, without their noise.

    Parameters
    ----------
    results : results of `speed_frequency_map`, needs `speed_frequency_map` (channel, block,
        map_frequency); or of `run`, needs `pressure_line`
    channel : channel or microphone; default: the first, or that of the catalogue's noise
    option : option of a study
    """
    plane = plane_of(results, channel, option)
    colours = level_image(plane.frequency_hz, plane.along, plane.level_db, plane.unit)
    guides = _guides(plane) if plane.is_speed else ()
    y = Axis("Speed, rpm" if plane.is_speed else "Time, s")
    panel = Panel(Axis("Frequency, Hz"), y, (colours, *guides), shortened(plane.title, 90), 3.8)
    if "speed_frequency_map" in results:
        words = (
            f"speed_map_{dict(numbered(results, 'channel'))[plane.title]}",
            f"Spectra of {plane.title} over speed and frequency.",
            f"{plane.title} over speed and frequency: level of each line, {MAP_RANGE_DB:g} dB "
            "shown.",
        )
    else:
        microphone = channel or catalogue_receiver(results)
        words = (
            "speed_frequency_map",
            f"Level of the lines at {microphone} over speed and frequency.",
            f"Lines of all sources at {microphone} over speed and frequency, option {option}, "
            f"unweighted, {MAP_RANGE_DB:g} dB shown; noise is not in it.",
        )
    return Chart(*words, (panel,), wide=True)


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
