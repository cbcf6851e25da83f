"""Levels before and after a change that was predicted from measurements alone."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.vocabulary import REFERENCE_OPTION
from ..titles import chosen
from .needs import needs
from .style import COLOURS, Picture, draw, legend_below, numbered_file_name, png, shortened

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

    def paint(panels: Sequence[Axes]) -> None:
        for axes, option in zip(panels, options, strict=True):
            after = at.sel(option=option)
            low, high = after["predicted_level_low"], after["predicted_level_high"]
            axes.fill_between(
                frequency, np.maximum(low, top - _RANGE_DB), high, color=COLOURS[1], alpha=0.3,
                linewidth=0.0, label="90 % band",
            )  # fmt: skip
            axes.plot(frequency, before, color=COLOURS[0], label="as measured")
            axes.plot(frequency, after["predicted_level"], color=COLOURS[1], label="after")
            axes.set_ylim(top - _RANGE_DB, top)
            axes.set_ylabel("Level, dB re 20 µPa")
            axes.set_title(shortened(f"{name}: {option}"), loc="left")
        panels[-1].set_xlabel("Frequency, Hz")
        legend_below(panels[-1], 3)

    return draw(len(options), 2.2, paint, 1)


def predicted_figures(predicted: xr.Dataset) -> list[Picture]:
    """For each microphone: levels before and after each change."""
    return [
        Picture(
            f"prediction_{numbered_file_name(number, name)}",
            f"Levels at {name} before and after each change.",
            f"Levels of the lines at {name} as measured and after each change, with 90 % bands.",
            png(predicted_levels(predicted, name)),
        )
        for number, name in enumerate(map(str, predicted["receiver"].values), 1)
    ]
