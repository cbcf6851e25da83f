"""Transfer vectors of a body of revolution at microphones, with k-Wave's Green's function or not.

The boundary elements hold the room's own Green's function, so k-Wave's enters as its difference
from that: pressure and velocity on a closed box around the machine, times what k-Wave's Green's
function differs by, are what k-Wave's pressure at the microphone differs by. The sum over the box
errs in proportion to that small difference.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..arrays import Array, ComplexArray
from ..at_kwave import Vectors
from ..box import Box, BoxField, closed_box
from .sampling import Sampled
from .side import Addition, RevolutionSide

_BOX_MARGIN_M: Final = 0.04
"""From the body to its box."""


def join_box(side: RevolutionSide, spacing_m: float) -> Box:
    """Box around the body in cells of at most a spacing; it stands on a floor."""
    nodes = side.radiators[0].mesh.points
    reach = float(nodes[:, 0].max()) + _BOX_MARGIN_M
    lower = np.array([-reach, -reach, float(nodes[:, 1].min()) - _BOX_MARGIN_M])
    upper = np.array([reach, reach, float(nodes[:, 1].max()) + _BOX_MARGIN_M])
    if side.floor_z_m is not None:
        lower[2] = side.floor_z_m
    cells = np.maximum(2, np.ceil((upper - lower) / spacing_m).astype(int))
    edges = [
        low + (high - low) / count * np.arange(-1, count + 2)
        for low, high, count in zip(lower, upper, cells, strict=True)
    ]
    on_floor = [] if side.floor_z_m is None else [(2, -1)]
    return closed_box(edges, [1, 1, 1], [count + 1 for count in cells], on_floor)


def by_name(sampled: Sampled) -> Vectors:
    """Pressures and errors, (receiver, pattern, frequency)."""
    return {
        "transfer_vector": np.moveaxis(sampled.pressure, 0, -1),
        "transfer_vector_error": np.moveaxis(sampled.error, 0, -1),
    }


def addition(
    side: RevolutionSide,
    box: Box,
    table_hz: Array,
    greens: Sequence[BoxField],
    expected: Sequence[BoxField],
) -> Addition:
    """What k-Wave's Green's functions add to each microphone's pressure at a frequency."""
    points = np.concatenate([box.inner, box.outer])
    pairs = len(box.inner)
    couples = list(zip(greens, expected, strict=True))
    inner = box.weights * np.array([green.inner - exact.inner for green, exact in couples])
    outer = box.weights * np.array([green.outer - exact.outer for green, exact in couples])

    def at(index: int) -> ComplexArray:
        pressure = side.finer_pressures(float(table_hz[index]), points)
        added: ComplexArray = outer[:, index] @ pressure[:pairs]
        added -= inner[:, index] @ pressure[pairs:]
        return added

    return at
