"""Levels before and after a change that was predicted from measurements alone."""

import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.titles import chosen
from ..charts.axes import level_axis, stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Panel
from ..charts.needs import needs
from ..file_names import numbered


@needs("predicted_level", "predicted_level_low", from_="`predict`, command `predict`")
def predicted_levels(predicted: xr.Dataset, receiver: str | None = None) -> Chart:
    """Level of each line as measured and after each change, with its 90 % band: a panel a change.

    Parameters
    ----------
    predicted : of `predict`; needs `predicted_level`, `predicted_level_low`,
        `predicted_level_high` (option, receiver, frequency), dB
    receiver : one of the dataset's microphones; default: the first
    """
    name = str(chosen(predicted, "receiver", receiver))
    of_receiver = predicted.sel(receiver=name)
    level, frequency = of_receiver["predicted_level"], predicted["frequency"]
    x, y = Axis("Frequency, Hz"), level_axis("Level, dB re 20 µPa", level)
    measured = level.sel(option=REFERENCE_OPTION)
    before = Line(frequency, measured, "as measured", colour=COLOURS[0], dash="-")
    panels = []
    for option in map(str, predicted["option"].values):
        if option == REFERENCE_OPTION:
            continue
        band = [of_receiver[f"predicted_level_{end}"].sel(option=option) for end in ("low", "high")]
        changed = level.sel(option=option)
        after = Line(frequency, changed, "after, 90 % band", (band[0], band[1]), COLOURS[1], "-")
        panels.append(Panel(x, y, (before, after), shortened(f"{name}: {option}"), 2.4))
    return Chart(
        f"prediction_{dict(numbered(predicted, 'receiver'))[name]}",
        f"Levels at {name} before and after each change.",
        f"Levels of the lines at {name} as measured and after each change, with 90 % bands.",
        stacked(panels),
    )


def predicted_charts(predicted: xr.Dataset) -> list[Chart]:
    """Return levels before and after each change, a chart for each microphone."""
    return [predicted_levels(predicted, name) for name in predicted["receiver"].values]
