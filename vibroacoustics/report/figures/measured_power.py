"""Sound power in third octaves from recorded microphones."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .panels import one_panel, third_octave_ticks
from .style import COLOURS, Picture, png


def power_picture(measured: xr.Dataset) -> Picture:
    """Sound power level by band, beside what it would be without corrections."""
    bands = measured["band"].values
    at = np.arange(bands.size)
    level = measured["measured_power_level"].values
    corrections = measured["background_correction"] + measured["environment_correction"]

    def paint(axes: Axes) -> None:
        uncorrected = level + corrections.values
        axes.plot(at, uncorrected, "o", mfc="none", color=COLOURS[3], label="without K1 and K2")
        axes.bar(at, level, color=COLOURS[6], label="L_W")
        known = uncorrected[np.isfinite(uncorrected)]
        axes.set_ylim(max(known.min() - 10.0, 0.0), known.max() + 3.0)
        third_octave_ticks(axes, bands)

    words = "Sound power level in third octaves."
    figure = one_panel(2.6, paint, "Third octave, Hz", "Level, dB re 1 pW", columns=2, rows=1)
    return Picture("sound_power", words, words, png(figure))
