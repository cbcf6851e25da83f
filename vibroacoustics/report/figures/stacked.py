"""A-weighted levels of the sources: parts of third octaves and lines, and over a run-up."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.vocabulary import REFERENCE_OPTION
from ...results.estimates import has_samples
from ...results.stored_study import catalogue_receiver, source_name
from ...results.titles import chosen
from ..charts.axes import level_image
from ..charts.layout import COLOURS
from ..charts.marks import Axis, Bars, Chart, Line, Panel
from ..charts.needs import needs
from ..sections.sources.words import UNMODELLED
from .paths import at_path_speed, path_speed

DEPTH_DB: Final = 40.0
"""Depth from the highest bar down to the foot of all."""
_THINNEST_DB: Final = 0.3
"""Sources without a longer part of any bar are not drawn."""
_GREY: Final = "#b8bfc6"


@needs("path_band_share")
def stacked_third_octaves(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """Third octaves of all modelled sources, divided among these; unmodelled noise beside them.

    Parameters
    ----------
    results : results of `run`; needs `path_band_share` (path_speed, path, receiver, band)
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    shown = at_path_speed(results, mic)
    bands, level = shown["band"].values, shown["modelled_band_level"].values
    words = (f"{band / 1000.0:g}k" if band >= 1000.0 else f"{band:g}" for band in bands)
    ticks = tuple((float(row), word) for row, word in enumerate(words) if row % 3 == 2)
    axis, position = Axis("Third-octave band, Hz", ticks=ticks), np.arange(len(bands), dtype=float)
    case = {"speed": path_speed(results), "option": REFERENCE_OPTION, "receiver": mic}
    noise = results["unmodelled_band_level"].sel(case).reindex(noise_band=bands).values
    share = shown["path_band_share"].transpose("path", "band")
    panel = _panel(results, share, level, position, axis, 0.9, Axis("Level, dB"), noise)
    return _chart("stacked_third_octaves", f"Third octaves at {mic}", results, panel)


@needs("path_order_share")
def stacked_lines(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted lines of the loudest shaft orders, divided among the sources.

    Parameters
    ----------
    results : results of `run`; needs `path_order_share` (path_speed, path, receiver, path_order)
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    share = at_path_speed(results, mic)["path_order_share"].transpose("path", "path_order")
    orders = share["path_order"].values
    case = {"speed": path_speed(results), "option": REFERENCE_OPTION, "receiver": mic}
    level = results["order_level"].sel(case).sel(weighting="A", order=orders).values
    axis, y = Axis("Order"), Axis("Level, dB(A)")
    panel = _panel(results, share, level, orders, axis, 0.8, y)
    return _chart(
        "stacked_lines", f"A-weighted lines of the loudest orders at {mic}", results, panel
    )


def divided(share: Array, level_db: Array, bottom_db: float) -> tuple[Array, Array]:
    """Return where the parts of each bar begin and how long they are, dB.

    A bar is as high as the level of the sum; its parts are the shares of the sources in the
    energy, without those that work against the others.

    Parameters
    ----------
    share : shares of the energy, shape (source, bar)
    level_db : levels of the sums, shape (bar,), dB
    bottom_db : foot of all bars
    """
    height, parts = np.maximum(level_db - bottom_db, 0.0), np.maximum(share, 0.0)
    parts = parts / np.maximum(parts.sum(axis=0), 1e-30)
    ends = np.cumsum(parts, axis=0) * height
    return bottom_db + ends - parts * height, parts * height


def part_colours(results: xr.Dataset, parts: Sequence[str]) -> list[tuple[str, str]]:
    """Return the words and the colour of each source, and of unmodelled noise."""
    sources = [str(source) for source in results["sound_source"].values]
    return [
        (source_name(results, part), COLOURS[1 + sources.index(part) % (len(COLOURS) - 1)])
        if part in sources
        else (UNMODELLED, _GREY)
        for part in parts
    ]


def _panel(
    results: xr.Dataset,
    share: xr.DataArray,
    level_db: Array,
    position: Array,
    axis: Axis,
    thickness: float,
    y: Axis,
    noise_db: Array | None = None,
) -> Panel:
    """Bars of the level of the sum, with the shares of the sources (path, bar) in it."""
    of_sources = share.groupby("path_source").sum()
    named = part_colours(results, [str(source) for source in of_sources["path_source"].values])
    top = float(np.max(level_db))
    shares, foot = of_sources.transpose("path_source", ...).values, top - DEPTH_DB
    starts, sizes = divided(shares, level_db, foot)
    bars = tuple(
        Bars(position, size, start, words, colour=colour, thickness=thickness, upright=True)
        for (words, colour), start, size in zip(named, starts, sizes, strict=True)
        if size.max() > _THINNEST_DB
    )
    noise: tuple[Line, ...] = ()
    if noise_db is not None and np.max(noise_db) > foot:
        levels = np.where(noise_db > foot, noise_db, np.nan)
        noise = (Line(position, levels, UNMODELLED, colour=_GREY),)
        top = max(top, float(np.max(noise_db)))
    return Panel(axis, replace(y, limits=(foot, top + 2.0)), (*bars, *noise), height=2.4)


def _chart(name: str, what: str, results: xr.Dataset, panel: Panel) -> Chart:
    levels = f"{what}, {path_speed(results):g} rpm, without a balancer"
    median, mean = (", a median", ", means") if has_samples(results) else ("", "")
    return Chart(
        name,
        f"{levels}, divided among the sources.",
        f"{levels}. The height of a bar is the level of all modelled sources{median}. Its colours "
        f"are shares of the energy{mean}. Sources that are not seen, or work against the others, "
        "are omitted.",
        (panel,),
    )


_BETWEEN: Final = (
    " With samples, levels at the study's speeds are medians; between them they follow one sample."
)


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
        f"A-weighted levels at {mic} in a run-up, option {REFERENCE_OPTION}.{_BETWEEN} Sources "
        f"more than {DEPTH_DB:g} dB below the machine are not drawn.",
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
        f"{REFERENCE_OPTION}; {DEPTH_DB:g} dB shown.{_BETWEEN}",
        (Panel(Axis("Shaft order", integer=True), Axis("Speed, rpm"), (image,), height=3.0),),
    )
