"""Sound power in third octaves from recorded microphones."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .style import COLOURS, Picture, draw, legend_below, png


def power_picture(measured: xr.Dataset) -> Picture:
    """Sound power level by band, beside what it would be without corrections."""
    bands = measured["band"].values
    at = np.arange(bands.size)
    level = measured["measured_power_level"].values
    corrections = measured["background_correction"] + measured["environment_correction"]

    def paint(panels: Sequence[Axes]) -> None:
        (axes,) = panels
        uncorrected = level + corrections.values
        axes.plot(at, uncorrected, "o", mfc="none", color=COLOURS[3], label="without K1 and K2")
        axes.bar(at, level, color=COLOURS[6], label="L_W")
        known = uncorrected[np.isfinite(uncorrected)]
        axes.set_ylim(max(known.min() - 10.0, 0.0), known.max() + 3.0)
        axes.set_xticks(at[::3], [f"{band:g}" for band in bands[::3]])
        axes.set_xlabel("Third octave, Hz")
        axes.set_ylabel("Level, dB re 1 pW")
        legend_below(axes, 2)

    words = "Sound power level in third octaves."
    return Picture("sound_power", words, words, png(draw(1, 2.6, paint, 1)))
