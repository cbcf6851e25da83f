"""Points of one box of air: pressure and its derivatives off the series and the fluxes."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array
from .air import Air
from .cutting import AirBox
from .series import cosines, left_out, series_mass_m, slopes

_NEGLIGIBLE: Final = 0.01
"""Share of what a series lacks at its end: sides that matter less to the points are left out."""


class Piece:
    """Rows and columns of points in a box, and what its terms and fluxes give there.

    Series alone would be wrong near seams and walls by the pressure that drives the flux through
    them: the terms that are left out are added from the fluxes. That is also how a source acts, so
    that source and point may be exchanged.
    """

    def __init__(
        self, number: int, box: AirBox, lines: Sequence[Array], time_step_s: float
    ) -> None:
        self._box = number
        of = [
            (line - low, float(size), count)
            for line, low, size, count in zip(lines, box.lower, box.size, box.nodes, strict=True)
        ]
        self._values = [cosines(*one) for one in of]
        self._slopes = [slopes(*one) for one in of]
        self._near = list(_near(of, time_step_s))

    def read(self, air: Air, derivative: int) -> Array:
        """Pressure (-1) or its derivative along an axis at the points, (x, y, z)."""
        bases = [(self._slopes if axis == derivative else self._values)[axis] for axis in range(3)]
        terms = air.box_terms(self._box)
        n1, n2, n3 = terms.shape
        first = (bases[0] @ terms.reshape(n1, n2 * n3)).reshape(-1, n2, n3)
        result: Array = (bases[1] @ first) @ bases[2].T
        for axis, end, values, slope in self._near:
            left, right = (bases[other] for other in range(3) if other != axis)
            flux = left @ air.side_flux(self._box, axis, end) @ right.T
            along = slope if axis == derivative else values
            result -= np.expand_dims(flux, axis) * along.reshape(
                [-1 if a == axis else 1 for a in range(3)]
            )
        return result


def _near(
    of: Sequence[tuple[Array, float, int]], time_step_s: float
) -> Iterator[tuple[int, int, Array, Array]]:
    """Sides that matter: axis, end, and what the series lacks of an answer to their flux."""
    reach = SPEED_OF_SOUND_M_PER_S * time_step_s
    for axis, (line, length, nodes) in enumerate(of):
        least = _NEGLIGIBLE * series_mass_m(length, nodes, time_step_s)
        for end in (0, 1):
            points = length - line if end else line
            values, slope = left_out(points, length, nodes, time_step_s)
            if np.abs(values).max() > least:
                yield axis, end, values / reach, (-slope if end else slope) / reach
