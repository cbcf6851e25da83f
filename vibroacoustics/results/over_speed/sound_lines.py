"""Lines of a study's sound over the speed: shaft orders and other tones, the loudest of them."""

from collections.abc import Collection
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.decibel import sound_pressure_level
from ...base.rounding import LEVEL_FLOOR_DB
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import WEIGHTING
from ..stored_study import catalogue_receiver

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
