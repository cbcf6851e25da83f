"""Memory of the machine side, asked for before anything is computed."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import psutil

from ..base.errors import ParameterError
from ..base.threads import processors
from .near_field import NearField

FIELDS_BYTES: Final = 0.75 * 2**30
"""Fields on the box that are kept at a time, unless one alone is larger."""
_COMPARED: Final = 4
"""Green's functions that take as much as one that is compared with the closed form."""


def check_memory(
    near: Sequence[NearField], patterns: int, frequencies: int, greens: int = 0
) -> None:
    """Refuse grids that do not fit.

    `greens` Green's functions on the box of the finer grid are kept besides.

    Raises
    ------
    ParameterError
        They need more memory than is available.
    """
    needed = memory_bytes(near, patterns, frequencies, greens) / 2**30
    available = psutil.virtual_memory().available / 2**30
    if needed > available:
        x, y, z = near[0].grid.shape
        raise ParameterError(
            f"radiation.near_field_spacing_mm: the grid of {x}×{y}×{z} cells for {patterns} motions"
            f" and {frequencies} frequencies needs {needed:.3g} GiB, {available:.3g} GiB are "
            "available"
        )


def memory_bytes(
    near: Sequence[NearField], patterns: int, frequencies: int, greens: int = 0
) -> float:
    """Memory that a `MachineSide` takes at its peak, beside what is loaded before."""
    geometry, field, run = np.transpose([grid.memory_bytes(frequencies) for grid in near])
    fields = max(field.max(), min(FIELDS_BYTES, patterns * field.sum()))
    joined = (greens + _COMPARED * (greens > 0)) * green_bytes(near[0].grid.box_pairs, frequencies)
    return float(geometry.sum() + fields + joined + run.max() * min(processors(), patterns))


def green_bytes(pairs: int, frequencies: int) -> float:
    """Memory of a Green's function on both layers of a box."""
    return 32.0 * pairs * frequencies
