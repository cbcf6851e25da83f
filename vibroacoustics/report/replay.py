"""Analysis of a recording with an option of a study in place."""

import json
from collections.abc import Iterable, Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..results.number import Number
from .analysis import Analysis, origin
from .blocks import Bullets, Part, Sound, Sounds, Text
from .tables import DataTable, Table, columns_of, data_table, known

_SUMMARY_WEIGHTING: Final = "A"
_MOST_LINES: Final = 12
"""Lines of one reason that are named; all are in the CSV."""
_SURE: Final = (
    "Certain are the orders' levels before, all other sound, and that no unmodelled noise is "
    "assumed: it is the recording's own.",
    "Uncertain is each ratio: it is that of the study's machine, in one of its samples. An "
    "interval (80 % of the samples) is known of order 1 only, where the study has samples; that "
    "of the total level comes from it alone.",
    "An order of the recording may have a further source that the study lacks. It is changed as if "
    "it had none.",
)


def analysis_of_replay(summary: xr.Dataset, sounds: Mapping[str, str]) -> Analysis:
    """Return levels before and after, what stays, and the sounds.

    Parameters
    ----------
    summary : of `replay`
    sounds : file of each sound, beside the page, by name
    """
    totals, lines = _totals(summary), _lines(summary)
    stays, about = Bullets(tuple(_stays(summary))), Bullets(tuple(_facts(summary)))
    played = tuple(Sound(name, file) for name, file in sounds.items())
    return Analysis(
        "replay",
        about=f"The recording with the option {summary.attrs['option']} of a study in place.",
        parts=(
            Part("sounds", "Sounds", (Sounds(played), Text("Both have one scale.", "note"))),
            Part("levels", "Levels", (totals, lines)),
            Part("stays", "What stays", (stays,)),
            Part("certainty", "Assumptions and limits", (Bullets(_SURE), about)),
        ),
        summary=tuple(_sentences(summary)),
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
    )
    caption = "Level over the whole recording, dB re 20 µPa"
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
    return Table("Changed orders, dB re 20 µPa", head, tuple(rows), frozenset({0, 1}))


_CHANGE: Final = "replayed_line_change"


def _changed(summary: xr.Dataset) -> Iterable[tuple[str, str]]:
    """Channels and lines that are changed."""
    for channel in _channels(summary):
        for line in map(str, summary["line"].values):
            if np.isfinite(float(summary[_CHANGE].sel(channel=channel, line=line))):
                yield channel, line


def _channels(summary: xr.Dataset) -> list[str]:
    return [str(name) for name in summary["channel"].values]


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
            names = [line for line, why in reasons.items() if why == reason]
            more = f" and {len(names) - _MOST_LINES} more" if len(names) > _MOST_LINES else ""
            yield f"{channel}, {reason}: {', '.join(names[:_MOST_LINES])}{more}."


def _facts(summary: xr.Dataset) -> Iterable[str]:
    attrs = summary.attrs
    begin, end = attrs["replayed_from_s"], attrs["replayed_to_s"]
    yield f"Speed: {attrs['speed_source']}."
    yield f"Part of the recording in which the speed is known: {begin:.3g} to {end:.4g} s."
    yield f"Bandwidth of an order: at most {attrs['bandwidth_hz']:.3g} Hz."
    pairs = json.loads(attrs["pairs"]).items()
    yield f"Responses: {', '.join(f'{response} for {channel}' for channel, response in pairs)}."


def _sentences(summary: xr.Dataset) -> Iterable[str]:
    ends = ("replayed_total_level_low", "replayed_total_level_high")
    for channel in _channels(summary):
        selection = {"channel": channel, "weighting": _SUMMARY_WEIGHTING}
        before = _number(summary, "recorded_total_level", None, **selection)
        after = _number(summary, "replayed_total_level", ends, **selection)
        count = sum(each == channel for each, _ in _changed(summary))
        orders = "1 order" if count == 1 else f"{count} orders"
        yield (
            f"{channel}: {before} dB(A) before, {after} dB(A) with {summary.attrs['option']}; "
            f"{orders} changed."
        )


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
    return data_table(("channel", "weighting"), columns)


def _unchanged_data(summary: xr.Dataset) -> DataTable:
    rows = [
        (channel, line, reason)
        for channel, reasons in _unchanged(summary).items()
        for line, reason in reasons.items()
    ]
    return columns_of(("channel", "line", "reason"), rows)


def _without_gaps(table: DataTable) -> DataTable:
    """Empty cells where there is no value."""
    return {name: [known(value) for value in values] for name, values in table.items()}
