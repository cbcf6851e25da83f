"""Levels before and after a change that was predicted from measurements alone."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.vocabulary import REFERENCE_OPTION
from ..charts.needs import needs
from ..titles import chosen
from .panels import band, each_panel
from .style import COLOURS, Picture, numbered, png, shortened

_RANGE_DB = 80.0


@needs("predicted_level", "predicted_level_low", from_="`predict`, command `predict`")
def predicted_levels(predicted: xr.Dataset, receiver: str | None = None) -> Figure:
    """Level of each line as measured and after each change, with its 90 % band: a panel a change.

    Parameters
    ----------
    predicted : of `predict`; needs `predicted_level`, `predicted_level_low`,
        `predicted_level_high` (option, receiver, frequency), dB
    receiver : one of the dataset's microphones; default: the first

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such microphone.

    Examples
    --------
    >>> predicted = va.open_results("prediction.nc")
    >>> va.plot.predicted_levels(predicted).savefig("predicted.png")
    """
    name = chosen(predicted, "receiver", receiver)
    at = predicted.sel(receiver=name)
    before = at["predicted_level"].sel(option=REFERENCE_OPTION)
    options = [str(option) for option in at["option"].values if option != REFERENCE_OPTION]
    frequency = at["frequency"].values
    top = float(at["predicted_level"].max()) + 5.0

    def paint(axes: Axes, option: str) -> None:
        after = at.sel(option=option)
        low, high = after["predicted_level_low"], after["predicted_level_high"]
        band(axes, frequency, np.maximum(low, top - _RANGE_DB), high)
        axes.plot(frequency, before, color=COLOURS[0], label="as measured")
        axes.plot(frequency, after["predicted_level"], color=COLOURS[1], label="after")
        axes.set_ylim(top - _RANGE_DB, top)

    return each_panel(
        options, 2.2, paint, "Frequency, Hz", "Level, dB re 20 µPa",
        lambda option: shortened(f"{name}: {option}"), columns=3, rows=1,
    )  # fmt: skip


def predicted_figures(predicted: xr.Dataset) -> list[Picture]:
    """For each microphone: levels before and after each change."""
    return [
        Picture(
            f"prediction_{file}",
            f"Levels at {name} before and after each change.",
            f"Levels of the lines at {name} as measured and after each change, with 90 % bands.",
            png(predicted_levels(predicted, name)),
        )
        for name, file in numbered(predicted, "receiver")
    ]
