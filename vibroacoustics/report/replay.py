"""Analysis of a recording with an option of a study in place."""

import json
from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..results.claim_kinds import REPLAYED
from ..results.conditional import ConditionalClaim, Finding
from ..results.number import Number
from .analysis import Analysis, origin
from .blocks import Bullets, Part, Sound, Sounds, Text
from .tables import DataTable, Table, cell, columns_of, data_table

_SUMMARY_WEIGHTING: Final = "A"
_UNWEIGHTED: Final = "Z"
"""Weighting of vibration."""
_MOST_LINES: Final = 12
"""Lines of one reason that are named; all are in the CSV."""
_SCALE: Final = (
    "A and B have one scale. In the blind test X is A or B at random: say ten times which. The "
    "score states how often guessing alone gives as many right answers or more; at 5 % or less the "
    "change is audible to you."
)
_SURE: Final = (
    "Certain are the orders' levels before, all other sound, and that no unmodelled noise is "
    "assumed: it is the recording's own.",
    "Uncertain is each ratio: it is that of the study's machine, in one of its samples. Where the "
    "study has samples, the change of each order at a microphone has an interval of 80 % of them. "
    "That of the total level has all orders at one end of theirs: it is too wide rather than too "
    "narrow.",
    "An order of the recording may have a further source that the study lacks. It is changed as if "
    "it had none.",
)


def analysis_of_replay(summary: xr.Dataset, sounds: Mapping[str, Mapping[str, str]]) -> Analysis:
    """Return levels before and after, what stays, and the sounds with a blind test.

    Parameters
    ----------
    summary : result of `replay`
    sounds : files beside the page, by channel and by `before` and `after`
    """
    totals, lines = _totals(summary), _lines(summary)
    stays, about = Bullets(tuple(_stays(summary))), Bullets(tuple(_facts(summary)))
    played = tuple(
        Sounds(tuple(Sound(f"{channel}, {word}", file) for word, file in files.items()), blind=True)
        for channel, files in sounds.items()
    )
    return Analysis(
        "replay",
        about=f"The recording with the option {summary.attrs['option']} of a study in place.",
        parts=(
            Part("sounds", "Sounds", (*played, Text(_SCALE, "note"))),
            Part("levels", "Levels", (totals, lines)),
            Part("stays", "What stays", (stays,)),
            Part("certainty", "Assumptions and limits", (Bullets(_SURE), about)),
        ),
        summary=tuple(_sentences(summary)),
        claims=tuple(map(partial(_claim, summary), _channels(summary))),
        shown=(totals, lines, stays, about),
        tables={
            "replay_lines.csv": _line_data(summary),
            "replay_totals.csv": _total_data(summary),
            "replay_unchanged.csv": _unchanged_data(summary),
        },
        **origin(summary, "Recording"),
    )


def _number(
    summary: xr.Dataset, variable: str, ends: tuple[str, str] | None, **selection: str
) -> Number:
    """A level or change with its interval where there is one."""
    array = summary[variable]
    value = float(array.sel(selection))
    low, high = (
        (None, None) if ends is None else (float(summary[end].sel(selection)) for end in ends)
    )
    text = "-" if np.isnan(value) else rounding.fixed(value)
    if low is not None and high is not None and high - low >= 0.1:
        text += f" ({rounding.fixed(low)} to {rounding.fixed(high)})"
    elif low is None or high is None or np.isnan(low) or np.isnan(high):
        low = high = None
    return Number(value, "dB", variable, selection, low=low, high=high, text=text)


def _totals(summary: xr.Dataset) -> Table:
    ends = ("replayed_total_level_low", "replayed_total_level_high")
    rows = tuple(
        (
            channel,
            weighting,
            _number(summary, "recorded_total_level", None, channel=channel, weighting=weighting),
            _number(summary, "replayed_total_level", ends, channel=channel, weighting=weighting),
        )
        for channel in _channels(summary)
        for weighting in map(str, summary["weighting"].values)
        if np.isfinite(
            float(summary["recorded_total_level"].sel(channel=channel, weighting=weighting))
        )
    )
    caption = f"Level over the whole recording, {_references(summary)}"
    return Table(caption, ("Channel", "weighting", "before", "after"), rows, frozenset({0, 1}))


def _lines(summary: xr.Dataset) -> Table:
    ends = ("replayed_line_change_low", "replayed_line_change_high")
    rows = []
    for channel, line in _changed(summary):
        selection = {"channel": channel, "line": line}
        before = _number(summary, "recorded_line_level", None, **selection)
        after = _number(summary, "replayed_line_level", None, **selection)
        rows.append((channel, line, before, after, _number(summary, _CHANGE, ends, **selection)))
    head = ("Channel", "Line", "before, dB", "after, dB", "change, dB")
    caption = f"Changed orders, {_references(summary)}"
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


_CHANGE: Final = "replayed_line_change"


def _changed(summary: xr.Dataset) -> Iterable[tuple[str, str]]:
    """Channels and lines that are changed."""
    for channel in _channels(summary):
        for line in map(str, summary["line"].values):
            if np.isfinite(float(summary[_CHANGE].sel(channel=channel, line=line))):
                yield channel, line


def _channels(summary: xr.Dataset) -> list[str]:
    return [str(name) for name in summary["channel"].values]


_REFERENCES: Final = {"Pa": "20 µPa", "m/s²": "1 µm/s²", "m/s": "1 nm/s", "N": "1 µN"}
"""References of levels by unit (ISO 1683)."""


def _references(summary: xr.Dataset) -> str:
    """References of the levels in words, by channel where they differ."""
    units = dict(zip(_channels(summary), map(str, summary["channel_unit"].values), strict=True))
    if len(set(units.values())) == 1:
        return f"dB re {_REFERENCES[next(iter(units.values()))]}"
    each = (f"{_REFERENCES[unit]} ({channel})" for channel, unit in units.items())
    return f"dB re {', '.join(each)}"


def _unchanged(summary: xr.Dataset) -> dict[str, dict[str, str]]:
    """Reason by channel and line."""
    reasons: dict[str, dict[str, str]] = json.loads(summary.attrs["unchanged"])
    return reasons


def _stays(summary: xr.Dataset) -> Iterable[str]:
    """Sentences on what stays, by channel and reason."""
    highest = float(summary.attrs["highest_order"])
    yield (
        "All other sound stays: noise, tones, and orders that the study lacks, such as those "
        f"above {highest:g}."
    )
    if summary.attrs["noise_changes"]:
        yield "The option changes the noise too, in the study. Here the noise stays."
    for channel, reasons in _unchanged(summary).items():
        for reason in dict.fromkeys(reasons.values()):
            names = sorted(
                (line for line, why in reasons.items() if why == reason), key=_line_number
            )
            more = f" and {len(names) - _MOST_LINES} more" if len(names) > _MOST_LINES else ""
            yield f"{channel}, {reason}: {', '.join(names[:_MOST_LINES])}{more}."


def _line_number(line: str) -> tuple[float, str]:
    """Order of a line by its number; others come last."""
    number = line.removeprefix("order ")
    return (float(number), "") if number.replace(".", "", 1).isdigit() else (np.inf, line)


def _facts(summary: xr.Dataset) -> Iterable[str]:
    attrs = summary.attrs
    begin, end = attrs["replayed_from_s"], attrs["replayed_to_s"]
    yield f"Speed: {attrs['speed_source']}."
    if attrs["shaft_ratio"] != 1.0:
        yield f"The study's shaft has {attrs['shaft_ratio']:g} times the recorded speed."
    yield (
        f"Part of the recording in which the speed is known and of the study: {begin:.3g} to "
        f"{end:.4g} s."
    )
    yield from _between_speeds(attrs)
    yield f"Bandwidth of an order: at most {attrs['bandwidth_hz']:.3g} Hz."
    pairs = json.loads(attrs["pairs"]).items()
    yield f"Responses: {', '.join(f'{response} for {channel}' for channel, response in pairs)}."


def _between_speeds(attrs: Mapping[str, Any]) -> Iterable[str]:
    """Say how far apart speeds of the study are, and what that costs."""
    if not attrs["speed_gap"]:
        return
    error_db = float(attrs["interpolation_error_db"])
    words = f"reaches {rounding.fixed(error_db)} dB where one is omitted. The intervals hold it."
    if np.isnan(error_db):
        words = "is unknown with two speeds: no order has an interval."
    yield (
        f"Speeds of the study are up to {100.0 * attrs['speed_gap']:.0f} % apart. Between them "
        f"ratios are interpolated, whose error {words}"
    )


def _claim(summary: xr.Dataset, channel: str) -> ConditionalClaim:
    """Level of a channel with the option: it needs a line that can be changed, and samples."""
    is_sound = summary["channel_unit"].sel(channel=channel) == "Pa"
    weighting, unit = (_SUMMARY_WEIGHTING, "dB(A)") if is_sound else (_UNWEIGHTED, "dB")
    ends = ("replayed_total_level_low", "replayed_total_level_high")
    after = _number(summary, "replayed_total_level", ends, channel=channel, weighting=weighting)
    changed = sum(each == channel for each, _ in _changed(summary))
    reasons = _unchanged(summary).get(channel, {})
    is_known, is_sampled = bool(changed or not reasons), after.low is not None or not changed
    findings = {
        "lines": Finding(f"{changed} of {changed + len(reasons)}", is_known),
        "samples": Finding("samples" if is_sampled else "none", is_sampled),
    }
    return REPLAYED.claim(f"{after} {unit}", findings, channel)


def _sentences(summary: xr.Dataset) -> Iterable[str]:
    attrs = summary.attrs
    recorded, studied = attrs["recorded_rpm"], attrs["study_rpm"]
    if attrs["has_further_speeds"]:
        yield (
            f"Replayed from {attrs['replayed_from_s']:.3g} to {attrs['replayed_to_s']:.3g} s: the "
            f"recording has {recorded[0]:.0f} to {recorded[1]:.0f} rpm, the study "
            f"{studied[0]:.0f} to {studied[1]:.0f}."
        )
    ends = ("replayed_total_level_low", "replayed_total_level_high")
    for channel in _channels(summary):
        is_sound = summary["channel_unit"].sel(channel=channel) == "Pa"
        weighting, unit = (_SUMMARY_WEIGHTING, "dB(A)") if is_sound else (_UNWEIGHTED, "dB")
        selection = {"channel": channel, "weighting": weighting}
        before = _number(summary, "recorded_total_level", None, **selection)
        after = _number(summary, "replayed_total_level", ends, **selection)
        count = sum(each == channel for each, _ in _changed(summary))
        option, reasons = summary.attrs["option"], _unchanged(summary).get(channel, {})
        if count:
            orders = "1 order" if count == 1 else f"{count} orders"
            yield (
                f"{channel}: {before} {unit} before, {after} {unit} with {option}; "
                f"{orders} changed."
            )
        elif reasons:
            why = ", ".join(dict.fromkeys(reasons.values()))
            yield (
                f"{channel}: {before} {unit}; the effect of {option} cannot be determined: none of "
                f"{len(reasons)} lines can be changed ({why})."
            )
        else:
            yield f"{channel}: {before} {unit}; {option} changes no order of it."


def _line_data(summary: xr.Dataset) -> DataTable:
    """Every line that option and recording may have, changed or not."""
    columns = {
        "channel": summary["channel"],
        "line": summary["line"],
        "before_db": summary["recorded_line_level"],
        "noise_db": summary["recorded_line_noise_level"],
        "after_db": summary["replayed_line_level"],
        "change_db": summary[_CHANGE],
        "change_low_db": summary[f"{_CHANGE}_low"],
        "change_high_db": summary[f"{_CHANGE}_high"],
    }
    return _without_gaps(data_table(("channel", "line"), columns))


def _total_data(summary: xr.Dataset) -> DataTable:
    columns = {
        "channel": summary["channel"],
        "weighting": summary["weighting"],
        "before_db": summary["recorded_total_level"],
        "after_db": summary["replayed_total_level"],
        "after_low_db": summary["replayed_total_level_low"],
        "after_high_db": summary["replayed_total_level_high"],
    }
    return _without_gaps(data_table(("channel", "weighting"), columns))


def _unchanged_data(summary: xr.Dataset) -> DataTable:
    rows = [
        (channel, line, reason)
        for channel, reasons in _unchanged(summary).items()
        for line, reason in reasons.items()
    ]
    return columns_of(("channel", "line", "reason"), rows)


def _without_gaps(table: DataTable) -> DataTable:
    """Empty cells where there is no value."""
    return {name: [cell(value) for value in values] for name, values in table.items()}
