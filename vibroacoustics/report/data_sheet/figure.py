"""Third octaves of a data sheet: what is modelled, and all."""

import numpy as np
from matplotlib.axes import Axes

from ..figures.panels import one_panel, third_octave_ticks
from ..figures.style import COLOURS, Picture, png
from .model import SoundPower

_RANGE_DB = 50.0


def sheet_picture(power: SoundPower) -> Picture:
    """Sound power level by band: the total, and what is modelled of it."""
    at = np.arange(len(power.bands))
    total = np.array([band.total_db for band in power.bands], dtype=float)
    modelled = np.array([band.modelled_db for band in power.bands], dtype=float)

    def paint(axes: Axes) -> None:
        axes.bar(at, total, color="#cccccc", label=f"with the {power.rest}")
        axes.bar(at, modelled, width=0.45, color=COLOURS[3], label="modelled")
        known = [one for one in (*total, *modelled) if np.isfinite(one)]
        top = max(known, default=_RANGE_DB) + 3.0
        lowest = min(known, default=0.0) - 3.0
        axes.set_ylim(max(lowest, top - _RANGE_DB), top)
        third_octave_ticks(axes, [band.band_hz for band in power.bands])

    words = "Sound power level in third octaves: what is modelled, and with what stands beside it."
    figure = one_panel(2.4, paint, "Third octave, Hz", "Level, dB re 1 pW", columns=2, rows=1)
    return Picture("data_sheet", words, words, png(figure))
