"""Axes that several charts share."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from .layout import wrapped
from .marks import Axis, Image, Mark, Panel, Values, named_axis, numbers

QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""
MAP_RANGE_DB: Final = 60.0
"""Range of the colours of a map over speed and frequency."""
_ROOM_DB: Final = 3.0


def amplitude_axis(label: str, sizes: Values, limits: Values = ()) -> Axis:
    """Return a logarithmic axis of amplitudes that also shows their limits."""
    shown, allowed = (values[np.isfinite(values)] for values in (numbers(sizes), numbers(limits)))
    highest = float(shown.max(initial=0.0))
    if not highest > 0.0:
        return Axis(label, "log")
    lowest = max(0.5 * float(shown.min()), QUIETEST * highest)
    ends = (0.5 * allowed.min(initial=2.0 * lowest), 2.0 * allowed.max(initial=highest))
    return Axis(label, "log", (float(ends[0]), float(ends[1])))


def level_axis(label: str, levels: Values, range_db: float = 80.0) -> Axis:
    """Return an axis of levels, dB, down to a range below the highest."""
    shown = numbers(levels)[np.isfinite(levels)]
    if not shown.size:
        return Axis(label)
    top = float(shown.max()) + _ROOM_DB
    return Axis(label, limits=(max(float(shown.min()) - _ROOM_DB, top - range_db), top))


def band_axis(band_hz: Sequence[float]) -> Axis:
    """Return an axis of third octaves, Hz, that are numbered from 0, every third one named."""
    ticks = tuple((float(number), f"{band_hz[number]:g}") for number in range(0, len(band_hz), 3))
    return Axis("Third octave, Hz", ticks=ticks)


def ticks_at(values: Iterable[float]) -> tuple[tuple[float, str], ...]:
    """Return ticks at numbers, which are written with a true minus sign."""
    return tuple((float(value), f"{value:g}".replace("-", "−")) for value in values)


def option_panel(x: Axis, options: Sequence[str], marks: Iterable[Mark], title: str = "") -> Panel:
    """Return a panel with a row for each option."""
    height = 0.8 + 0.26 * len(options)
    return Panel(x, named_axis(options, wrapped), tuple(marks), title, height)


def level_image(
    x: Values, y: Values, levels: Values, label: str, range_db: float = MAP_RANGE_DB
) -> Image:
    """Return levels, dB, as colours down to a range below the highest."""
    top = float(np.max(levels))
    return Image(x, y, levels, (top - range_db, top), label)


def stacked(panels: Iterable[Panel]) -> tuple[Panel, ...]:
    """Return panels on top of each other; the lowest alone has the label of the abscissa."""
    every = tuple(panels)
    return (*(replace(each, x=replace(each.x, label="")) for each in every[:-1]), *every[-1:])
