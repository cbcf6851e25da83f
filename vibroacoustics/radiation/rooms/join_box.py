"""The box around a machine in a room, and the join of its free field with the room's."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, ComplexArray
from .lattice import Lattice

_MORE_NODES: Final = 6
"""More nodes of the quadrature, beyond those that waves along the side need."""
_QUADRATURE: Final = 1e-4
"""Error of the quadrature by what radiates or scatters close to the box."""


class JoinBox:
    """Points on the six sides of a box: nodes of Gauss-Legendre quadrature.

    The sides may pass through joints of boxes and stand near walls and blocks, but lie in the air.

    Parameters
    ----------
    lower, upper : corners (3,), m
    maximum_frequency_hz : maximum frequency of the waves
    clearance_m : between the sides and the body in the box: the closer, the more nodes
    on_floor : whether the box stands on something hard: its lowest side is omitted, where neither
        the field nor the Green's function has a slope
    """

    def __init__(
        self,
        lower: Array,
        upper: Array,
        maximum_frequency_hz: float,
        clearance_m: float = np.inf,
        on_floor: bool = False,
    ) -> None:
        self.lattices: list[Lattice] = []
        """Lattice of each side, for `room_transfer`."""
        self.axes: list[int] = []
        """Across each side."""
        self.weights: list[Array] = []
        """Areas of the nodes, below zero on lower sides, (point,), m²."""
        lines, weights = zip(
            *(
                _nodes(float(low), float(high), maximum_frequency_hz, clearance_m)
                for low, high in zip(lower, upper, strict=True)
            ),
            strict=True,
        )
        for axis in range(3):
            for sign, level in ((-1.0, lower[axis]), (1.0, upper[axis])):
                if on_floor and (axis, sign) == (2, -1.0):
                    continue
                coordinates, by = list(lines), list(weights)
                coordinates[axis], by[axis] = np.array([level]), np.array([sign])
                self.lattices.append(Lattice(coordinates[0], coordinates[1], coordinates[2]))
                self.weights.append(np.einsum("i,j,k->ijk", *by).ravel())
                self.axes.append(axis)

    @property
    def points(self) -> list[Array]:
        """Points of each side, (point, 3), m."""
        return [
            np.stack(np.meshgrid(*lattice.lines, indexing="ij"), axis=-1).reshape(-1, 3)
            for lattice in self.lattices
        ]

    def join(
        self,
        pressure: Sequence[ComplexArray],
        slope: Sequence[ComplexArray],
        green: Sequence[ComplexArray],
    ) -> ComplexArray:
        """Sound pressure at the microphone of a Green's function, (frequency,).

        p = integral of [p dG/dn - G dp/dn] dS with n out of the box (A. D. Pierce, Acoustics
        (2019), section 4.6). With the free field of a machine it is what the machine gives in the
        room, without the echo that its body scatters.

        Parameters
        ----------
        pressure : free field on each side, (frequency, point), Pa
        slope : its derivative along the side's axis, Pa/m
        green : with gradient, as in `RoomResponse.values`, of the six sides
        """
        total = np.zeros(pressure[0].shape[0], dtype=complex)
        for side, (axis, weights) in enumerate(zip(self.axes, self.weights, strict=True)):
            value = green[side][:, 0].reshape(total.size, -1)
            gradient = green[side][:, 1 + axis].reshape(total.size, -1)
            total += (pressure[side] * gradient - value * slope[side]) @ weights
        return total


def _nodes(
    low: float, high: float, maximum_frequency_hz: float, clearance_m: float
) -> tuple[Array, Array]:
    """Nodes and weights between two ends: as many as two waves of opposite ways need.

    A singularity at a distance d from a line of length L is within the quadrature's error from
    ln(1/error)/(2 arsinh(2d/L)) nodes on (ellipse of Bernstein).
    """
    phase = 2.0 * np.pi * maximum_frequency_hz / SPEED_OF_SOUND_M_PER_S * (high - low)
    close = -np.log(_QUADRATURE) / (2.0 * np.arcsinh(2.0 * clearance_m / (high - low)))
    count = max(_MORE_NODES + int(np.ceil(phase)), int(np.ceil(close)))
    node, weight = np.polynomial.legendre.leggauss(count)
    half = (high - low) / 2.0
    return low + half * (node + 1.0), half * weight
