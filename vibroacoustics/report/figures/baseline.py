"""The measured baseline with every option, by third octave."""

import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import options, speeds
from ...results.titles import chosen
from ..charts.axes import stacked
from ..charts.layout import wrapped
from ..charts.marks import Axis, Chart, Panel, frequency_axis, lines
from ..charts.needs import needs
from ..shown_speeds import few_speeds


@needs("baseline_band_level")
def baseline_third_octaves(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """Third octaves that were measured, and what each option makes of them, dB, unweighted.

    A panel a speed (six at most), a line an option.

    Parameters
    ----------
    results : of `run` with a measured baseline; needs `baseline_band_level` (speed, option,
        receiver, baseline_band), dB
    receiver : one of the results' microphones; default: the first with third octaves
    """
    microphone = chosen(results, "receiver", receiver or measured_receivers(results)[0])
    shown = few_speeds(results)
    level = shown["baseline_band_level"].sel(receiver=microphone)
    level = level.isel(baseline_band=level.notnull().any(["speed", "option"]).values)
    names = options(shown)
    words = ["measured" if name == REFERENCE_OPTION else wrapped(name, 24) for name in names]
    band = level["baseline_band"].values
    x, y = frequency_axis("Third-octave band, Hz", band), Axis("Level, dB re 20 µPa")
    panels = (
        Panel(x, y, lines(band, zip(words, curves, strict=True), "o"), f"{speed:g} rpm")
        for speed in speeds(shown)
        for curves in [(level.sel(option=name, speed=speed).values for name in names)]
    )
    return Chart(
        "baseline_third_octaves",
        f"Third-octave levels at {microphone}: measured without a balancer, and with every option "
        "by the modelled change.",
        f"Third octaves at {microphone}, unweighted: as measured, and what each option makes of "
        "them. Where an option's line lies on the measured one it changes nothing there.",
        stacked(panels),
    )


def measured_receivers(results: xr.Dataset) -> list[str]:
    """Return microphones whose third octaves were measured; all of them where none has any."""
    has_any = results["baseline_band_level"].notnull().any(["speed", "option", "baseline_band"])
    names = [str(name) for name in results["receiver"].values]
    measured = [name for name, has in zip(names, has_any.values, strict=True) if has]
    return measured or names
