"""Amplitudes and levels over frequency with their 90 % bands: inverted or predicted."""

import numpy as np
import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.titles import chosen
from ..charts.axes import level_axis, stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs
from ..file_names import numbered

_X = Axis("Frequency, Hz")
_FROM = "`blocked_forces`, command `blocked-forces`"


@needs("blocked_force", "blocked_force_low", from_=_FROM)
def blocked_force(blocked: xr.Dataset) -> Chart:
    """Amplitude of each blocked force with its 90 % band: a panel a point.

    Parameters
    ----------
    blocked : result of `blocked_forces`; needs `blocked_force`, `blocked_force_low`,
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


@needs("validation_measured", "validation_predicted", from_=_FROM)
def blocked_validation(blocked: xr.Dataset) -> Chart:
    """Levels by the blocked forces beside those measured, where no force is inverted from.

    Parameters
    ----------
    blocked : result of `blocked_forces`; needs `validation_measured`, `validation_predicted`,
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


@needs("predicted_level", "predicted_level_low", from_="`predict`, command `predict`")
def predicted_levels(predicted: xr.Dataset, receiver: str | None = None) -> Chart:
    """Level of each line as measured and after each change, with its 90 % band: a panel a change.

    Parameters
    ----------
    predicted : result of `predict`; needs `predicted_level`, `predicted_level_low`,
        `predicted_level_high` (option, receiver, frequency), dB
    receiver : one of the dataset's microphones; default: the first
    """
    name = str(chosen(predicted, "receiver", receiver))
    of_receiver = predicted.sel(receiver=name)
    level, frequency = of_receiver["predicted_level"], predicted["frequency"]
    y, measured = level_axis("Level, dB re 20 µPa", level), level.sel(option=REFERENCE_OPTION)
    before = Line(frequency, measured, "as measured", colour=COLOURS[0], dash="-")
    panels, changes = [], of_receiver.drop_sel(option=REFERENCE_OPTION)
    for option in map(str, changes["option"].values):
        changed = changes.sel(option=option)
        band = (changed["predicted_level_low"], changed["predicted_level_high"])
        levels = changed["predicted_level"]
        after = Line(frequency, levels, "after, 90 % band", band, COLOURS[1], "-")
        panels.append(Panel(_X, y, (before, after), shortened(f"{name}: {option}"), 2.4))
    return Chart(
        f"prediction_{dict(numbered(predicted, 'receiver'))[name]}",
        f"Levels at {name} before and after each change.",
        f"Levels of the lines at {name} as measured and after each change, with 90 % bands.",
        stacked(panels),
    )


def predicted_charts(predicted: xr.Dataset) -> list[Chart]:
    """Return levels before and after each change, a chart for each microphone."""
    return [predicted_levels(predicted, name) for name in predicted["receiver"].values]
