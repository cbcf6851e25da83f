"""The first screen of a report: five sentences, contributions to the level, changes of the total.

Each sentence answers one question: how loud, what makes it, what the options do to the level, what
they do to vibration, which measurement is most valuable.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.vocabulary import REFERENCE_OPTION
from ....results.bands import Band, band
from ....results.estimates import has_samples
from ....results.stored_study import (
    at_catalogue,
    balancers,
    catalogue_receiver,
    has_sources,
    level_kind,
    nearest_speed,
    overall_noise,
    parameters,
    source_name,
    speeds,
)
from ...blocks import Interval, Intervals, IntervalWord
from ...conditions import interval_claim
from ...quantities import FOOT_FORCE, NO_BREAK, TOTAL
from ...shifts import Shift, level_word, measurable, shift
from ..rating import rating_sentence, windows, worst_window
from ..sources.words import UNMODELLED, dominant_source, ranked, source_share
from ..unknowns import most_valuable

_QUIETEST_DB: Final = 30.0
"""Sources so far below the machine are not shown."""
_LEAST_SPAN_DB: Final = 2.0
"""Smallest half width of the scale of changes."""


def sentences(results: xr.Dataset) -> tuple[str, ...]:
    """Return the sentences of the first screen."""
    rated = "rating_level" in results
    model, vibration = ((), ()) if rated else ((_model_alone,), (_vibration,))
    each = (_windows, _level, *model, _room, _source, _options, *vibration, _measurement)
    return tuple(filter(None, (sentence(results) for sentence in each)))


def contributions(results: xr.Dataset) -> Intervals:
    """Return the levels of machine, sources and unmodelled noise beside the published level."""
    speed = nearest_speed(results)
    coordinates = at_catalogue(results, speed=speed)
    total = band(results, "level_total", **coordinates)
    rows, scatter = [_contribution("machine", total, "total")], ""
    noise = overall_noise(results)
    if noise is not None and speed == noise["speed_rpm"]:
        level, deviation = noise["level_dba"], noise.get("deviation_db", 2.0)
        bounds = (level - deviation, level, level + deviation)
        text = f"{level:g} ± {deviation:g}"
        rows.insert(0, Interval(level_kind(results), text, *bounds, "published"))
        scatter = f" ±{NO_BREAK}{deviation:g} dB is the standard deviation."
    if noise is not None:
        unmodelled = band(results, "residual_level", **coordinates).as_part_of(total)
        rows.append(_contribution(UNMODELLED, unmodelled, "part"))
    for number, source in enumerate(ranked(results, speed)):
        level_of = band(results, "source_level", **coordinates, sound_source=source)
        level_of = level_of.as_part_of(total)
        if number == 0 or level_of.highest > total.middle - _QUIETEST_DB:
            rows.append(_contribution(source_name(results, source), level_of, "part"))
    ends = [end for row in rows for end in (row.low, row.high) if np.isfinite(end)]
    lowest = max(min(ends), total.middle - _QUIETEST_DB)
    scale = (float(np.floor(lowest - 1.0)), float(np.ceil(max(ends) + 1.0)))
    where = f"{catalogue_receiver(results)}, {speed:g} rpm"
    of = ", median and 80 % interval" if has_samples(results) else ""
    caption = f"Contributions to the level at {where}"
    medians = ", nor do medians" if has_samples(results) else ""
    note = (
        "Each modelled source alone: the largest always, others if within "
        f"{_QUIETEST_DB:g} dB of the machine. Levels in dB do not add up{medians}.{scatter}"
    )
    return Intervals(caption, ("", f"dB(A){of}"), tuple(rows), scale, None, note)


def changes(results: xr.Dataset) -> Intervals | None:
    """Return the change of the total by every option; None without options."""
    if not balancers(results):
        return None
    least = measurable(results).level_db
    rows = [Interval(REFERENCE_OPTION, "0", 0.0, 0.0, 0.0, "no change")]
    rows += [_change(results, option, least) for option in balancers(results)]
    ends = [abs(end) for row in rows for end in (row.low, row.high) if np.isfinite(end)]
    span = float(np.ceil(max(*ends, _LEAST_SPAN_DB)))
    several = (
        " Each change is given at the simulated speed where it is largest."
        if len(speeds(results)) > 1
        else ""
    )
    head = ("Option", "dB, median and 80 % interval" if has_samples(results) else "dB")
    caption = f"Change of the level at {catalogue_receiver(results)} by design option"
    note = f"Grey band: changes within ±{least:g} dB cannot be measured.{several}"
    return Intervals(caption, head, tuple(rows), (-span, span), (-least, least), note)


def _contribution(name: str, level: Band, word: IntervalWord) -> Interval:
    text = level.middle_and_ends(rounding.level)
    return Interval(name, text, level.lowest, level.middle, level.highest, word)


def _change(results: xr.Dataset, option: str, least: float) -> Interval:
    of_total = shift(results, TOTAL, option)
    change = of_total.band
    text = change.middle_and_ends(rounding.signed)
    ends = change.lowest, change.middle, change.highest
    return Interval(option, text, *ends, level_word(of_total))


def _level(results: xr.Dataset) -> str:
    speed = nearest_speed(results)
    level = band(results, "level_total", **at_catalogue(results, speed=speed))
    around = level.around_middle(rounding.level)
    is_stated = around and not interval_claim(results).is_withdrawn
    interval = f" (80{NO_BREAK}% interval {around})" if is_stated else ""
    return (
        f"{parameters(results)['machine']['name']} at {speed:g} rpm: "
        f"{level.middle_text(rounding.level)} dB(A) at {catalogue_receiver(results)}{interval}, "
        f"{_basis(results, speed)}."
    )


def _basis(results: xr.Dataset, speed_rpm: float) -> str:
    """Say whether the level is predicted or fitted to one that is published."""
    noise = overall_noise(results)
    if noise is None:
        return "predicted; no level is published"
    speed = "" if speed_rpm == noise["speed_rpm"] else f" at {noise['speed_rpm']:g} rpm"
    return f"fitted to the {level_kind(results)} {noise['level_dba']:g}{speed}"


def _model_alone(results: xr.Dataset) -> str:
    """Give the level of the model where samples are fitted, and their number where they are few."""
    parts = []
    if "model_level" in results and has_samples(results):
        alone = Band(*results["model_level"].values.tolist())
        text = alone.middle_and_ends(partial(rounding.fixed, decimals=0))
        parts.append(f"model alone: {text} dB(A)")
    parts += [check.lacking for check in interval_claim(results).missing("remark")]
    text = "; ".join(parts)
    return f"{text[0].upper()}{text[1:]}." if text else ""


def _windows(results: xr.Dataset) -> str:
    """Give the verdict at the window that decides; the others are in the section."""
    if "rating_level" not in results:
        return ""
    count = len(windows(results))
    among = f" (worst of {count})" if count > 1 else ""
    return rating_sentence(results, worst_window(results), among)


def _room(results: xr.Dataset) -> str:
    if "room_level" not in results:
        return ""
    coordinates = {"option": REFERENCE_OPTION, "speed": nearest_speed(results)}
    names = results["listener"].values.tolist()
    level_at = {name: band(results, "room_level", **coordinates, listener=name) for name in names}
    name = max(level_at, key=lambda listener: level_at[listener].middle)
    return (
        f"In the room, at listener {name}: {level_at[name].middle_and_ends(rounding.level)} dB(A)."
    )


def _source(results: xr.Dataset) -> str:
    speed = nearest_speed(results)
    if not has_sources(results):
        coordinates = at_catalogue(results, speed=speed)
        modelled = band(results, "level_modelled", **coordinates).middle_text(rounding.level)
        fill = f"; unmodelled noise fills up the {level_kind(results)} level"
        unmodelled = "" if overall_noise(results) is None else fill
        return f"Shaft orders of the rigid machine alone make {modelled} dB(A){unmodelled}."
    source, makes_most = dominant_source(results)
    name = source_name(results, source)
    text = f"{source_share(results, source, speed).in_percent()} of the energy"
    if makes_most:
        return f"The dominant source is {name}: {text}."
    if not has_samples(results):
        return f"The dominant modelled source is {name}: {text}."
    return f"The dominant source is not settled; largest: {name}, {text}."


def _options(results: xr.Dataset) -> str:
    shifts = {option: shift(results, TOTAL, option) for option in balancers(results)}
    if not shifts:
        return ""
    lower, higher = by_effect(results)
    does = "is likely to lower" if has_samples(results) else "lowers"
    none = f"No option {does} the level by {measurable(results).level_db:g} dB."
    lowered = _claim(results, shifts, lower, "lower") or none
    sentences = [lowered, _claim(results, shifts, higher, "raise")]
    return " ".join(filter(None, sentences))


def by_effect(results: xr.Dataset) -> tuple[list[str], list[str]]:
    """Return the options that lower the total, and those that raise it, the largest first."""
    shifts = {option: shift(results, TOTAL, option) for option in balancers(results)}
    by_change = sorted(shifts, key=lambda name: shifts[name].gain_db[shifts[name].largest])
    lower = [name for name in by_change if shifts[name].improves and not shifts[name].worsens]
    return lower, [name for name in reversed(by_change) if shifts[name].worsens]


def _claim(
    results: xr.Dataset, shifts: Mapping[str, Shift], names: Sequence[str], verb: str
) -> str:
    """Say what the first of some options does to the level, and that others do it too."""
    if not names:
        return ""
    first, *others = names
    if shifts[first].improves and shifts[first].worsens:  # at different speeds
        does = "may raise or lower"
    else:
        does = f"may {verb}" if level_word(shifts[first]) == "uncertain" else f"{verb}s"
    too = f"{len(others)} others" if len(others) > 1 else "".join(others)
    too = f"; also {too}" if too else ""
    others_given = "rating_level" in results or "room_level" in results
    where = f" at {catalogue_receiver(results)}" if others_given else ""
    change = _largest_change(results, shifts[first], "dB")
    return f"Option {first} {does} the level{where}: {change}{too}."


def _vibration(results: xr.Dataset) -> str:
    if not balancers(results):
        return ""
    best, sure = best_for_feet(results)
    if not best:
        return "No option measurably reduces the force on the feet at shaft speed (1×)."
    change = _largest_change(results, shift(results, FOOT_FORCE, best), "%")
    force = "force on the most loaded foot at shaft speed (1×)"
    if not sure:
        return f"Option {best} may reduce the {force}: {change}."
    return f"Largest reduction of {force}: option {best}, {change}."


def best_for_feet(results: xr.Dataset) -> tuple[str, bool]:
    """Return the option that reduces the 1x foot force most, and whether its interval agrees.

    The name is empty where no option reduces it measurably.
    """
    shifts = {option: shift(results, FOOT_FORCE, option) for option in balancers(results)}
    better = [name for name, of_force in shifts.items() if of_force.improves]
    better = [name for name in better if not shifts[name].worsens]
    sure = [name for name in better if shifts[name].falls]
    candidates = sure or better
    if not candidates:
        return "", False
    best = min(candidates, key=lambda name: shifts[name].gain_db[shifts[name].largest])
    return best, bool(sure)


def _measurement(results: xr.Dataset) -> str:
    wanted = most_valuable(results)
    if wanted is None:
        return ""
    purpose, measurement = wanted
    return f"Most valuable measurement for the {purpose}: {measurement}."


def _largest_change(results: xr.Dataset, of_quantity: Shift, unit: str) -> str:
    """Return the largest change, with its speed where that is not the speed of the headline."""
    speed = speeds(results)[of_quantity.largest]
    where = "" if speed == nearest_speed(results) else f" at {speed:g} rpm"
    return f"{_with_unit(of_quantity.band, unit)}{where}"


def _with_unit(change: Band, unit: str) -> str:
    """`+4.1 dB (0 to +22)`."""
    decimals = 0 if unit == "%" else 1

    def write(value: float) -> str:
        return rounding.signed(value, decimals)

    value, around = f"{change.middle_text(write)}{NO_BREAK}{unit}", change.around_middle(write)
    return f"{value} ({around})" if around else value
