"""Blocked forces with their bands, and their on-board validation."""

import numpy as np
import xarray as xr

from ..charts.axes import level_axis, stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs

_FROM = "`blocked_forces`, command `blocked-forces`"


@needs("blocked_force", "blocked_force_low", from_=_FROM)
def blocked_force(blocked: xr.Dataset) -> Chart:
    """Amplitude of each blocked force with its 90 % band: a panel a point.

    Parameters
    ----------
    blocked : of `blocked_forces`; needs `blocked_force`, `blocked_force_low`,
        `blocked_force_high` (force_point, frequency), N
    """
    panels = []
    for point in map(str, blocked["force_point"].values):
        of_point = blocked.sel(force_point=point)
        amplitude = np.abs(of_point["blocked_force"].values)
        low = np.maximum(of_point["blocked_force_low"], 0.1 * max(amplitude.min(), 1e-9))
        band = (low, of_point["blocked_force_high"])
        line = Line(blocked["frequency"], amplitude, "", band, COLOURS[1], "-")
        panels.append(Panel(_X, Axis("Force, N", "log"), (line,), shortened(point), 2.2))
    return Chart(
        "blocked_forces",
        "Blocked forces with their 90 % bands.",
        "Amplitudes of the blocked forces with their 90 % bands.",
        stacked(panels),
    )


_X = Axis("Frequency, Hz")


@needs("validation_measured", "validation_predicted", from_=_FROM)
def blocked_validation(blocked: xr.Dataset) -> Chart:
    """Levels by the blocked forces beside those measured, where no force is inverted from.

    Parameters
    ----------
    blocked : of `blocked_forces`; needs `validation_measured`, `validation_predicted`,
        `validation_predicted_low`, `validation_predicted_high` (validation_point, frequency), dB
    """
    panels = []
    for point in map(str, blocked["validation_point"].values):
        of_point = blocked.sel(validation_point=point)
        is_sound = of_point["validation_quantity"].item() == "sound pressure"
        measured, frequency = of_point["validation_measured"], blocked["frequency"]
        y = level_axis(f"Level, dB re {'20 µPa' if is_sound else '1 µm/s²'}", measured)
        band = (of_point["validation_predicted_low"], of_point["validation_predicted_high"])
        predicted, words = of_point["validation_predicted"], "by the blocked forces, 90 % band"
        marks = (
            Line(frequency, measured, "measured", colour=COLOURS[0], dash="-"),
            Line(frequency, predicted, words, band, COLOURS[1], "--"),
        )
        panels.append(Panel(_X, y, marks, shortened(point), 2.4))
    return Chart(
        "validation",
        "Levels by the blocked forces and as measured.",
        "Levels where no force is inverted from: by the blocked forces and as measured.",
        stacked(panels),
    )


def blocked_charts(blocked: xr.Dataset) -> list[Chart]:
    """Return the forces and their validation."""
    return [blocked_force(blocked), blocked_validation(blocked)]
