"""Third octaves: of the sources, the options, the measured baseline, of a sound power."""

from collections.abc import Iterable
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.remembered import remembered
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import a_weighting
from ...results.data_sheet import SoundPower
from ...results.estimates import has_samples
from ...results.stored_study import (
    balancers,
    catalogue_receiver,
    nearest_speed,
    options,
    source_name,
    speeds,
)
from ...results.titles import chosen
from ..charts.axes import band_axis, level_axis, stacked
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import Axis, Bars, Chart, Panel, Points, frequency_axis, lines
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
    results : results of `run`; needs `source_band_level` (speed, option, sound_source, receiver,
        band), dB
    receiver : one of the microphones; default: that of the catalogue's noise
    option : one of the results
    speed_rpm : one of the results; default: the nearest to that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    speed = chosen(results, "speed", speed_rpm or nearest_speed(results))
    case = {"option": chosen(results, "option", option), "receiver": mic, "speed": speed}
    spectra = results["source_band_level"].sel(case).transpose("sound_source", "band")
    sources = [source_name(results, str(name)) for name in spectra["sound_source"].values]
    named = dict(zip(sources, spectra.values, strict=True))
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
    results : results of `run`; needs `total_band_level` (speed, option, receiver, noise_band), dB
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
    axes = (frequency_axis("Third-octave band, Hz", band_hz), Axis(y, limits=(QUIETEST_DB, None)))
    return Panel(*axes, lines(band_hz, audible, "o"), title, height)


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


@needs("baseline_band_level")
def baseline_third_octaves(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """Third octaves that were measured, and what each option makes of them, dB, unweighted.

    A panel a speed (six at most), a line an option.

    Parameters
    ----------
    results : results of `run` with a measured baseline; needs `baseline_band_level` (speed, option,
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
    measured = has_any.values if has_any.any() else ...
    return [str(name) for name in results["receiver"].values[measured]]


_RANGE_DB = 50.0


def sheet_chart(power: SoundPower) -> Chart:
    """Return the sound power level by band: the machine and its modelled sources."""
    number = np.arange(len(power.bands))
    total = np.array([band.total_db for band in power.bands], dtype=float)
    modelled = np.array([band.modelled_db for band in power.bands], dtype=float)
    y = level_axis("Level, dB re 1 pW", [*total, *modelled], _RANGE_DB)
    base = -200.0 if y.limits is None else y.limits[0] or 0.0
    marks = (
        Bars(number, total - base, base, "machine", None, "#cccccc", 0.8, True),
        Bars(number, modelled - base, base, "modelled sources", None, COLOURS[3], 0.45, True),
    )
    words = "Sound power level in third octaves: the machine and its modelled sources."
    panel = Panel(band_axis([band.band_hz for band in power.bands]), y, marks, height=2.6)
    return Chart("data_sheet", words, words, (panel,))


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
