"""Levels over the speed, in total and by source, with bands and speeds to avoid."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...base.rounding import LEVEL_FLOOR_DB
from ...base.vocabulary import REFERENCE_OPTION
from ...results.bands import INTERVAL
from ...results.estimates import has_samples
from ...results.over_speed.avoid import LEVEL, Range, recorded_speeds_to_avoid, speeds_to_avoid
from ...results.over_speed.level_curves import (
    LevelCurve,
    is_run_up,
    option_curves,
    recorded_curves,
    source_curves,
)
from ...results.stored_study import catalogue_receiver
from ...results.titles import chosen, titled
from ..charts.axes import stacked
from ..charts.layout import shortened, wrapped
from ..charts.marks import Axis, Chart, Line, Mark, Panel, Span
from ..charts.needs import needs
from ..file_names import numbered

FEW_POINTS: Final = 12
"""Points of a line that have a marker each."""
SHADED: Final = "Shaded: speeds to avoid without a balancer."
_RANGE_DB: Final = 60.0
"""Levels further below the highest are not shown."""
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
) -> Chart:
    """A-weighted level over the speed, total and modelled: a line an option, of one its band.

    For a recording: a line a weighting. Speeds to avoid are shaded. A recording without a run-up is
    drawn over the time.

    Parameters
    ----------
    results : results of `run`, needs `level_total` (speed, option, receiver), dB; or of
        `speed_frequency_map`, needs `block_level` (channel, block, weighting), dB
    receiver : microphone or channel of sound pressure; default: that of the catalogue's noise, or
        the first
    options : options of a study, the first with its band; default: the first eight
    beside : other results, whose lines are dashed
    beside_options : options of these
    """
    panels, xlabel = _curves(results, receiver, options)
    solid = {title: len(curves) for title, curves in panels.items()}
    if beside is not None:
        beside = titled(beside)
        named = beside["receiver" if "receiver" in beside.dims else "channel"].values
        others, _ = _curves(beside, receiver if receiver in named else None, beside_options)
        panels = {
            title: [*_lettered("A", curves), *_lettered("B", _like(others, title))]
            for title, curves in panels.items()
        }
    avoided = _avoided(results, receiver, options)
    x, y = Axis(xlabel), Axis("Level, dB(A)" if "level_total" in results else "Level, dB re 20 µPa")
    shown = stacked(
        Panel(x, y, _marks(avoided, curves, solid[title]), shortened(title, 90), 2.7)
        for title, curves in panels.items()
    )
    if beside is not None:
        first, second = (named[0] if named else "all" for named in (options, beside_options))
        words = (
            "compared_levels_over_speed",
            "A-weighted level over the speed in both results, total and modelled.",
            f"A-weighted level over the speed. Solid: A, option {first}; dashed: B, option "
            f"{second}. Shaded: speeds to avoid of A.",
        )
    elif "level_total" not in results:
        channel = next(iter(panels))
        words = (
            f"levels_{dict(numbered(results, 'channel'))[channel]}",
            f"Level of {channel} over the speed.",
            f"Level of {channel} over the speed, block by block. Shaded: speeds to avoid by the "
            "A-weighted level.",
        )
    else:
        microphone = receiver or catalogue_receiver(results)
        words = (
            "levels_over_speed",
            f"A-weighted level at {microphone} over the speed, total and modelled, for every "
            "option.",
            f"A-weighted level at {microphone}: total with unmodelled noise, and modelled "
            f"sources alone.{_bands(results)} {SHADED}",
        )
    return Chart(*words, shown, wide=True)


@needs("source_level")
def source_levels_over_speed(
    results: xr.Dataset, receiver: str | None = None, option: str = REFERENCE_OPTION
) -> Chart:
    """A-weighted level of each source alone over the speed, with its band, and of all of them.

    Parameters
    ----------
    results : results of `run`; needs `source_level` (speed, option, sound_source, receiver), dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    option : one of the results
    """
    option = chosen(results, "option", option)
    curves = source_curves(results, receiver, option)
    (modelled,) = option_curves(results, "level_modelled", receiver, [option])
    every = [modelled._replace(label="all modelled", band_db=None), *curves]
    audible = [curve for curve in every if curve.level_db.max() > LEVEL_FLOOR_DB]
    marks = _marks(_avoided(results, receiver, [option]), audible, len(audible))
    title = f"Each source alone, option {shortened(option, 30)}"
    microphone = receiver or catalogue_receiver(results)
    return Chart(
        "sources_over_speed",
        f"A-weighted level of each source at {microphone} over the speed.",
        f"Each source alone at {microphone}, option {option}, and all that is modelled, A-"
        f"weighted.{_bands(results)} {SHADED}",
        (Panel(Axis("Speed, rpm"), Axis("Level, dB(A)"), marks, title, 3.2),),
        wide=True,
    )


def spans(ranges: Sequence[Range]) -> tuple[Span, ...]:
    """Return speeds to avoid as shaded ranges."""
    return tuple(Span(each.from_rpm, each.to_rpm) for each in ranges)


def _bands(results: xr.Dataset) -> str:
    words = (
        f" Lines: medians. Bands: {INTERVAL} of the samples, which count by how well they agree "
        "with what was published or measured."
    )
    return words if has_samples(results) else ""


def _curves(
    results: xr.Dataset, receiver: str | None, options: Sequence[str]
) -> tuple[Panels, str]:
    """Return curves by title of their panel, and what they are drawn over."""
    if "level_total" in results:
        microphone = receiver or catalogue_receiver(results)
        return {
            f"{words} at {microphone}": option_curves(results, name, receiver, options)
            for words, name in (("Total", "level_total"), ("Modelled sources", "level_modelled"))
        }, "Speed, rpm"
    curves = recorded_curves(results, receiver)
    title = receiver or str(results["channel"].values[results["channel_unit"].values == "Pa"][0])
    if is_run_up(results["block_speed"]):
        return {title: curves}, "Speed, rpm"
    seconds = results.sortby("block_speed")["block_time"].values
    order = np.argsort(seconds)
    curves = [LevelCurve(c.label, seconds[order], c.level_db[order]) for c in curves]
    return {title: curves}, "Time, s"


def _like(others: Panels, title: str) -> list[LevelCurve]:
    """Return curves of the other results for a panel; of a recording those weighted by A."""
    first = title.partition(" at ")[0]
    named = [curves for name, curves in others.items() if name.partition(" at ")[0] == first]
    curves = named[0] if named else next(iter(others.values()))
    if named:
        return curves
    return [curve for curve in curves if curve.label == "A-weighted"] or curves[:1]


def _lettered(letter: str, curves: Sequence[LevelCurve]) -> list[LevelCurve]:
    return [curve._replace(label=f"{letter}: {curve.label}") for curve in curves]


def _avoided(results: xr.Dataset, receiver: str | None, options: Sequence[str]) -> list[Range]:
    """Return speeds to avoid, of the first option or the level weighted by A."""
    if "level_total" in results:
        option = chosen(results, "option", options[0] if options else REFERENCE_OPTION)
        avoided = speeds_to_avoid(results, receiver, [option])
        return [each.range for each in avoided if each.quantity == LEVEL]
    if not is_run_up(results["block_speed"]):
        return []
    weighted = {curve.label: curve for curve in recorded_curves(results, receiver)}["A-weighted"]
    return recorded_speeds_to_avoid(weighted.speed_rpm, weighted.level_db)


def _marks(avoided: Sequence[Range], curves: Sequence[LevelCurve], solid: int) -> tuple[Mark, ...]:
    """Return lines with their bands, those after the first few dashed, on shaded ranges."""
    marks: list[Mark] = [*spans(avoided)]
    bottom = max(float(curve.level_db.max()) for curve in curves) - _RANGE_DB
    for number, curve in enumerate(curves):
        dash = ("-" if number < solid else "--") if solid < len(curves) else ""
        band = None if curve.band_db is None else tuple(np.maximum(curve.band_db, bottom))
        marks.append(Line(
            curve.speed_rpm, np.where(curve.level_db > bottom, curve.level_db, np.nan),
            wrapped(curve.label, 24), band, dash=dash,
            marker="o" if curve.speed_rpm.size <= FEW_POINTS else "",
        ))  # fmt: skip
    return tuple(marks)
