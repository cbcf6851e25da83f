"""Campbell diagram: lines of sound over the speed, natural frequencies, where both meet."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ...base.arrays import Array
from ...base.vocabulary import REFERENCE_OPTION
from ...results.over_speed.avoid import LEVEL, speeds_to_avoid
from ...results.over_speed.modes import KINDS, Crossing, Mode, crossings, modes_of
from ...results.over_speed.sound_lines import SoundLine, loudest_lines
from ...results.stored_study import catalogue_receiver
from ..charts.needs import needs
from ..titles import chosen
from .style import COLOURS, WIDTH_INCH, draw, shade, shortened

LOUD_DB: Final = 10.0
"""Crossings at which the line is within this of all that is modelled are marked large."""
_LOW_ORDERS: Final = (1.0, 2.0, 3.0, 4.0)
"""Drawn over the modes on the mounts."""
_TONE: Final = "#777777"
_COLOURS: Final = dict(zip(KINDS, (COLOURS[5], COLOURS[3], COLOURS[2]), strict=True))


@needs("natural_frequency", "pressure_line")
def campbell(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    beside: xr.Dataset | None = None,
    width_inch: float = WIDTH_INCH,
) -> Figure:
    """Campbell diagram: modes of shell and gas above, on the mounts below, lines of sound across.

    Lines are the eight loudest orders and four loudest other tones after weighting by A, below
    orders 1 to 4. Crossings are marked, large where the line is within 10 dB of the modelled level.
    Speeds to avoid are shaded. Natural frequencies are those of the values as given, without loss.

    Parameters
    ----------
    results : of `run` at two speeds at least; needs `natural_frequency` (mode), Hz, and
        `pressure_line`; with `shell_frequency` and `gas_frequency` these modes
    receiver : one of the microphones; default: that of the catalogue's noise
    option : one of the results
    beside : other results, whose modes are dashed
    width_inch : of the figure

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver or option.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.campbell(results).savefig("campbell.png")
    """
    at = chosen(results, "receiver", receiver or catalogue_receiver(results))
    option = chosen(results, "option", option)
    sorted_by_speed = results.sortby("speed")
    speed = sorted_by_speed["speed"].values
    level = sorted_by_speed["level_modelled"].sel(option=option, receiver=at, weighting="A")
    modes, others = modes_of(results), [] if beside is None else modes_of(beside)
    above = [mode for mode in modes if mode.kind != KINDS[0]]
    below = [mode for mode in modes if mode.kind == KINDS[0]]
    avoided = speeds_to_avoid(results, at, [option])
    causes = {one.line for one in avoided if one.quantity == LEVEL}
    lines, low = loudest_lines(results, at, option, causes), _low_orders(speed)
    parts = [(above, lines)] * bool(above) + [(below, low)]

    def paint(panels: Sequence[Axes]) -> None:
        loud = False
        for axes, (of_panel, drawn) in zip(panels, parts, strict=True):
            is_low = drawn is low
            dashed = [mode for mode in others if (mode.kind == KINDS[0]) == is_low]
            _modes(axes, of_panel, dashed, speed)
            _lines(axes, drawn, speed, _highest(of_panel, drawn, is_low))
            met = crossings(drawn, of_panel, speed, level.values)
            loud = _marks(axes, met, all_alike=is_low) or loud
            for one in avoided:
                shade(axes, one.range.from_rpm, one.range.to_rpm)
            axes.set_ylabel("Frequency, Hz")
        panels[0].set_title(shortened(f"{at}, option {option}"), loc="left")
        panels[-1].set_xlabel("Speed, rpm")
        _legend(panels[0], [mode.kind for mode in modes], loud)

    heights = {"height_ratios": [2.2, 1.0]} if above else {}
    return draw(len(parts), 2.6, paint, 1, width_inch, sharex=True, gridspec_kw=heights)


def _low_orders(speed_rpm: Array) -> list[SoundLine]:
    silent = np.full(speed_rpm.size, np.nan)
    return [SoundLine(f"{k:g}×", k, k * speed_rpm / 60.0, silent) for k in _LOW_ORDERS]


def _highest(modes: Sequence[Mode], lines: Sequence[SoundLine], is_low: bool) -> float:
    """Top of a panel, Hz: above the modes; on the mounts above order 1 too."""
    highest = max((mode.frequency_hz for mode in modes), default=0.0)
    first = float(lines[0].frequency_hz.max()) if lines else 0.0
    return 1.15 * max(highest, first) if is_low else 1.03 * highest


def _modes(axes: Axes, modes: Sequence[Mode], others: Sequence[Mode], speed_rpm: Array) -> None:
    for some, dash in ((modes, "-"), (others, "--")):
        for mode in some:
            axes.axhline(
                mode.frequency_hz, color=_COLOURS[mode.kind], linestyle=dash, lw=0.8, alpha=0.75
            )
    room = 0.0 if speed_rpm.size > 1 else 0.1 * speed_rpm[0]
    axes.set_xlim(speed_rpm.min() - room, speed_rpm.max() + room)


def _lines(axes: Axes, lines: Sequence[SoundLine], speed_rpm: Array, highest_hz: float) -> None:
    """Orders and tones, each with its name where it leaves the panel."""
    axes.set_ylim(0.0, highest_hz)
    axes.grid(visible=False)
    for line in lines:
        is_tone = np.isnan(line.order)
        colour, dash = (_TONE, ":") if is_tone else (COLOURS[0], "-")
        axes.plot(speed_rpm, line.frequency_hz, dash, color=colour, lw=0.9, label=line.name)
        within = np.flatnonzero(line.frequency_hz <= highest_hz)
        if not within.size:
            continue
        last = within[-1]
        leaves = last < speed_rpm.size - 1  # through the top
        axes.annotate(
            shortened(line.name, 22), (speed_rpm[last], line.frequency_hz[last]),
            xytext=(-7, -1) if leaves else (-3, 1), textcoords="offset points", fontsize=6.5,
            ha="right", va="top" if leaves else "bottom", color=colour,
        )  # fmt: skip


def _marks(axes: Axes, met: Sequence[Crossing], all_alike: bool) -> bool:
    """Dots where lines meet modes; whether there are loud ones."""
    is_loud = [not all_alike and one.below_modelled_db <= LOUD_DB for one in met]
    loud, quiet = (
        [one for one, is_it in zip(met, is_loud, strict=True) if is_it == wanted]
        for wanted in (True, False)
    )
    for some, size, colour, words in (
        (quiet, 2.5, COLOURS[0], "crossings"),
        (loud, 5.5, COLOURS[1], "loud crossings"),
    ):
        axes.plot(
            [one.speed_rpm for one in some], [one.mode.frequency_hz for one in some],
            linestyle="none", marker="o", markersize=size, color=colour, label=words,
        )  # fmt: skip
    return bool(loud)


def _legend(axes: Axes, kinds: Sequence[str], loud: bool) -> None:
    """What the colours are."""
    words = {"mounts": "on the mounts", "shell": "shell", "gas": "gas"}
    handles = [
        Line2D([], [], color=_COLOURS[kind], label=words[kind]) for kind in KINDS if kind in kinds
    ]
    if loud:
        dot = Line2D([], [], linestyle="none", marker="o", markersize=5.5)
        dot.set(color=COLOURS[1], label="loud crossing")
        handles.append(dot)
    figure = axes.get_figure()
    if figure is not None:
        figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
