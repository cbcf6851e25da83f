"""Speeds to avoid, in words, as table and file."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.vocabulary import REFERENCE_OPTION
from ..results.bands import energy_share, percent
from ..results.over_speed.avoid import (
    BINS,
    LEVEL,
    NEAR_RATIO,
    STANDS_OUT_DB,
    WITHIN_DB,
    Avoided,
    Range,
)
from ..results.stored_study import catalogue_receiver, options
from .tables import DataTable, Table, columns_of

MOST_ROWS: Final = 20
MOST_NAMED: Final = 5
RECORDED_RULE: Final = (
    "Speeds to avoid are maxima of the A-weighted level over the speed, in energy means over "
    f"{BINS} equal steps of speed. A maximum is at least {STANDS_OUT_DB:g} dB above the higher of "
    f"its two valleys. Its range has all speeds around it within {WITHIN_DB:g} dB of the maximum."
)
_HEAD: Final = ("option", "quantity", "from_rpm", "to_rpm", "peak_rpm", "above_db", "line",
                "line_hz", "mode", "mode_hz")  # fmt: skip


def avoid_table(results: xr.Dataset, every: Sequence[Avoided]) -> Table | None:
    """Those that stand out most, by option and speed; none for none."""
    if not every:
        return None
    rows = tuple(_row(results, same) for same in _alike(results, every[:MOST_ROWS]))
    more = f"; {MOST_ROWS} of {len(every)}, all are in speeds.csv" if len(every) > MOST_ROWS else ""
    head = ("Option", "What stands out", "Avoid, rpm", "Largest at, rpm", "By, dB",
            "Share of the total there", "Strongest line", "Natural frequency")  # fmt: skip
    receiver = catalogue_receiver(results)
    return Table(
        f"Speeds to avoid, levels at {receiver}{more}", head, rows, frozenset({0, 1, 6, 7})
    )


def _alike(results: xr.Dataset, every: Sequence[Avoided]) -> list[list[Avoided]]:
    """Those that read the same with several options, together; by speed, levels first."""
    names = options(results)
    ranked = sorted(
        every,
        key=lambda avoided: (
            avoided.quantity != LEVEL,
            avoided.range.peak_rpm,
            names.index(avoided.option),
        ),
    )
    groups: dict[tuple[object, ...], list[Avoided]] = {}
    for avoided in ranked:
        key = (avoided.quantity, *_words(avoided), rounding.fixed(avoided.range.above_db, 0))
        groups.setdefault(key, []).append(avoided)
    return list(groups.values())


def _row(results: xr.Dataset, same: Sequence[Avoided]) -> tuple[str, ...]:
    first, count = same[0], len(options(results))
    ends, peak, line, mode = _words(first)
    names = "all" if len(same) == count > 1 else ", ".join(other.option for other in same)
    above = rounding.fixed(first.range.above_db, 0)
    return names, first.quantity, ends, peak, above, _share(results, first), line, mode


def _words(avoided: Avoided) -> tuple[str, str, str, str]:
    """Range, maximum, line and mode."""
    mode = rounding.NOTHING if avoided.mode is None else avoided.mode.words
    line = f"{avoided.line}, {avoided.line_hz:.0f} Hz"
    return _ends(avoided.range), f"{avoided.range.peak_rpm:.0f}", line, mode


def recorded_avoid_table(channel: str, ranges: Sequence[Range]) -> Table | None:
    """Return the speeds to avoid of a recorded channel as a table; None without any."""
    if not ranges:
        return None
    rows = tuple(
        (_ends(span), f"{span.peak_rpm:.0f}", rounding.level(span.peak_db),
         rounding.fixed(span.above_db, 0))
        for span in ranges
    )  # fmt: skip
    head = ("Avoid, rpm", "Largest at, rpm", "Level, dB(A)", "By, dB")
    return Table(f"Speeds to avoid: {channel}", head, rows)


def rule_words(results: xr.Dataset) -> str:
    """Say how speeds to avoid were chosen, and the limits of the rule."""
    speed = np.sort(results["speed"].values)
    step = float(np.diff(speed).max())
    return (
        "Speeds to avoid are maxima over the speed of the modelled A-weighted level or of the "
        "force into a foot. That force is the root of the sum of squares of its orders. "
        f"A maximum is at least {STANDS_OUT_DB:g} dB above the higher of its two valleys. "
        f"Its range has all speeds around it within {WITHIN_DB:g} dB of the maximum. "
        "Strongest line: the loudest order or tone there. Natural frequency: the nearest, if "
        f"within {100.0 * NEAR_RATIO:g} % of that line. Natural frequencies are nominal. "
        f"Speeds are up to {step:g} rpm apart: narrower maxima and those at an end are not found."
    )


def reference_words(every: Sequence[Avoided]) -> str:
    """Ranges to avoid without a balancer."""
    spans = [avoided.range for avoided in every if avoided.option == REFERENCE_OPTION]
    if not spans:
        return "Without a balancer no speed is to be avoided by the rule below."
    named = [f"{_ends(span)} rpm" for span in sorted(spans[:MOST_NAMED])]
    more = f" and {len(spans) - MOST_NAMED} more" if len(spans) > MOST_NAMED else ""
    return f"Speeds to avoid without a balancer: {', '.join(named)}{more}."


def avoid_data(every: Sequence[Avoided]) -> DataTable:
    """All of them; mode and its frequency are empty where none is near."""
    rows: list[tuple[str | float, ...]] = []
    for avoided in every:
        ends, mode = (
            (avoided.range.from_rpm, avoided.range.to_rpm, avoided.range.peak_rpm),
            avoided.mode,
        )
        near = ("", "") if mode is None else (f"{mode.kind} {mode.name}", mode.frequency_hz)
        what = (avoided.range.above_db, avoided.line, avoided.line_hz)
        rows.append((avoided.option, avoided.quantity, *ends, *what, *near))
    return columns_of(_HEAD, rows)


def _ends(span: Range) -> str:
    return f"{span.from_rpm:.0f} to {span.to_rpm:.0f}"


def _share(results: xr.Dataset, avoided: Avoided) -> str:
    """Return the share of the modelled energy in the total; a dash for a force."""
    if avoided.quantity != LEVEL:
        return rounding.NOTHING
    coordinates = {"option": avoided.option, "receiver": catalogue_receiver(results),
          "speed": avoided.range.peak_rpm}  # fmt: skip
    return percent(
        energy_share(avoided.range.peak_db, float(results["level_total"].sel(coordinates)))
    )
