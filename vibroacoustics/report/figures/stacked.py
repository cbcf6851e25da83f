"""A-weighted levels of the sources: parts of third octaves and lines, and over a run-up."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_power
from ...base.units import shaft_frequency_hz
from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import catalogue_receiver, source_name
from ...results.titles import chosen
from ..charts.axes import level_image
from ..charts.layout import COLOURS
from ..charts.marks import Axis, Bars, Chart, Line, Panel
from ..charts.needs import needs
from ..sections.sources.words import UNMODELLED

DEPTH_DB: Final = 40.0
"""Depth from the highest bar down to the foot of all."""
_THINNEST_DB: Final = 0.3
"""Sources without a longer part of any bar are not drawn."""
_GREY: Final = "#b8bfc6"


@needs("band_energy")
def stacked_third_octaves(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted third octaves, divided among sources and unmodelled noise: a panel an option.

    Parameters
    ----------
    results : results of `run`; needs `band_energy` (shown_option, energy_part, receiver,
        noise_band), Pa²
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    energy = results["band_energy"].sel(receiver=mic)
    energy = energy.transpose("shown_option", "energy_part", "noise_band")
    bands = energy["noise_band"].values
    words = (f"{band / 1000.0:g}k" if band >= 1000.0 else f"{band:g}" for band in bands)
    ticks = tuple((float(row), word) for row, word in enumerate(words) if row % 3 == 2)
    axis = Axis("Third-octave band, Hz", ticks=ticks)
    panels = _panels(results, energy, np.arange(len(bands), dtype=float), axis, 0.9)
    return _chart("stacked_third_octaves", f"third octaves at {mic}", results, panels)


@needs("line_energy")
def stacked_lines(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted lines of the shaft orders, divided among the sources: a panel an option.

    Parameters
    ----------
    results : results of `run`; needs `line_energy` (shown_option, sound_source, receiver, line),
        Pa²
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    energy = results["line_energy"].sel(receiver=mic)
    energy = energy.isel(line=np.flatnonzero(results["line_order"].values > 0.0))
    energy = energy.transpose("shown_option", "sound_source", "line")
    shaft_hz = shaft_frequency_hz(float(results["shown_speed"]))
    frequency = shaft_hz * energy["line_order"].values
    panels = _panels(results, energy, frequency, Axis("Frequency, Hz"), 0.8 * shaft_hz)
    return _chart("stacked_lines", f"lines of the shaft orders at {mic}", results, panels)


def divided(energy: Array, bottom_db: float) -> tuple[Array, Array]:
    """Return where the parts of each bar begin and how long they are, dB, from Pa², (part, bar).

    A bar is as high as the level of the sum; its parts are the shares of the sources in the
    energy, without those that work against the others.
    """
    total = np.maximum(energy.sum(axis=0), 1e-30)
    height = np.maximum(level_of_power(total / REFERENCE_PRESSURE_PA**2) - bottom_db, 0.0)
    share = np.maximum(energy, 0.0)
    share = share / np.maximum(share.sum(axis=0), 1e-30)
    ends = np.cumsum(share, axis=0) * height
    return bottom_db + ends - share * height, share * height


def part_colours(results: xr.Dataset, parts: Sequence[str]) -> list[tuple[str, str]]:
    """Return the words and the colour of each source, and of unmodelled noise."""
    sources = [str(source) for source in results["sound_source"].values]
    return [
        (source_name(results, part), COLOURS[1 + sources.index(part) % (len(COLOURS) - 1)])
        if part in sources
        else (UNMODELLED, _GREY)
        for part in parts
    ]


def _panels(
    results: xr.Dataset, energy: xr.DataArray, position: Array, axis: Axis, thickness: float
) -> tuple[Panel, ...]:
    """Bars of energy (option, part, bar), on one scale."""
    named = part_colours(results, [str(part) for part in energy[energy.dims[1]].values])
    loudest = max(float(energy.sum(str(energy.dims[1])).max()), 1e-30)
    top = float(level_of_power(loudest / REFERENCE_PRESSURE_PA**2))
    panels = []
    for option, values in zip(energy["shown_option"].values, energy.values, strict=True):
        starts, sizes = divided(values, top - DEPTH_DB)
        bars = tuple(
            Bars(position, size, start, words, colour=colour, thickness=thickness, upright=True)
            for (words, colour), start, size in zip(named, starts, sizes, strict=True)
            if size.max() > _THINNEST_DB
        )
        y = Axis("Level, dB(A)", limits=(top - DEPTH_DB, top + 2.0))
        panels.append(Panel(axis, y, bars, f"Option {option}", 2.4))
    return tuple(panels)


def _chart(name: str, what: str, results: xr.Dataset, panels: tuple[Panel, ...]) -> Chart:
    levels = f"A-weighted {what}, {float(results['shown_speed']):g} rpm"
    return Chart(
        name,
        f"{levels}, divided among the sources.",
        f"{levels}. The height of a bar is the level of the sum{_median(results)}. Its colours are "
        f"shares of the energy{_sample(results)}; sources that are not seen, or work against the "
        "others, are omitted.",
        panels,
    )


def _median(results: xr.Dataset) -> str:
    return ", the median of the samples" if "representative_value" in results else ""


def _sample(results: xr.Dataset) -> str:
    return " of the representative sample" if "representative_value" in results else ""


@needs("run_up_level", "run_up_source_level", from_="`run` of a study with few speeds")
def run_up_levels(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted levels of machine, sources and unmodelled noise over speed in a run-up.

    Parameters
    ----------
    results : results of `run`; needs `run_up_level` (run_up_speed, receiver), dB, and its parts
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    total = results["run_up_level"].sel(receiver=mic)
    speed, top = total["run_up_speed"].values, float(total.max())
    levels = results["run_up_source_level"].sel(receiver=mic)
    curves = {str(part): levels.sel(sound_source=part) for part in levels["sound_source"].values}
    curves["unmodelled"] = results["run_up_unmodelled_level"].sel(receiver=mic)
    shown = {part: level for part, level in curves.items() if level.max() > top - DEPTH_DB}
    parts = tuple(
        Line(speed, shown[part], words, colour=colour)
        for part, (words, colour) in zip(shown, part_colours(results, list(shown)), strict=True)
    )
    machine = Line(speed, total, "machine", colour="#000000", dash="-", width=2.4)
    y = Axis("Level, dB(A)", limits=(top - DEPTH_DB, top + 3.0))
    return Chart(
        "run_up_levels",
        f"A-weighted levels of the machine and its sources at {mic} over speed.",
        f"A-weighted levels at {mic} in a run-up, option {REFERENCE_OPTION}, of the representative "
        f"sample. Sources more than {DEPTH_DB:g} dB below the machine are not drawn.",
        (Panel(Axis("Speed, rpm"), y, (*parts, machine), height=3.0),),
    )


@needs("run_up_order_level", from_="`run` of a study with few speeds")
def run_up_orders(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted level of each order of all sources together over speed in a run-up, as colours.

    Parameters
    ----------
    results : results of `run`; needs `run_up_order_level` (run_up_speed, receiver, run_up_order),
        dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    level = results["run_up_order_level"].sel(receiver=mic)
    level = level.transpose("run_up_speed", "run_up_order")
    image = level_image(level["run_up_order"], level["run_up_speed"], level, "dB(A)", DEPTH_DB)
    return Chart(
        "run_up_orders",
        f"A-weighted level of each order at {mic} over speed.",
        f"A-weighted level of each order of all sources at {mic} in a run-up, option "
        f"{REFERENCE_OPTION}, of the representative sample; {DEPTH_DB:g} dB shown.",
        (Panel(Axis("Shaft order", integer=True), Axis("Speed, rpm"), (image,), height=3.0),),
    )
