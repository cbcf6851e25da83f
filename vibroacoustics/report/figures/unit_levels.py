"""Levels of a housing that moves at unit velocity, and what its figures share."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ...base.arrays import Array, ComplexArray
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import amplitude_of_level, level_of_amplitude
from ..labels import DOF_WORDS

WIDE_INCH: Final = 8.0
"""1280 pixels: these figures have panels side by side."""
COLOUR_MAP: Final = "viridis"
DEPTH_DB: Final = 40.0
"""What lies further below the loudest is the same colour, or the middle of a balloon."""
SILENT_DB: Final = 60.0
"""A motion whose sound stays this far below the loudest of its unit counts as silent."""
UNIT_VELOCITY: Final = 1e-3
"""1 mm/s or 1 mrad/s, root mean square."""


def unit_level_db(pressure_per_velocity: ComplexArray | Array) -> Array:
    """Level at 1 mm/s or 1 mrad/s, dB re 20 µPa; both root mean squares, so no factor of √2."""
    ratio = UNIT_VELOCITY * np.abs(pressure_per_velocity) / REFERENCE_PRESSURE_PA
    return np.asarray(level_of_amplitude(ratio))


def unit_words(dof: str) -> str:
    """The velocity that levels of a degree of freedom hold at."""
    return "1 mrad/s" if dof.startswith("r") else "1 mm/s"


def dof_title(dof: str) -> str:
    """What moves and how fast, as the head of a panel."""
    words = DOF_WORDS.get(dof)
    return f"{dof}: {words}, {unit_words(dof)}" if words else f"{dof}, {unit_words(dof)}"


def names(field: xr.DataArray, dim: str) -> list[str]:
    """Labels of a dimension."""
    return [str(name) for name in field[dim].values]


def rows_of(items: Sequence[object], columns: int) -> int:
    """Rows that the items fill."""
    return max(1, -(-len(items) // columns))


def silent_dofs(field: ComplexArray, dofs: Sequence[str]) -> list[str]:
    """Those far below the loudest of the same unit; field (dof, ...)."""
    size = np.nanmax(np.abs(field).reshape(len(dofs), -1), axis=1)
    silent = []
    for unit in sorted({unit_words(dof) for dof in dofs}):
        same = [index for index, dof in enumerate(dofs) if unit_words(dof) == unit]
        floor = amplitude_of_level(-SILENT_DB) * size[same].max()
        silent += [dofs[index] for index in same if size[index] <= floor]
    return [dof for dof in dofs if dof in silent]


def write_silent(axes: Axes) -> None:
    """Say in an empty panel that it is meant to be empty."""
    axes.text(0.5, 0.5, "no sound here", transform=axes.transAxes, ha="center", va="center")


def colour_edges(highest_db: float, lowest_db: float) -> Array:
    """Edges of bands of 1 or 2 dB, whole multiples, from the loudest down to at most DEPTH_DB."""
    lowest_db = max(lowest_db, highest_db - DEPTH_DB)
    step = 1.0 if highest_db - lowest_db <= DEPTH_DB / 2.0 else 2.0
    low, high = np.floor(lowest_db / step), np.ceil(highest_db / step)
    return np.asarray(step * np.arange(low, max(high, low + 1) + 1))
