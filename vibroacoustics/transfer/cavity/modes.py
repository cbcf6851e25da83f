"""Acoustic modes of a space of revolution, with one attachment mode per order for a source."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from scipy.linalg import cho_factor, cho_solve, eigh

from ...base.arrays import Array, IndexArray
from .elements import matrices
from .profile import Profile

MODES: Final = 12
"""Modes of each order; what higher ones do is in the attachment mode."""
_UNIFORM: Final = 1e-6
"""Share of the largest k² of the order; below it a mode is the uniform pressure."""


@dataclass(frozen=True)
class GasOrder:
    """Modes p cos n(θ - θ₀) of one order n in rigid walls, with ∫ φ² dV = 1.

    Attributes
    ----------
    profile : the space
    order : waves around the axis
    """

    profile: Profile
    order: int

    @cached_property
    def modes(self) -> tuple[Array, Array]:
        """k² (mode,) in 1/m² and pressures of the nodes (node, mode)."""
        stiffness, mass = self._matrices
        squares, free = eigh(stiffness, mass, subset_by_index=(0, MODES - 1))
        shapes = np.zeros((self._count, MODES))
        shapes[self._free] = free
        return np.maximum(squares, 0.0), shapes

    def with_attachment(self, source: Array) -> tuple[Array, Array]:
        """The modes and the steady response to a source that they lack, as one more.

        It is orthogonal to the modes in stiffness and mass, so it acts as one (Craig & Bampton
        1968, of structures; attachment mode). None where the source drives no pressure.

        Parameters
        ----------
        source : its share of each node, shape (node,)
        """
        squares, shapes = self.modes
        free_source, (response, its_mass) = source[self._free], self._steady
        remaining = free_source - self._moved @ (shapes[self._free].T @ free_source)
        steady = response @ free_source
        size = float(steady @ its_mass @ free_source)
        if size <= 0.0 or not np.any(free_source):
            return squares, shapes
        column = np.zeros((self._count, 1))
        column[self._free, 0] = steady / np.sqrt(size)
        square = float(steady @ remaining) / size  # the stiffness makes of it what is left
        return np.append(squares, square), np.hstack([shapes, column])

    @cached_property
    def _moved(self) -> Array:
        """Mass times the modes, shape (free node, mode)."""
        return np.asarray(self._matrices[1] @ self.modes[1][self._free])

    @property
    def _count(self) -> int:
        return int(self.profile.nodes[..., 0].size)

    @cached_property
    def _free(self) -> IndexArray:
        """Nodes with pressure: on the axis none from order 1 up."""
        radius = self.profile.nodes[..., 0].ravel()
        return np.flatnonzero((radius > 0.0) | (self.order == 0))

    @cached_property
    def _matrices(self) -> tuple[Array, Array]:
        indices = np.ix_(self._free, self._free)
        stiffness, mass = matrices(self.profile, self.order)
        return stiffness[indices], mass[indices]

    @cached_property
    def _steady(self) -> tuple[Array, Array]:
        """Steady response of each node to a source at each, without the modes; mass times it.

        Kept whole, as sampled sources differ in their places. The uniform pressure, which order 0
        has, gets some stiffness.
        """
        stiffness, mass = self._matrices
        squares, shapes = self.modes
        free, boundary = shapes[self._free], self._moved
        uniform = boundary[:, squares < _UNIFORM * squares[-1]]
        held = cho_factor(stiffness + squares[-1] * uniform @ uniform.T)
        response = cho_solve(held, np.eye(len(mass)) - boundary @ free.T)
        response -= free @ (boundary.T @ response)
        return response, mass @ response
