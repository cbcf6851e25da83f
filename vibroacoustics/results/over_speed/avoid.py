"""Speeds to avoid: where level or foot force stands out, and the line and mode case."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
import scipy  # loads its subpackages when they are needed
import xarray as xr

from ...base.arrays import Array
from ...base.decibel import level_of_amplitude, level_of_power, power_of_level
from ...base.rounding import FORCE_FLOOR, LEVEL_FLOOR_DB
from ...base.vocabulary import REFERENCE_OPTION
from ..stored_study import catalogue_receiver, options
from .modes import Mode, modes_of, sound_lines

STANDS_OUT_DB: Final = 3.0
"""Prominence of a maximum over the higher of the two valleys beside it: twice the power."""
WITHIN_DB: Final = 3.0
"""Speeds whose level is within this of the maximum are avoided with it: half the power."""
NEAR_RATIO: Final = 0.05
"""A line and a mode that differ by no more than this share meet."""
BINS: Final = 50
"""Steps of speed over which blocks of a recording are averaged."""
LEVEL: Final = "modelled level"
FOOT_FORCE: Final = "force into a foot"


class Range(NamedTuple):
    """Speeds to avoid.

    Attributes
    ----------
    from_rpm, to_rpm : ends
    peak_rpm : where it is largest
    peak_db : level case
    above_db : over the higher valley beside it
    """

    from_rpm: float
    to_rpm: float
    peak_rpm: float
    peak_db: float
    above_db: float


class Avoided(NamedTuple):
    """A range with what stands out case.

    Attributes
    ----------
    option : option of the study
    quantity : LEVEL or FOOT_FORCE
    range : range of speeds
    line : name of the strongest line at the maximum
    line_hz : its frequency
    mode : nearest to it; none where none is near
    """

    option: str
    quantity: str
    range: Range
    line: str
    line_hz: float
    mode: Mode | None


def ranges_to_avoid(speed_rpm: Array, level_db: Array) -> list[Range]:
    """Maxima that stand out, with the speeds around them; a maximum at an end is none.

    Parameters
    ----------
    speed_rpm : rising, shape (speed,)
    level_db : shape (speed,)
    """
    peaks, of_peaks = scipy.signal.find_peaks(level_db, prominence=STANDS_OUT_DB)
    return [
        Range(
            _falls_to(speed_rpm[peak::-1], level_db[peak::-1]),
            _falls_to(speed_rpm[peak:], level_db[peak:]),
            float(speed_rpm[peak]),
            float(level_db[peak]),
            float(above),
        )
        for peak, above in zip(peaks, of_peaks["prominences"], strict=True)
    ]


def speeds_to_avoid(
    results: xr.Dataset, receiver: str | None = None, of: Sequence[str] = (REFERENCE_OPTION,)
) -> list[Avoided]:
    """Return maxima of the modelled A-weighted level and of the foot force with options."""
    microphone = receiver or catalogue_receiver(results)
    every = modes_of(results)
    on_mounts = [mode for mode in every if mode.kind == "mounts"]
    avoided = []
    for option in of:
        for quantity, modes in ((LEVEL, every), (FOOT_FORCE, on_mounts)):
            speed, level, names, hertz, lines = _curves(results, option, microphone, quantity)
            floor = LEVEL_FLOOR_DB if quantity == LEVEL else level_of_amplitude(FORCE_FLOOR)
            for span in ranges_to_avoid(speed, np.maximum(level, floor)):
                peak = int(np.flatnonzero(speed == span.peak_rpm)[0])
                strongest = int(np.argmax(lines[:, peak]))
                frequency = float(hertz[strongest, peak])
                avoided.append(
                    Avoided(option, quantity, span, names[strongest], frequency,
                            _nearest(modes, frequency))
                )  # fmt: skip
    return avoided


def recorded_speeds_to_avoid(speed_rpm: Array, level_db: Array, bins: int = BINS) -> list[Range]:
    """Return those of a recording, from energy means in equal steps of speed, as blocks scatter.

    Parameters
    ----------
    speed_rpm, level_db : speed and level of the blocks, shape (block,)
    bins : steps
    """
    edges = np.linspace(speed_rpm.min(), speed_rpm.max(), bins + 1)
    step = np.clip(np.digitize(speed_rpm, edges) - 1, 0, bins - 1)
    counts = np.bincount(step, minlength=bins)
    power = np.bincount(step, power_of_level(level_db), minlength=bins)
    some = counts > 0
    middles = (0.5 * (edges[1:] + edges[:-1]))[some]
    return ranges_to_avoid(middles, np.asarray(level_of_power(power[some] / counts[some])))


def _falls_to(speed_rpm: Array, level_db: Array) -> float:
    """Speed at which the level has fallen so far, going on from case; linear in between."""
    wanted = level_db[0] - WITHIN_DB
    after = int(np.argmax(level_db <= wanted))
    share = (level_db[after - 1] - wanted) / (level_db[after - 1] - level_db[after])
    return float(speed_rpm[after - 1] + share * (speed_rpm[after] - speed_rpm[after - 1]))


def _nearest(modes: Sequence[Mode], frequency_hz: float) -> Mode | None:
    off = {mode: abs(mode.frequency_hz / frequency_hz - 1.0) for mode in modes}
    nearest = min(off, key=off.__getitem__, default=None)
    return nearest if nearest is not None and off[nearest] <= NEAR_RATIO else None


def _curves(
    results: xr.Dataset, option: str, receiver: str, quantity: str
) -> tuple[Array, Array, list[str], Array, Array]:
    """Speeds, level, names of lines, their frequencies and levels (line, speed)."""
    case = results.sel(option=option).sortby("speed")
    speed = case["speed"].values
    if quantity == LEVEL:
        level = case["level_modelled"].sel(receiver=receiver, weighting="A").values
        lines = sound_lines(results, receiver, option)
        names = [line.name for line in lines]
        hertz, levels = (
            np.stack([getattr(line, field) for line in lines])
            for field in ("frequency_hz", "level_db")
        )
        return speed, level, names, hertz, levels
    foot = case["foot_force_amplitude"].max("foot").transpose("order", "speed")
    orders = foot["order"].values[1:]
    names, force = [f"{order:g}×" for order in orders], foot.values[1:]
    hertz = orders[:, None] * speed / 60.0
    levels = np.asarray(level_of_amplitude(force))
    return speed, np.asarray(level_of_power(np.sum(force**2, axis=0))), names, hertz, levels


def avoided(results: xr.Dataset) -> list[Avoided]:
    """Return those of all options at the published microphone, the most prominent first."""
    every = speeds_to_avoid(results, catalogue_receiver(results), options(results))
    return sorted(every, key=lambda each: -each.range.above_db)
