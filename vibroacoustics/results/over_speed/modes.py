"""Natural frequencies of a study, and the speeds at which lines of its sound cross them."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from .. import labels
from ..stored_study import words
from .sound_lines import SoundLine

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
