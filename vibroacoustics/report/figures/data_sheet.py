"""Third octaves of a data sheet: the machine and its modelled sources."""

import numpy as np
from matplotlib.axes import Axes

from ...results.data_sheet import SoundPower
from .panels import one_panel, third_octave_ticks
from .style import COLOURS, Picture, png

_RANGE_DB = 50.0


def sheet_picture(power: SoundPower) -> Picture:
    """Draw the sound power level by band: the machine and its modelled sources."""
    position = np.arange(len(power.bands))
    total = np.array([band.total_db for band in power.bands], dtype=float)
    modelled = np.array([band.modelled_db for band in power.bands], dtype=float)

    def paint(axes: Axes) -> None:
        axes.bar(position, total, color="#cccccc", label="machine")
        axes.bar(position, modelled, width=0.45, color=COLOURS[3], label="modelled sources")
        levels = [level for level in (*total, *modelled) if np.isfinite(level)]
        top = max(levels, default=_RANGE_DB) + 3.0
        lowest = min(levels, default=0.0) - 3.0
        axes.set_ylim(max(lowest, top - _RANGE_DB), top)
        third_octave_ticks(axes, [band.band_hz for band in power.bands])

    words = "Sound power level in third octaves: the machine and its modelled sources."
    figure = one_panel(2.4, paint, "Third octave, Hz", "Level, dB re 1 pW", columns=2, rows=1)
    return Picture("data_sheet", words, words, png(figure))
