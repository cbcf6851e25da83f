"""Points in the body where the field of its surface vanishes.

They make the solution unique. The surface's equation alone has none where the inside would
resonate between soft walls; such a resonance is heard at points in the body (Schenck, J. Acoust.
Soc. Am. 44 (1968) 41). Burton and Miller's equation needs no points, but a hypersingular layer and
pressures with slopes; against it speaks the choice of points, which is why there are many: one for
every few nodes, so that the nodal lines of a resonance never hold them all.
"""

from typing import Final

import numpy as np
from scipy.stats import qmc

from ..arrays import Array
from .mesh import Mesh

_NODES_PER_POINT: Final = 5
_LEAST: Final = 16
_CLEARANCE: Final = 0.04
"""Least distance from the wall over the body's radius."""


def null_points(mesh: Mesh) -> Array:
    """Points (point, 2) in the body: radius and height, m; even in volume."""
    wanted = max(_LEAST, len(mesh.points) // _NODES_PER_POINT)
    lower, upper = mesh.points.min(axis=0), mesh.points.max(axis=0)
    share = qmc.Halton(2, scramble=False).random(40 * wanted)[1:]
    points = np.stack(
        [upper[0] * np.sqrt(share[:, 0]), lower[1] + (upper[1] - lower[1]) * share[:, 1]], axis=1
    )
    chosen: Array = points[mesh.depth_m(points) > _CLEARANCE * upper[0]][:wanted]
    return chosen
