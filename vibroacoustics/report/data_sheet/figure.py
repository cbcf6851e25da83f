"""Third octaves of a data sheet: what is modelled, and all."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ..figures.style import COLOURS, Picture, draw, legend_below, png
from .model import SoundPower

_RANGE_DB = 50.0


def sheet_picture(power: SoundPower) -> Picture:
    """Sound power level by band: the total, and what is modelled of it."""
    at = np.arange(len(power.bands))
    total = np.array([band.total_db for band in power.bands], dtype=float)
    modelled = np.array([band.modelled_db for band in power.bands], dtype=float)

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        axes.bar(at, total, color="#cccccc", label=f"with the {power.rest}")
        axes.bar(at, modelled, width=0.45, color=COLOURS[3], label="modelled")
        known = [one for one in (*total, *modelled) if np.isfinite(one)]
        top = max(known, default=_RANGE_DB) + 3.0
        lowest = min(known, default=0.0) - 3.0
        axes.set_ylim(max(lowest, top - _RANGE_DB), top)
        axes.set_xticks(at[::3], [f"{band.band_hz:g}" for band in power.bands[::3]])
        axes.set_xlabel("Third octave, Hz")
        axes.set_ylabel("Level, dB re 1 pW")
        legend_below(axes, 2)

    words = "Sound power level in third octaves: what is modelled, and with what stands beside it."
    return Picture("data_sheet", words, words, png(draw(1, 2.4, paint, 1)))
