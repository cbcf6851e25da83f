"""Axes that several charts share."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from .colours import numbers
from .marks import Axis, Panel, Values

QUIETEST: Final = 1e-5
"""Lowest amplitude of a logarithmic axis, as a share of the largest."""
_ROOM_DB: Final = 3.0


def amplitude_axis(label: str, sizes: Values, limits: Values = ()) -> Axis:
    """Return a logarithmic axis of amplitudes that also shows their limits.

    Parameters
    ----------
    label : quantity and unit
    sizes : amplitudes, of any shape
    limits : of amplitudes, of any shape
    """
    shown, allowed = (values[np.isfinite(values)] for values in (numbers(sizes), numbers(limits)))
    highest = float(shown.max(initial=0.0))
    if not highest > 0.0:
        return Axis(label, "log")
    lowest = max(0.5 * float(shown.min()), QUIETEST * highest)
    ends = (0.5 * allowed.min(initial=2.0 * lowest), 2.0 * allowed.max(initial=highest))
    return Axis(label, "log", (float(ends[0]), float(ends[1])))


def level_axis(label: str, levels: Values, range_db: float = 80.0) -> Axis:
    """Return an axis of levels down to a range below the highest.

    Parameters
    ----------
    label : quantity and unit
    levels : dB, of any shape
    range_db : longest axis
    """
    shown = numbers(levels)[np.isfinite(levels)]
    if not shown.size:
        return Axis(label)
    top = float(shown.max()) + _ROOM_DB
    return Axis(label, limits=(max(float(shown.min()) - _ROOM_DB, top - range_db), top))


def band_axis(band_hz: Sequence[float]) -> Axis:
    """Return an axis of third octaves that are numbered from 0, every third one named.

    Parameters
    ----------
    band_hz : middle frequencies, shape (band,)
    """
    ticks = tuple((float(number), f"{band_hz[number]:g}") for number in range(0, len(band_hz), 3))
    return Axis("Third octave, Hz", ticks=ticks)


def stacked(panels: Iterable[Panel]) -> tuple[Panel, ...]:
    """Return panels on top of each other; the lowest alone has the label of the abscissa."""
    every = tuple(panels)
    return (*(replace(each, x=replace(each.x, label="")) for each in every[:-1]), *every[-1:])
