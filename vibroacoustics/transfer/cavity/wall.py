"""Pressure of a gas on the shell's wall: force on the wall's motion."""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array, IndexArray
from ..shell_modes.elements import freedom_count
from ..shell_modes.loads import interpolation
from ..shell_modes.meridian import Meridian
from ..shell_modes.modes import Around
from .elements import Profile, quadratic, quadratic_slope, squared_around

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True)
class WallPressure:
    """Unit pressures of the nodes of a space on the wall, p cos n(θ - θ₀), outwards.

    Attributes
    ----------
    profile : the space; its outer edge lies on the wall
    under_cap : whether its upper face is the shell's cap, and its lower one a rigid partition that
        goes with the wall: up and down for n = 0, tilting for n = 1. Its share is taken off, or the
        gas had a net force on the shell
    """

    profile: Profile
    under_cap: bool

    def generalised(self, meridian: Meridian, around: Around) -> Array:
        """Force on each amplitude of a motion around the axis, shape (freedom, node)."""
        numbers = np.arange(self.profile.nodes[..., 0].size).reshape(self.profile.radius.size, -1)
        total = np.zeros((freedom_count(meridian), numbers.size))
        self._add_outwards(total, meridian, around.order, numbers[-1])
        if self.under_cap:
            self._add_outwards(total, meridian, around.order, numbers[::-1, -1])
            if around.order < 2:
                self._add_partition(total, meridian, around.order, numbers[:, 0])
        return total

    def _add_outwards(self, total: Array, meridian: Meridian, order: int, line: IndexArray) -> None:
        """∫ p u·n dS along a line of nodes whose right side is outside."""
        point, step, weights = self._along(line)
        dofs, shapes = interpolation(meridian, point)
        normal = np.stack([step[:, 1], -step[:, 0]], axis=1)
        circle = squared_around(order) * point[:, 0]
        force = np.einsum("pd,pda,p->pa", normal, shapes[:, :2], circle)
        np.add.at(total, (dofs[:, :, None], line), force[:, :, None] * weights[:, None])

    def _add_partition(
        self, total: Array, meridian: Meridian, order: int, line: IndexArray
    ) -> None:
        """Downwards on a plate that goes with the wall's height, or tilts with it."""
        point, step, weights = self._along(line)
        rim = self.profile.nodes[-1, :1]
        dofs, shapes = interpolation(meridian, rim)
        leverage = (point[:, 0] / rim[0, 0]) ** order
        force = squared_around(order) * weights.T @ (step[:, 0] * point[:, 0] * leverage)
        total[np.ix_(dofs[0], line)] -= np.outer(shapes[0, 1], force)

    def _along(self, line: IndexArray) -> tuple[Array, Array, Array]:
        """Gauss points on a line: place, step (point, 2), and what each node adds (point, node)."""
        shapes, slopes = quadratic(_POINTS), quadratic_slope(_POINTS)
        nodes = self.profile.nodes.reshape(-1, 2)[line]
        triples = np.arange(line.size)[:-2:2, None] + np.arange(3)
        point = np.einsum("ga,ead->egd", shapes, nodes[triples]).reshape(-1, 2)
        step = np.einsum("g,ga,ead->egd", _WEIGHTS, slopes, nodes[triples]).reshape(-1, 2)
        weights = np.zeros((len(triples), _POINTS.size, line.size))
        for element, triple in enumerate(triples):
            weights[element][:, triple] = shapes
        return point, step, weights.reshape(-1, line.size)
