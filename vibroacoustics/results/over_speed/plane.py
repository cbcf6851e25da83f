"""Levels over speed and frequency, of a study's lines or a recording's spectra."""

from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array
from ...base.decibel import level_of_power, power_of_level, sound_pressure_level
from ...base.vocabulary import REFERENCE_OPTION
from ..map_levels import map_level
from ..stored_study import catalogue_receiver
from ..titles import chosen
from .level_curves import is_run_up

FINEST_HZ: Final = 5.0
MOST_COLUMNS: Final = 600
MOST_ROWS: Final = 300
"""Largest numbers of a map: more would be finer than a picture."""
CLOSE_RATIO: Final = 0.1
"""Ratio of speeds between which lines of a study are drawn through, level and
frequency linear."""


class Plane(NamedTuple):
    """Levels over two axes.

    Attributes
    ----------
    title : title of the map
    frequency_hz : shape (column,)
    along : rising speed, rpm, or time, s, shape (row,)
    is_speed : whether it is speed
    level_db : shape (row, column)
    unit : with its reference
    """

    title: str
    frequency_hz: Array
    along: Array
    is_speed: bool
    level_db: Array
    unit: str


def plane_of(
    results: xr.Dataset, channel: str | None = None, option: str = REFERENCE_OPTION
) -> Plane:
    """The map of a microphone or channel.

    A study gives the power of all lines within a step of frequency, without noise. More rows or
    columns than a picture shows are reduced to the loudest of neighbours.
    """
    plane = (
        _recorded(results, channel)
        if "speed_frequency_map" in results
        else _of_study(results, channel, option)
    )
    return _fewer(plane)


def _recorded(mapped: xr.Dataset, channel: str | None) -> Plane:
    name = chosen(mapped, "channel", channel)
    is_speed = is_run_up(mapped["block_speed"])
    along = "block_speed" if is_speed else "block_time"
    spectra = mapped["speed_frequency_map"].sel(channel=name).sortby(along)
    spectra = spectra.transpose("block", "map_frequency")
    unit = str(mapped["channel_unit"].sel(channel=name).item())
    level, label = map_level(spectra.values, unit)
    frequency = spectra["map_frequency"].values
    return Plane(str(name), frequency, spectra[along].values, is_speed, level, label)


def _of_study(results: xr.Dataset, receiver: str | None, option: str) -> Plane:
    case = {
        "receiver": chosen(results, "receiver", receiver or catalogue_receiver(results)),
        "option": chosen(results, "option", option),
    }
    pressure = results["pressure_line"].sel(case).sum("sound_source").sortby("speed")
    pressure = pressure.transpose("speed", "line")
    tones = pressure["tone_frequency"].transpose("speed", "line").values
    rows = _between(pressure["speed"].values)
    speed, hertz, level = (
        _at_rows(values, rows)
        for values in (pressure["speed"].values, tones, sound_pressure_level(pressure.values))
    )
    step = max(FINEST_HZ, float(np.nanmax(hertz)) / MOST_COLUMNS)
    columns = 1 + int(np.nanmax(hertz) / step)
    column = np.floor(np.nan_to_num(hertz) / step).astype(int)
    audible = np.where(hertz > 0.0, power_of_level(np.nan_to_num(level)), 0.0)
    total = np.zeros((speed.size, columns))
    for row, (where, of_lines) in enumerate(zip(column, audible, strict=True)):
        total[row] = np.bincount(where, of_lines, minlength=columns)
    middles = np.asarray(step * (np.arange(columns) + 0.5))
    title = f"{case['receiver']}, option {option}"
    level = np.asarray(level_of_power(total))
    return Plane(title, middles, speed, True, level, "dB re 20 µPa")


def _between(speed_rpm: Array) -> Array:
    """Rows of a map as numbers of the speeds, with parts of these between neighbours."""
    gaps = np.diff(speed_rpm)
    if not gaps.size or np.any(gaps > CLOSE_RATIO * speed_rpm[1:]):
        return np.arange(speed_rpm.size, dtype=float)
    parts = max(1, MOST_ROWS // speed_rpm.size)
    return np.asarray(np.linspace(0.0, gaps.size, parts * gaps.size + 1))


def _at_rows(values: Array, rows: Array) -> Array:
    """Values (speed, ...) at parts of the way to the next speed, linear in between."""
    first = np.minimum(rows.astype(int), len(values) - 1)
    second = np.minimum(first + 1, len(values) - 1)
    share = (rows - first).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(
        np.where(
            share == 0.0, values[first], (1.0 - share) * values[first] + share * values[second]
        )
    )


def _fewer(plane: Plane) -> Plane:
    """Return a plane with no more rows and columns than a picture shows."""
    level, along = _loudest(plane.level_db, plane.along, MOST_ROWS)
    level, frequency = _loudest(level.T, plane.frequency_hz, MOST_COLUMNS + 1)
    return plane._replace(level_db=level.T, along=along, frequency_hz=frequency)


def _loudest(level: Array, along: Array, most: int) -> tuple[Array, Array]:
    """Rows in groups of neighbours, and the middles of these."""
    size = -(-along.size // most)
    if size == 1:
        return level, along
    first = np.arange(0, along.size, size)
    counts = np.diff(np.append(first, along.size))
    return np.maximum.reduceat(level, first), np.add.reduceat(along, first) / counts
