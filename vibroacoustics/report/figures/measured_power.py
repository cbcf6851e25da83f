"""Sound power in third octaves from recorded microphones."""

import numpy as np
import xarray as xr

from ..charts.axes import band_axis
from ..charts.layout import COLOURS
from ..charts.marks import Axis, Bars, Chart, Panel, Points


def power_chart(measured: xr.Dataset) -> Chart:
    """Return the sound power level by band, beside what it would be without corrections."""
    number, level = np.arange(measured.sizes["band"]), measured["measured_power_level"].values
    corrections = measured["background_correction"] + measured["environment_correction"]
    uncorrected = level + corrections.values
    bottom = max(float(np.nanmin(uncorrected)) - 10.0, 0.0)
    y = Axis("Level, dB re 1 pW", limits=(bottom, float(np.nanmax(uncorrected)) + 3.0))
    marks = (
        Bars(number, level - bottom, bottom, "L_W", colour=COLOURS[6], upright=True),
        Points(number, uncorrected, "without K1 and K2", None, COLOURS[3], "o", filled=False),
    )
    words = "Sound power level in third octaves."
    panel = Panel(band_axis(measured["band"].values.tolist()), y, marks, height=2.8)
    return Chart("sound_power", words, words, (panel,))
