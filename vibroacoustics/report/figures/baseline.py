"""The measured baseline with every option, by third octave."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import options, speeds
from ..charts.needs import needs
from ..shown_speeds import few_speeds
from ..titles import chosen
from .panels import each_panel, in_rpm, third_octaves
from .style import Picture, png, wrap


@needs("baseline_band_level")
def baseline_third_octaves(results: xr.Dataset, receiver: str | None = None) -> Figure:
    """Third octaves that were measured, and what each option makes of them, dB, unweighted.

    A panel a speed (six at most), a line an option.

    Parameters
    ----------
    results : of `run` with a measured baseline; needs `baseline_band_level` (speed, option,
        receiver, baseline_band), dB
    receiver : one of the results' microphones; default: the first with third octaves

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.baseline_third_octaves(results).savefig("baseline.png")
    """
    at = chosen(results, "receiver", receiver or measured_receivers(results)[0])
    shown = few_speeds(results)
    level = shown["baseline_band_level"].sel(receiver=at)
    level = level.isel(baseline_band=level.notnull().any(["speed", "option"]).values)
    names = options(shown)
    words = ["measured" if name == REFERENCE_OPTION else wrap(name, 24) for name in names]

    def paint(axes: Axes, speed: float) -> None:
        curves = (level.sel(option=name, speed=speed).values for name in names)
        third_octaves(axes, level["baseline_band"].values, words, curves)

    return each_panel(
        speeds(shown), 2.4, paint, "Third-octave band, Hz", "Level, dB re 20 µPa", in_rpm,
        columns=2, rows=(len(names) + 1) // 2, sharex=True,
    )  # fmt: skip


def measured_receivers(results: xr.Dataset) -> list[str]:
    """Microphones whose third octaves were measured; all of them where none has any."""
    there = results["baseline_band_level"].notnull().any(["speed", "option", "baseline_band"])
    names = [str(name) for name in results["receiver"].values]
    measured = [name for name, known in zip(names, there.values.tolist(), strict=True) if known]
    return measured or names


def baseline_figures(results: xr.Dataset) -> list[Picture]:
    """Third octaves at the first microphone that was measured; none where there are none."""
    if not np.isfinite(results["baseline_band_level"]).any():
        return []
    receiver = measured_receivers(results)[0]
    return [
        Picture(
            "baseline_third_octaves",
            f"Third-octave levels at {receiver}: measured without a balancer, and with every "
            "option by the modelled change.",
            f"Third octaves at {receiver}, unweighted: as measured, and what each option makes of "
            "them. Where an option's line lies on the measured one it changes nothing there.",
            png(baseline_third_octaves(results)),
        )
    ]
