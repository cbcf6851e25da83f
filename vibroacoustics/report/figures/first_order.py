"""Where 1× is on an axis of frequency."""

import numpy as np
import xarray as xr

from ...results.stored_study import first_order_hz
from ..charts.marks import Segments, Span
from ..shown_speeds import many_speeds


def first_order_mark(
    results: xr.Dataset, label: str = "", colour: str = "#888888"
) -> Span | Segments:
    """Return a dotted line at every speed; where there are many, a band over their range."""
    frequencies = first_order_hz(results)
    if many_speeds(results):
        return Span(float(frequencies.min()), float(frequencies.max()), label, "#888888")
    ends = np.full(len(frequencies), np.nan)
    return Segments(frequencies, ends, frequencies, ends, label, colour, ":")


def first_order_words(results: xr.Dataset) -> str:
    """Return what the marks are, as the opening of a sentence."""
    return "Grey band" if many_speeds(results) else "Vertical dotted lines"
