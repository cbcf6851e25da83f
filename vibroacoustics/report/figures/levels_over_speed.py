"""Levels over the speed, in total and by source, with bands and speeds to avoid."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base.rounding import LEVEL_FLOOR_DB
from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.avoid import LEVEL, Range, recorded_speeds_to_avoid, speeds_to_avoid
from ...results.over_speed.level_curves import (
    LevelCurve,
    is_run_up,
    option_curves,
    recorded_curves,
    source_curves,
)
from ...results.stored_study import catalogue_receiver
from ..charts.needs import needs
from ..titles import chosen, titled
from .panels import each_panel, one_panel
from .style import WIDTH_INCH, line_looks, shade, shortened, wrap

_FEW_POINTS: Final = 12
_RANGE_DB: Final = 60.0
"""Levels further below the highest are not drawn."""
Panels = dict[str, list[LevelCurve]]


@needs(
    "level_total", "block_level", any_of=True,
    from_="`run`, or `speed_frequency_map` of a channel of sound pressure",
)  # fmt: skip
def levels_over_speed(
    results: xr.Dataset,
    receiver: str | None = None,
    options: Sequence[str] = (),
    beside: xr.Dataset | None = None,
    beside_options: Sequence[str] = (),
    width_inch: float = WIDTH_INCH,
) -> Figure:
    """A-weighted level over the speed, total and modelled: a line an option, of one its band.

    Of a recording a line a weighting. Speeds to avoid are shaded. A recording without a run-up is
    drawn over the time.

    Parameters
    ----------
    results : of `run`, needs `level_total` (speed, option, receiver), dB; or of
        `speed_frequency_map`, needs `block_level` (channel, block, weighting), dB
    receiver : microphone or channel of sound pressure; default: that of the catalogue's noise, or
        the first
    options : of a study, the first with its band; default: the first eight
    beside : other results, whose lines are dashed
    beside_options : options of these
    width_inch : of the figure

    Raises
    ------
    ParameterError
        The dataset holds none, or there is no such receiver or option.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.levels_over_speed(results).savefig("levels_over_speed.png")
    >>> mapped = va.open_results("speed_map.nc")
    >>> va.plot.levels_over_speed(mapped).savefig("run_up.png")
    """
    panels, xlabel = _curves(results, receiver, options)
    solid = {title: len(curves) for title, curves in panels.items()}
    if beside is not None:
        panels = {title: _lettered("A", curves) for title, curves in panels.items()}
        beside = titled(beside)
        others, _ = _curves(beside, receiver if _has(beside, receiver) else None, beside_options)
        panels = {title: [*curves, *_like(others, title)] for title, curves in panels.items()}
    shaded = _shaded(results, receiver, options)

    def paint(axes: Axes, title: str) -> None:
        _panel(axes, panels[title], solid[title])
        for span in shaded:
            shade(axes, span.from_rpm, span.to_rpm)

    columns = 4 if width_inch > WIDTH_INCH else 2
    rows = -(-max(len(curves) for curves in panels.values()) // columns)
    y = "Level, dB(A)" if "level_total" in results else "Level, dB re 20 µPa"
    return each_panel(
        list(panels), 2.3, paint, xlabel, y, lambda title: shortened(title, 60), columns, rows,
        width_inch, sharex=True,
    )  # fmt: skip


@needs("source_level")
def source_levels_over_speed(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    width_inch: float = WIDTH_INCH,
) -> Figure:
    """A-weighted level of each source alone over the speed, with its band, and of all of them.

    Parameters
    ----------
    results : of `run`; needs `source_level` (speed, option, sound_source, receiver), dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    option : one of the results
    width_inch : of the figure

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver or option.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.source_levels_over_speed(results).savefig("sources_over_speed.png")
    """
    option = chosen(results, "option", option)
    curves = source_curves(results, receiver, option)
    (modelled,) = option_curves(results, "level_modelled", receiver, [option])
    every = [modelled._replace(label="all modelled", band_db=None), *curves]
    audible = [curve for curve in every if curve.level_db.max() > LEVEL_FLOOR_DB]
    shaded = [
        one.range for one in speeds_to_avoid(results, receiver, [option]) if one.quantity == LEVEL
    ]

    def paint(axes: Axes) -> None:
        _panel(axes, audible, len(audible))
        for span in shaded:
            shade(axes, span.from_rpm, span.to_rpm)

    columns = 3 if width_inch > WIDTH_INCH else 1
    title = f"Each source alone, option {shortened(option, 30)}"
    rows = -(-len(audible) // columns)
    return one_panel(2.8, paint, "Speed, rpm", "Level, dB(A)", title, columns, rows, width_inch)


def _curves(
    results: xr.Dataset, receiver: str | None, options: Sequence[str]
) -> tuple[Panels, str]:
    """Curves by title of their panel, and what they are drawn over."""
    if "level_total" in results:
        at = receiver or catalogue_receiver(results)
        return {
            f"{words} at {at}": option_curves(results, name, receiver, options)
            for words, name in (("Total", "level_total"), ("Modelled sources", "level_modelled"))
        }, "Speed, rpm"
    curves = recorded_curves(results, receiver)
    title = receiver or str(results["channel"].values[results["channel_unit"].values == "Pa"][0])
    if is_run_up(results["block_speed"]):
        return {title: curves}, "Speed, rpm"
    seconds = results.sortby("block_speed")["block_time"].values
    order = np.argsort(seconds)
    return {
        title: [LevelCurve(c.label, seconds[order], c.level_db[order]) for c in curves]
    }, "Time, s"


def _like(others: Panels, title: str) -> list[LevelCurve]:
    """Curves of the other results that belong into a panel; of a recording those weighted by A."""
    first = title.partition(" at ")[0]
    named = [curves for name, curves in others.items() if name.partition(" at ")[0] == first]
    curves = named[0] if named else next(iter(others.values()))
    if not named:
        curves = [one for one in curves if one.label == "A-weighted"] or curves[:1]
    return _lettered("B", curves)


def _lettered(letter: str, curves: Sequence[LevelCurve]) -> list[LevelCurve]:
    return [curve._replace(label=f"{letter}: {curve.label}") for curve in curves]


def _has(results: xr.Dataset, receiver: str | None) -> bool:
    dim = "receiver" if "receiver" in results.dims else "channel"
    return receiver in results[dim].values


def _shaded(results: xr.Dataset, receiver: str | None, options: Sequence[str]) -> list[Range]:
    """Speeds to avoid, of the first option or the level weighted by A."""
    if "level_total" in results:
        option = chosen(results, "option", options[0] if options else REFERENCE_OPTION)
        avoided = speeds_to_avoid(results, receiver, [option])
        return [one.range for one in avoided if one.quantity == LEVEL]
    if not is_run_up(results["block_speed"]):
        return []
    weighted = {one.label: one for one in recorded_curves(results, receiver)}["A-weighted"]
    return recorded_speeds_to_avoid(weighted.speed_rpm, weighted.level_db)


def _panel(axes: Axes, curves: Sequence[LevelCurve], solid: int) -> None:
    """Lines with their bands; those behind the first few dashed."""
    top = max(float(curve.level_db.max()) for curve in curves)
    looks = line_looks(len(curves))
    for number, (curve, look) in enumerate(zip(curves, looks, strict=True)):
        marker = "o" if curve.speed_rpm.size <= _FEW_POINTS else ""
        dash = {"linestyle": "-" if number < solid else "--"} if solid < len(curves) else {}
        shown = np.where(curve.level_db > top - _RANGE_DB, curve.level_db, np.nan)
        axes.plot(
            curve.speed_rpm, shown, label=wrap(curve.label, 24),
            **{**look, **dash, "marker": marker, "markersize": 3.0},
        )  # fmt: skip
        if curve.band_db is not None:
            low, high = np.maximum(curve.band_db, top - _RANGE_DB)
            axes.fill_between(curve.speed_rpm, low, high, color=look["color"], alpha=0.12, lw=0)
