"""Third octaves of a data sheet: the machine and its modelled sources."""

import numpy as np

from ...results.data_sheet import SoundPower
from ..charts.axes import band_axis, level_axis
from ..charts.layout import COLOURS
from ..charts.marks import Bars, Chart, Panel

_RANGE_DB = 50.0


def sheet_chart(power: SoundPower) -> Chart:
    """Return the sound power level by band: the machine and its modelled sources."""
    number = np.arange(len(power.bands))
    total = np.array([band.total_db for band in power.bands], dtype=float)
    modelled = np.array([band.modelled_db for band in power.bands], dtype=float)
    y = level_axis("Level, dB re 1 pW", [*total, *modelled], _RANGE_DB)
    base = -200.0 if y.limits is None else y.limits[0] or 0.0
    marks = (
        Bars(number, total - base, base, "machine", colour="#cccccc", upright=True),
        Bars(
            number, modelled - base, base, "modelled sources", None, COLOURS[3], 0.45, upright=True
        ),
    )
    words = "Sound power level in third octaves: the machine and its modelled sources."
    panel = Panel(band_axis([band.band_hz for band in power.bands]), y, marks, height=2.6)
    return Chart("data_sheet", words, words, (panel,))
