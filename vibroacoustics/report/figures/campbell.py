"""Campbell diagram: lines of sound over the speed, natural frequencies, where both meet."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, IndexArray
from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.avoid import LEVEL, speeds_to_avoid
from ...results.over_speed.modes import (
    KINDS,
    Crossing,
    Mode,
    SoundLine,
    crossings,
    loudest_lines,
    modes_of,
)
from ...results.stored_study import catalogue_receiver
from ...results.titles import chosen
from ..charts.axes import stacked
from ..charts.layout import COLOURS, shortened
from ..charts.marks import Axis, Chart, Line, Mark, Note, Panel, Points, Segments
from ..charts.needs import needs
from .levels_over_speed import SHADED, spans

LOUD_DB: Final = 10.0
"""Crossings at which the line is within this of all that is modelled are marked large."""
_LOW_ORDERS: Final = (1.0, 2.0, 3.0, 4.0)
"""Drawn over the modes on the mounts."""
_TONE: Final = "#777777"
_COLOURS: Final = dict(zip(KINDS, (COLOURS[5], COLOURS[3], COLOURS[2]), strict=True))
_WORDS: Final = {KINDS[0]: "on the mounts"}
_HEIGHTS: Final = (3.6, 1.9)


@needs("natural_frequency", "pressure_line")
def campbell(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    beside: xr.Dataset | None = None,
) -> Chart:
    """Campbell diagram: modes of shell and gas above, on the mounts below, lines of sound across.

    Lines are the eight loudest orders and four loudest other tones after weighting by A, below
    orders 1 to 4. Crossings are marked, large where the line is within 10 dB of the modelled level.
    Speeds to avoid are shaded. Natural frequencies are nominal values, without loss.

    Parameters
    ----------
    results : results of `run` at two speeds at least; needs `natural_frequency` (mode), Hz, and
        `pressure_line`; with `shell_frequency` and `gas_frequency` these modes
    receiver : one of the microphones; default: that of the catalogue's noise
    option : one of the results
    beside : other results, whose modes are dashed
    """
    microphone = chosen(results, "receiver", receiver or catalogue_receiver(results))
    option = chosen(results, "option", option)
    sorted_by_speed = results.sortby("speed")
    speed = sorted_by_speed["speed"].values
    level = sorted_by_speed["level_modelled"].sel(option=option, receiver=microphone, weighting="A")
    modes, others = modes_of(results), [] if beside is None else modes_of(beside)
    avoided = speeds_to_avoid(results, microphone, [option])
    causes = {each.line for each in avoided if each.quantity == LEVEL}
    low_orders = [
        SoundLine(f"{k:g}×", k, k * speed / 60.0, np.full(speed.size, np.nan)) for k in _LOW_ORDERS
    ]
    lines = loudest_lines(results, microphone, option, causes)
    room = 0.0 if speed.size > 1 else 0.1 * speed[0]
    x = Axis("Speed, rpm", limits=(float(speed.min() - room), float(speed.max() + room)))
    shaded = spans([each.range for each in avoided])
    panels: list[Panel] = []
    for is_low, orders in ((False, lines), (True, low_orders)):
        of_panel, dashed = ([m for m in some if (m.kind == KINDS[0]) == is_low]
                            for some in (modes, others))  # fmt: skip
        if not (of_panel or is_low):
            continue
        top = _highest(of_panel, orders, is_low)
        met = crossings(orders, of_panel, speed, level.values)
        rows = (_modes(of_panel, "-"), _modes(dashed, "--"), _lines(orders, speed, top))
        marks = (*shaded, *(m for row in rows for m in row), *_marks(met, all_alike=is_low))
        title = "" if panels else shortened(f"{microphone}, option {option}", 90)
        y = Axis("Frequency, Hz", limits=(0.0, top))
        panels.append(Panel(x, y, marks, title, _HEIGHTS[is_low]))
    return Chart(*_words(microphone, option, beside is not None), stacked(panels), wide=True)


def _words(microphone: str, option: str, of_two: bool) -> tuple[str, str, str]:
    """Return name, text in its place and caption."""
    if of_two:
        return (
            "compared_campbell",
            "Campbell diagram: lines of A over the speed, natural frequencies of both results.",
            f"Campbell diagram: lines, crossings and speeds to avoid of A, option {option}. "
            "Natural frequencies: solid of A, dashed of B.",
        )
    return (
        "campbell",
        "Campbell diagram: orders and tones over the speed, natural frequencies of mounts, shell "
        "and gas as level lines.",
        "Campbell diagram: level lines are natural frequencies, sloping ones orders, dotted ones "
        f"other tones, the loudest at {microphone}. Large dots: crossings where the line is within "
        f"{LOUD_DB:g} dB of all that is modelled. {SHADED}",
    )


def _highest(modes: Sequence[Mode], lines: Sequence[SoundLine], is_low: bool) -> float:
    """Return the top of a panel, Hz: above the modes; on the mounts above order 1 too."""
    highest = max((mode.frequency_hz for mode in modes), default=0.0)
    first = float(lines[0].frequency_hz.max()) if lines else 0.0
    return 1.15 * max(highest, first) if is_low else 1.03 * highest


def _modes(modes: Sequence[Mode], dash: str) -> Iterator[Segments]:
    """Yield the natural frequencies of each kind as level lines."""
    for kind in KINDS:
        level_hz = [mode.frequency_hz for mode in modes if mode.kind == kind]
        ends = np.full(len(level_hz), np.nan)
        if level_hz:
            words = _WORDS.get(kind, kind) if dash == "-" else ""
            yield Segments(ends, level_hz, ends, level_hz, words, _COLOURS[kind], dash, 0.8)


def _lines(lines: Sequence[SoundLine], speed_rpm: Array, highest_hz: float) -> Iterator[Mark]:
    """Yield orders and tones, each with its name where it leaves the panel."""
    for line in lines:
        colour, dash = (_TONE, ":") if np.isnan(line.order) else (COLOURS[0], "-")
        yield Line(speed_rpm, line.frequency_hz, colour=colour, dash=dash, width=0.9)
        visible = np.flatnonzero(line.frequency_hz <= highest_hz)
        if visible.size:
            yield _name(line, visible, speed_rpm, highest_hz)


def _name(line: SoundLine, visible: IndexArray, speed_rpm: Array, highest_hz: float) -> Note:
    """Return the name of a tone at its first speed, or of an order at its last one."""
    words = shortened(line.name, 22)
    if np.isnan(line.order):
        x, y = (float(values[visible[0]]) for values in (speed_rpm, line.frequency_hz))
        return Note(x, y, words, _TONE, shift=(3.0, 3.0))
    y = min(highest_hz, line.order * float(speed_rpm[-1]) / 60.0)
    below = -9.0 if y > 0.96 * highest_hz else 3.0
    x = 60.0 * y / line.order
    if x < 0.98 * speed_rpm[-1]:
        return Note(x, y, words, COLOURS[0], "left", (2.0, below))
    return Note(x, y, words, COLOURS[0], "right", (-3.0, below))


def _marks(met: Sequence[Crossing], all_alike: bool) -> Iterator[Points]:
    """Yield dots where lines meet modes, large where they are loud."""
    for is_loud, size, colour, words in (
        (False, 3.0, COLOURS[0], "crossing"),
        (True, 6.5, COLOURS[1], "loud crossing"),
    ):
        some = [each for each in met
                if (not all_alike and each.below_modelled_db <= LOUD_DB) == is_loud]  # fmt: skip
        if some:
            speeds = [each.speed_rpm for each in some]
            hertz = [each.mode.frequency_hz for each in some]
            yield Points(speeds, hertz, words, colour=colour, marker="o", size=size)
