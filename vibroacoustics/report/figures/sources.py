"""Third-octave spectra of the sources of sound, and of the options that change them."""

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.arrays import Array
from ...base.remembered import remembered
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import a_weighting
from ...results.estimates import has_samples
from ...results.stored_study import (
    balancers,
    catalogue_receiver,
    has_sources,
    quoted_speed,
    source_name,
    speeds,
)
from ..charts.needs import needs
from ..quantities import HEARD_DB
from ..shown_speeds import few_speeds
from ..titles import chosen
from .panels import each_panel, in_rpm, one_panel, third_octaves
from .style import Picture, png, wrap

QUIETEST_DB: Final = -10.0
"""Levels below are not drawn."""
WITHIN_DB: Final = 20.0
"""Bands that lie further below the loudest one do not decide whether options differ."""


def source_figures(results: xr.Dataset) -> list[Picture]:
    """Spectra of the sources without a balancer, and of the machine with options that change it."""
    if not has_sources(results):
        return []
    pictures = [_sources(results)]
    changing = _changing_options(results) if "total_band_level" in results else []
    return [*pictures, _options(results, changing)] if changing else pictures


@needs("source_band_level")
def source_third_octaves(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    speed_rpm: float | None = None,
) -> Figure:
    """Third-octave levels of each source alone, dB, unweighted.

    Parameters
    ----------
    results : of `run`; needs `source_band_level` (speed, option, sound_source, receiver, band), dB
    receiver : one of the microphones; default: that of the catalogue's noise
    option : one of the results
    speed_rpm : one of the results; default: that of the catalogue's noise

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver, option or speed.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.source_third_octaves(results).savefig("source_third_octaves.png")
    """
    spectra = _spectra(results, receiver, option, speed_rpm)
    shown = _loud(spectra)

    def paint(axes: Axes) -> None:
        curves = (spectra.sel(sound_source=source).values for source in shown)
        names = [source_name(results, source) for source in shown]
        _curves(axes, spectra["band"].values, names, curves)

    y = "Level, dB re 20 µPa, unweighted"
    return one_panel(3.0, paint, "Third-octave band, Hz", y, columns=1, rows=len(shown))


def _spectra(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    speed_rpm: float | None = None,
) -> xr.DataArray:
    """Levels at a microphone and speed, by default the quoted ones, (sound_source, band), dB."""
    return results["source_band_level"].sel(
        option=chosen(results, "option", option),
        receiver=chosen(results, "receiver", receiver or catalogue_receiver(results)),
        speed=chosen(results, "speed", speed_rpm or quoted_speed(results)),
    )


def _loud(spectra: xr.DataArray) -> list[str]:
    """Sources that are drawn."""
    return [
        str(source)
        for source in spectra["sound_source"].values
        if spectra.sel(sound_source=source).max() > QUIETEST_DB
    ]


def _sources(results: xr.Dataset) -> Picture:
    receiver, speed = catalogue_receiver(results), quoted_speed(results)
    spectra = _spectra(results)
    shown = _loud(spectra)
    silent = [
        source_name(results, str(s)) for s in spectra["sound_source"].values if str(s) not in shown
    ]
    below = (
        f" Not drawn, everywhere below {QUIETEST_DB:g} dB: {', '.join(silent)}." if silent else ""
    )
    return Picture(
        "sources_third_octaves",
        f"Third-octave levels of each source at {receiver} and {speed:g} rpm without a balancer, "
        f"20 Hz to {spectra['band'].values[-1]:g} Hz.",
        f"Each source alone at {receiver}, {speed:g} rpm, without a balancer"
        f"{_medians(results)}, unweighted.{below.replace('-', '−')}",
        png(source_third_octaves(results)),
    )


@needs("total_band_level")
def option_third_octaves(results: xr.Dataset) -> Figure:
    """A-weighted third-octave levels of the machine, dB.

    A panel a speed (six at most), a line an option. Of the options
    those are drawn that change a loud band by more than can be heard, and `none`.

    Parameters
    ----------
    results : of `run`; needs `total_band_level` (speed, option, receiver, noise_band), dB

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.option_third_octaves(results).savefig("option_third_octaves.png")
    """
    names = [REFERENCE_OPTION, *_changing_options(results)]
    shown = few_speeds(results)
    level = _weighted(shown)

    def paint(axes: Axes, speed: float) -> None:
        curves = (level.sel(option=name, speed=speed).values for name in names)
        _curves(axes, level["noise_band"].values, [wrap(name, 24) for name in names], curves)

    return each_panel(
        speeds(shown), 2.4, paint, "Third-octave band, Hz", "Level, dB(A)", in_rpm,
        columns=2, rows=(len(names) + 1) // 2, sharex=True,
    )  # fmt: skip


def _options(results: xr.Dataset, changing: list[str]) -> Picture:
    receiver, names = catalogue_receiver(results), [REFERENCE_OPTION, *changing]
    return Picture(
        "sources_options",
        f"A-weighted third-octave levels at {receiver} for {', '.join(names)}.",
        f"A-weighted third octaves at {receiver}{_medians(results)}: options that change a band "
        f"within {WITHIN_DB:g} dB of the loudest by more than {HEARD_DB:g} dB.",
        png(option_third_octaves(results)),
    )


def _curves(axes: Axes, band_hz: Array, names: Sequence[str], curves: Iterable[Array]) -> None:
    audible = (np.where(curve > QUIETEST_DB, curve, np.nan) for curve in curves)
    third_octaves(axes, band_hz, names, audible)
    axes.set_ylim(bottom=QUIETEST_DB)
    axes.set_xlim(band_hz[0] / 1.12, band_hz[-1] * 1.12)


def _changing_options(results: xr.Dataset) -> list[str]:
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
