"""Lines of a study's sound over the speed, and its natural frequencies that they cross."""

from collections.abc import Collection, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.decibel import sound_pressure_level
from ...base.rounding import LEVEL_FLOOR_DB
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import WEIGHTING
from .. import labels
from ..stored_study import catalogue_receiver, words

MOST_ORDERS: Final = 8
MOST_TONES: Final = 4
ALWAYS: Final = (1.0, 2.0)
"""Orders that are among them."""


class SoundLine(NamedTuple):
    """A line over the speeds.

    Attributes
    ----------
    name : `4×`, or that of the tone
    order : not a number of a tone
    frequency_hz : not a number where there is none, shape (speed,)
    level_db : A-weighted, of all sources, shape (speed,)
    """

    name: str
    order: float
    frequency_hz: Array
    level_db: Array


def loudest_lines(
    results: xr.Dataset,
    receiver: str | None = None,
    option: str = REFERENCE_OPTION,
    also: Collection[str] = (),
) -> list[SoundLine]:
    """The loudest orders and tones anywhere over the rising speeds, and `also` lines by name."""
    lines = sound_lines(results, receiver, option)
    orders = [line for line in lines if line.order > 0.0]
    tones = [line for line in lines if np.isnan(line.order)]
    always = {*also, *(line.name for line in orders if line.order in ALWAYS)}
    kept = _first(orders, always, MOST_ORDERS)
    return sorted(kept, key=lambda line: line.order) + _first(tones, always, MOST_TONES)


def sound_lines(
    results: xr.Dataset, receiver: str | None = None, option: str = REFERENCE_OPTION
) -> list[SoundLine]:
    """All lines of the sum of the sources, by rising speed; at the microphone of the catalogue."""
    case = {"option": option, "receiver": receiver or catalogue_receiver(results)}
    pressure = results["pressure_line"].sel(case).sum("sound_source").sortby("speed")
    pressure = pressure.transpose("line", "speed")
    hertz = pressure["tone_frequency"].transpose("line", "speed").values
    audible = np.where(hertz > 0.0, hertz, 1.0)
    level = sound_pressure_level(pressure.values) + WEIGHTING["A"](audible)
    return [
        SoundLine(_name(str(name), float(order)), float(order), of_line, level_db)
        for name, order, of_line, level_db in zip(
            pressure["line"].values, pressure["line_order"].values, hertz, level, strict=True
        )
    ]


def _first(lines: list[SoundLine], always: Collection[str], most: int) -> list[SoundLine]:
    """Those of some names, and of the others the loudest."""
    named = [line for line in lines if line.name in always]
    others = [line for line in lines if line.name not in always]
    return named + _ranked(others)[: max(0, most - len(named))]


def _ranked(lines: list[SoundLine]) -> list[SoundLine]:
    """Those above the floor, the loudest first."""
    loud = [line for line in lines if line.level_db.max() > LEVEL_FLOOR_DB]
    return sorted(loud, key=lambda line: -float(line.level_db.max()))


def _name(name: str, order: float) -> str:
    return name.replace("_", " ") if np.isnan(order) else f"{order:g}×"


KINDS: Final = ("mounts", "shell", "gas")
_FIGURE: Final = "_mode_hz"
"""Ending of reported figures that are natural frequencies of gas."""


class Mode(NamedTuple):
    """A natural frequency.

    Attributes
    ----------
    kind : kind, one of KINDS
    name : within its kind
    frequency_hz : without loss
    """

    kind: str
    name: str
    frequency_hz: float

    @property
    def words(self) -> str:
        """`shell n2_1_cos, 504 Hz`."""
        digits = 1 if self.frequency_hz < 100.0 else 0
        return f"{self.kind} {self.name}, {self.frequency_hz:.{digits}f} Hz"


class Crossing(NamedTuple):
    """Crossing of a line and a mode; its level there, of the modelled one, dB."""

    line: SoundLine
    mode: Mode
    speed_rpm: float
    below_modelled_db: float


def modes_of(results: xr.Dataset) -> list[Mode]:
    """Return the modes on the mounts, of the shell (with its frame) and of gas, with nominal
    values."""
    kept_in = {"mounts": ("natural_frequency", "mode"), "shell": ("shell_frequency", "shell_mode"),
                "gas": ("gas_frequency", "gas_mode")}  # fmt: skip
    modes = [
        Mode(kind, str(name).removeprefix("mode_").replace("_", " "), float(hertz))
        for kind, (variable, dim) in kept_in.items()
        if variable in results
        for name, hertz in zip(results[dim].values, results[variable].values, strict=True)
    ]
    return modes + [
        Mode("gas", labels.name(name, words(results)).lower(), hertz)
        for name, hertz in _reported(results).items()
    ]


def crossing_speeds(speed_rpm: Array, line_hz: Array, mode_hz: float) -> Array:
    """Speeds at which a line has a frequency, between the speeds that are known, rpm.

    Linear in between, which is exact for an order: n = 60 f/k.

    Parameters
    ----------
    speed_rpm : rising, shape (speed,)
    line_hz : not a number where there is no such line, shape (speed,)
    mode_hz : the frequency
    """
    above = line_hz - mode_hz
    first, second = above[:-1], above[1:]
    is_finite = np.isfinite(first) & np.isfinite(second)
    meets = is_finite & ((first < 0.0) != (second < 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        share = first / (first - second)
    return np.asarray((speed_rpm[:-1] + share * np.diff(speed_rpm))[meets])


def crossings(
    lines: Sequence[SoundLine], modes: Sequence[Mode], speed_rpm: Array, modelled_db: Array
) -> list[Crossing]:
    """All, from the slowest to the fastest.

    Parameters
    ----------
    lines : with frequency and level at the speeds
    modes : natural frequencies
    speed_rpm : rising, shape (speed,)
    modelled_db : level of all lines and noise, shape (speed,)
    """
    met = []
    for line in lines:
        below = modelled_db - line.level_db
        for mode in modes:
            for rpm in crossing_speeds(speed_rpm, line.frequency_hz, mode.frequency_hz):
                db = float(np.interp(rpm, speed_rpm, below))
                met.append(Crossing(line, mode, float(rpm), db))
    return sorted(met, key=lambda crossing: crossing.speed_rpm)


def _reported(results: xr.Dataset) -> dict[str, float]:
    """Natural frequencies among the reported figures, mean over speeds and options."""
    figures = results["reported_figure"]
    names = [str(name) for name in figures["figure"].values if str(name).endswith(_FIGURE)]
    means = {name: float(figures.sel(figure=name).mean()) for name in names}
    return {name: hertz for name, hertz in means.items() if np.isfinite(hertz)}
