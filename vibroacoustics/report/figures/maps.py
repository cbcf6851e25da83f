"""Levels at unit velocity over frequency and on a plane, and levels on a plane."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import amplitude_of_level, level_of_amplitude
from ...base.vocabulary import REFERENCE_OPTION
from ...results.labels import DOF_WORDS
from ..charts.layout import wrapped
from ..charts.marks import Axis, Chart, Image, Line, Note, Panel, frequency_axis
from ..charts.needs import needs
from ..shown_speeds import few_speeds

DEPTH_DB: Final = 40.0
"""Depth: what is further below the loudest has one colour, or is the centre of a polar chart."""
SILENT_DB: Final = 60.0
"""A motion whose sound is this far below the loudest of its unit counts as silent."""
UNIT_VELOCITY: Final = 1e-3
"""1 mm/s or 1 mrad/s, root mean square."""
_COLUMNS: Final = 3
_WIDE: Final = 1.9
"""Width of a map in a row of three, inch."""


def unit_level_db(pressure_per_velocity: ComplexArray | Array) -> Array:
    """Level at 1 mm/s or 1 mrad/s, dB re 20 µPa; both root mean squares, so no factor of √2."""
    ratio = UNIT_VELOCITY * np.abs(pressure_per_velocity) / REFERENCE_PRESSURE_PA
    return np.asarray(level_of_amplitude(ratio))


def unit_words(dof: str) -> str:
    """The velocity that levels of a degree of freedom hold at."""
    return "1 mrad/s" if dof.startswith("r") else "1 mm/s"


def dof_title(dof: str) -> str:
    """Return the motion and its size as the head of a panel."""
    words = f": {DOF_WORDS[dof]}" if dof in DOF_WORDS else ""
    return f"{dof}{words}, {unit_words(dof)}"


def names(field: xr.DataArray, dim: str) -> list[str]:
    """Labels of a dimension."""
    return [str(name) for name in field[dim].values]


def silent_dofs(field: ComplexArray, dofs: Sequence[str]) -> list[str]:
    """Those far below the loudest of the same unit; field (dof, ...)."""
    size = np.nanmax(np.abs(field).reshape(len(dofs), -1), axis=1)
    units = np.array([unit_words(dof) for dof in dofs])
    loudest = np.array([size[units == unit].max() for unit in units])
    is_silent = size <= amplitude_of_level(-SILENT_DB) * loudest
    return [dof for dof, silent in zip(dofs, is_silent, strict=True) if silent]


def silent_panel(title: str, height: float) -> Panel:
    """Return a panel that says that it is meant to be empty."""
    empty = Axis(limits=(0.0, 1.0), ticks=())
    return Panel(empty, empty, (Note(0.5, 0.5, "no sound here", align="center"),), title, height)


@needs("map_transfer_vector", from_="`radiate` of a study with a table radiation.map")
def unit_level_map(radiated: xr.Dataset) -> Chart:
    """Level on a plane at 1 mm/s or 1 mrad/s, dB, at the highest 1x line: a panel a motion.

    Parameters
    ----------
    radiated : result of `radiate`; needs `map_transfer_vector`
        (map_row, map_column, dof, line_frequency), Pa s/m
    """
    field = radiated["map_transfer_vector"].isel(line_frequency=-1)
    field = field.transpose("dof", "map_row", "map_column")
    dofs, frequency = names(field, "dof"), float(field["line_frequency"])
    silent = silent_dofs(field.values, dofs)
    levels = {
        dof_title(dof): None if dof in silent else unit_level_db(values)
        for dof, values in zip(dofs, field.values, strict=True)
    }
    return Chart(
        "map",
        f"Sound pressure level on a plane at {frequency:.1f} Hz for motion in each degree of "
        "freedom; the blank area is the machine and its near surroundings.",
        f"Level on the plane at {frequency:.1f} Hz when the housing moves at 1 mm/s or turns at "
        "1 mrad/s (root mean square) in one degree of freedom; coordinates from the centre "
        f"of mass. Blank: the box around the machine. Darkest: {DEPTH_DB:g} dB and more below the "
        "loudest of the row.",
        tuple(_maps(radiated, levels)),
        min(_COLUMNS, len(dofs)),
        wide=True,
    )


@needs("map_level", from_="`run` of a study with a table radiation.map")
def line_map(results: xr.Dataset) -> Chart:
    """Level of the 1x line without a balancer on a plane, dB: a panel a speed (six at most).

    Parameters
    ----------
    results : results of `run`; needs `map_level` (speed, option, map_row, map_column), dB
    """
    level = few_speeds(results)["map_level"].sel(option=REFERENCE_OPTION)
    level = level.transpose("speed", "map_row", "map_column")
    levels = {f"{of_speed['speed'].item():g} rpm": of_speed.values for of_speed in level}
    return Chart(
        "line_map",
        "Sound pressure level of the 1x line on a plane, one panel a speed.",
        "Level of the 1x line on the plane, option none, by speed; coordinates from the centre of "
        "mass. Blank: the box around the machine, and what is behind a wall.",
        tuple(_maps(results, levels)),
        min(_COLUMNS, len(levels)),
        wide=True,
    )


def _maps(radiated: xr.Dataset, levels: dict[str, Array | None]) -> Iterator[Panel]:
    """Maps by title, none for silence; those of a row share one scale of colours."""
    (across, x), (up, y) = _plane(radiated)
    shape = float(np.ptp(up)) / max(float(np.ptp(across)), 1e-9)
    height = min(_WIDE * shape, 6.0) * (_COLUMNS / min(_COLUMNS, len(levels))) + 0.9
    named = list(levels.items())
    for start in range(0, len(named), _COLUMNS):
        row = named[start : start + _COLUMNS]
        loud = [level for _, level in row if level is not None]
        top = max((float(np.nanmax(level)) for level in loud), default=0.0)
        bottom = min((float(np.nanmin(level)) for level in loud), default=0.0)
        scale = (max(bottom, top - DEPTH_DB), top)
        for title, level in row:
            if level is None:
                yield silent_panel(title, height)
                continue
            image = Image(across, up, level, scale, "dB re 20 µPa", _contours(*scale))
            yield Panel(Axis(x), Axis(y), (image,), title, height, equal=True)


def _contours(low: float, high: float) -> tuple[float, ...]:
    """Round levels inside the scale: few enough to be labelled."""
    step = next((step for step in (10.0, 5.0, 2.0) if high - low >= 2.5 * step), 1.0)
    return tuple(np.arange(step * np.floor(low / step + 1.0), high - 1e-9, step).tolist())


def _plane(radiated: xr.Dataset) -> list[tuple[Array, str]]:
    """Coordinates of columns and of rows with the names of their axes; the third is constant."""
    coordinates = {name: radiated[f"map_{name}"].values for name in "xyz"}
    normal = min(coordinates, key=lambda name: float(np.ptp(coordinates[name])))
    across, up = [name for name in "xyz" if name != normal]
    return [(coordinates[across][0], f"{across}, m"), (coordinates[up][:, 0], f"{up}, m")]


CURVE_DEPTH_DB: Final = 100.0
"""Curves are cut off this far below the loudest of their panel."""
_HEIGHT: Final = 2.4


@needs("transfer_vector", from_="`radiate` and `run`")
def transfer_vectors(radiated: xr.Dataset) -> Chart:
    """Level at every microphone over frequency at 1 mm/s or 1 mrad/s, dB: a panel a motion.

    The estimated error of the grids is drawn as a band.

    Parameters
    ----------
    radiated : result of `radiate` or `run`; needs `transfer_vector` (receiver, dof, frequency), Pa
        s/m
    """
    dims = ("dof", "receiver", "frequency")
    field, error = radiated["transfer_vector"].transpose(*dims), None
    if "transfer_vector_error" in radiated:
        error = radiated["transfer_vector_error"].transpose(*dims)
    dofs = names(field, "dof")
    silent = silent_dofs(field.values, dofs)
    shaded = "" if error is None else " Band: plus and minus the estimated error of the grids."
    panels = (
        silent_panel(dof_title(dof), _HEIGHT)
        if dof in silent
        else _panel(field.sel(dof=dof), None if error is None else error.sel(dof=dof))
        for dof in dofs
    )
    return Chart(
        "transfer_vectors",
        "Sound pressure level at every microphone per unit velocity of the housing against "
        "frequency, a panel per degree of freedom.",
        "Level at every microphone when the housing moves at 1 mm/s or turns at 1 mrad/s (root "
        f"mean square) in one degree of freedom.{shaded}",
        tuple(panels),
        columns=2,
        wide=True,
    )


def _panel(field: xr.DataArray, error: xr.DataArray | None) -> Panel:
    """Curves of one degree of freedom, (receiver, frequency)."""
    curves, frequency = [], field["frequency"].values
    for name, values in zip(names(field, "receiver"), field, strict=True):
        size, around = np.abs(values.values), None
        if error is not None:
            gap = error.sel(receiver=name).values
            around = (unit_level_db(np.maximum(size - gap, 1e-3 * size)), unit_level_db(size + gap))
        curves.append(Line(frequency, unit_level_db(size), wrapped(name, 24), around))
    level = unit_level_db(field.values)
    top, lowest = float(level.max()), float(level.min())
    limits = (max(lowest, top - CURVE_DEPTH_DB) - 2.0, top + 4.0)
    x, y = frequency_axis("Frequency, Hz", frequency), Axis("Level, dB re 20 µPa", limits=limits)
    return Panel(x, y, tuple(curves), dof_title(str(field["dof"].item())), _HEIGHT)
