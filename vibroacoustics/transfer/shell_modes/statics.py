"""Steady flexibility of the closed shell where inner parts are welded to its wall."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from ...base.arrays import Array, IndexArray
from ...machine.shell_structure import Joint, ShellStructure
from .elements import element_dofs
from .harmonic import Harmonic
from .loads import mean_over_band, patch_factors
from .modes import ElasticShell

STATIC_ORDERS: Final = 20
"""Waves around from zero: those that follow add 0.3 % outwards at a weld of 12 mm, 3 % up."""


@dataclass(frozen=True)
class WallFlexibility:
    """Steady displacement of the wall per force, rigid motions left out.

    Attributes
    ----------
    shell : nominal shell
    """

    shell: ElasticShell

    def at_joints(self, joints: Sequence[Joint]) -> Array:
        """Displacement of each weld per force on each, (contact, contact), m/N.

        Contacts are outwards, up and around at each weld of each joint, one after another, means
        over the weld.
        """
        shapes = np.stack([mean_over_band(self.shell.meridian, joint) for joint in joints], axis=1)
        rows = np.flatnonzero(shapes[self._dofs].any(axis=(1, 2)))
        shapes = shapes[self._dofs[rows]].reshape(rows.size, -1)
        kind = np.concatenate(
            [np.tile(3 * j + np.arange(3), joint.welds) for j, joint in enumerate(joints)]
        )
        of_order = [shapes.T @ wall[np.ix_(rows, rows)] @ shapes for wall in self._by_order]
        arounds = [each for order in range(STATIC_ORDERS) for each in self.shell.arounds(order)]
        between = np.array([of_order[around.order] for around in arounds])[:, kind][..., kind]
        factors = [patch_factors(joint, arounds).reshape(len(arounds), -1) for joint in joints]
        factor = np.concatenate(factors, axis=1)
        return np.asarray(np.sum(factor[:, :, None] * factor[:, None] * between, axis=0))

    def of_band(self, joint: Joint, order: int) -> float:
        """Mean displacement outwards of a band per generalised force cos nθ on it, m/N.

        Parameters
        ----------
        joint : band
        order : n, below STATIC_ORDERS
        """
        mean = mean_over_band(self.shell.meridian, joint)[self._dofs, 0]
        return float(mean @ self._by_order[order] @ mean)

    @cached_property
    def _dofs(self) -> IndexArray:
        """Amplitudes of the wall's elements."""
        meridian = self.shell.meridian
        radius = meridian.wall_radius_m * (1.0 - 1e-9)
        wall = (meridian.nodes[:-1, 0] >= radius) & (meridian.nodes[1:, 0] >= radius)
        return np.unique(element_dofs(meridian)[wall])

    @cached_property
    def _by_order(self) -> list[Array]:
        shell = self.shell
        harmonics = (
            Harmonic(shell.meridian, shell.structure, order) for order in range(STATIC_ORDERS)
        )
        return [harmonic.static_flexibility(self._dofs) for harmonic in harmonics]


def local_flexibility_factor(nominal: ShellStructure, changed: ShellStructure) -> float:
    """Flexibility under a local force of a changed wall over that of the nominal wall.

    1/(E t²) and slowly with Poisson's ratio, as of a sphere (Reissner 1946): w = ¼ √(12 (1 - ν²))
    F R/(E t²).
    """
    thickness = nominal.thickness_m / changed.thickness_m
    modulus = nominal.youngs_modulus_pa / changed.youngs_modulus_pa
    poisson = (1.0 - changed.poisson_ratio**2) / (1.0 - nominal.poisson_ratio**2)
    return float(modulus * thickness**2 * np.sqrt(poisson))
