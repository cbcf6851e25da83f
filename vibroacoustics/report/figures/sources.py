"""Third-octave spectra of the sources of sound, and of the options that change them."""

from collections.abc import Iterable
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.remembered import remembered
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import a_weighting
from ...results.estimates import has_samples
from ...results.stored_study import (
    balancers,
    catalogue_receiver,
    quoted_speed,
    source_name,
    speeds,
)
from ...results.titles import chosen
from ..charts.layout import wrapped
from ..charts.marks import Axis, Chart, Panel, frequency_axis, lines
from ..charts.needs import needs
from ..quantities import HEARD_DB
from ..shown_speeds import few_speeds

QUIETEST_DB: Final = -10.0
"""Levels below are not drawn."""
WITHIN_DB: Final = 20.0
"""Bands that lie further below the loudest one do not decide whether options differ."""


@needs("source_band_level")
def source_third_octaves(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    speed_rpm: float | None = None,
) -> Chart:
    """Third-octave levels of each source alone, dB, unweighted.

    Parameters
    ----------
    results : of `run`; needs `source_band_level` (speed, option, sound_source, receiver, band), dB
    receiver : one of the microphones; default: that of the catalogue's noise
    option : one of the results
    speed_rpm : one of the results; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    speed = chosen(results, "speed", speed_rpm or quoted_speed(results))
    case = {"option": chosen(results, "option", option), "receiver": mic, "speed": speed}
    spectra = results["source_band_level"].sel(case).transpose("sound_source", "band")
    named = {
        source_name(results, str(level["sound_source"].item())): level.values for level in spectra
    }
    loud = {name: level for name, level in named.items() if level.max() > QUIETEST_DB}
    silent = ", ".join(name for name in named if name not in loud)
    below = f" Not drawn, everywhere below −{-QUIETEST_DB:g} dB: {silent}." if silent else ""
    bands = spectra["band"].values
    y = "Level, dB re 20 µPa, unweighted"
    whose = "without a balancer" if option == REFERENCE_OPTION else f"with {option}"
    return Chart(
        "sources_third_octaves",
        f"Third-octave levels of each source at {mic} and {speed:g} rpm {whose}, 20 Hz to "
        f"{bands[-1]:g} Hz.",
        f"Each source alone at {mic}, {speed:g} rpm, {whose}{_medians(results)}, unweighted."
        f"{below}",
        (_panel(bands, loud.items(), y, height=3.0),),
    )


@needs("total_band_level")
def option_third_octaves(results: xr.Dataset) -> Chart:
    """A-weighted third-octave levels of the machine, dB.

    A panel a speed (six at most), a line an option. Of the options
    those are drawn that change a loud band by more than can be heard, and `none`.

    Parameters
    ----------
    results : of `run`; needs `total_band_level` (speed, option, receiver, noise_band), dB
    """
    names = [REFERENCE_OPTION, *changing_options(results)]
    shown = few_speeds(results)
    level = _weighted(shown).sel(option=names).transpose("speed", "option", "noise_band")
    labels, bands = [wrapped(name, 24) for name in names], level["noise_band"].values
    panels = (
        _panel(bands, zip(labels, level.sel(speed=speed).values, strict=True), "Level, dB(A)",
               f"{speed:g} rpm")
        for speed in speeds(shown)
    )  # fmt: skip
    mic = catalogue_receiver(results)
    return Chart(
        "sources_options",
        f"A-weighted third-octave levels at {mic} for {', '.join(names)}.",
        f"A-weighted third octaves at {mic}{_medians(results)}: options that change a band within "
        f"{WITHIN_DB:g} dB of the loudest by more than {HEARD_DB:g} dB.",
        tuple(panels),
    )


def _panel(
    band_hz: Array, named: Iterable[tuple[str, Array]], y: str, title: str = "", height: float = 2.4
) -> Panel:
    audible = ((name, np.where(curve > QUIETEST_DB, curve, np.nan)) for name, curve in named)
    x = frequency_axis("Third-octave band, Hz", band_hz)
    return Panel(
        x, Axis(y, limits=(QUIETEST_DB, None)), lines(band_hz, audible, "o"), title, height
    )


def changing_options(results: xr.Dataset) -> list[str]:
    """Options that change a loud band of the sources by what can be heard."""
    level = _weighted(results)
    reference = level.sel(option=REFERENCE_OPTION)
    loudest = reference.max("noise_band")
    changing = []
    for option in balancers(results):
        of_option = level.sel(option=option)
        loud = (of_option > loudest - WITHIN_DB) | (reference > loudest - WITHIN_DB)
        if (abs(of_option - reference).where(loud, 0.0) > HEARD_DB).any():
            changing.append(option)
    return changing


@remembered
def _weighted(results: xr.Dataset) -> xr.DataArray:
    """A-weighted third octaves of the machine at the published microphone, dB."""
    levels = results["total_band_level"].sel(receiver=catalogue_receiver(results))
    return levels + xr.DataArray(a_weighting(levels["noise_band"].values), dims="noise_band")


def _medians(results: xr.Dataset) -> str:
    return ", medians" if has_samples(results) else ""
