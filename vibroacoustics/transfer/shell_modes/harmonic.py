"""The closed shell at one circumferential order: supports, rigid motions, elastic modes."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import bmat, identity
from scipy.sparse.linalg import eigsh, splu

from ...base.arrays import Array, IndexArray
from ...machine.shell_structure import ShellStructure
from .elements import (
    AXIAL,
    CIRCUMFERENTIAL,
    NODE_DOFS,
    RADIAL,
    ROTATION,
    freedom_count,
    matrices,
)
from .meridian import Meridian


@dataclass(frozen=True)
class Harmonic:
    """Motions that vary with cos nθ and sin nθ around the axis."""

    meridian: Meridian
    structure: ShellStructure
    order: int

    @cached_property
    def kept(self) -> IndexArray:
        """Amplitudes that are free to move.

        On the axis the displacement has one value from all sides. Where the section is kept
        round, the orders from 2 up neither move it outwards nor around.
        """
        held = [tip + freedom for tip in self._tips for freedom in _ON_AXIS.get(self.order, _ALL)]
        if self.order >= 2:
            rings = [NODE_DOFS * node for node in self.meridian.round_nodes]
            held += [ring + freedom for ring in rings for freedom in (RADIAL, CIRCUMFERENTIAL)]
        return np.setdiff1d(np.arange(freedom_count(self.meridian)), held)

    @cached_property
    def reduction(self) -> Any:
        """All amplitudes from the free ones, sparse (freedom, free)."""
        transformation = identity(freedom_count(self.meridian), format="lil")
        if self.order == 1:
            for tip in self._tips:  # u_r cos θ and v sin θ with v = -u_r are a translation
                transformation[tip + CIRCUMFERENTIAL, tip + RADIAL] = -1.0
        return transformation.tocsc()[:, self.kept]

    @property
    def _tips(self) -> list[int]:
        """First degrees of freedom of the nodes on the axis."""
        ends = (0, self.meridian.elements)
        return [NODE_DOFS * end for end in ends if self.meridian.nodes[end, 0] == 0.0]

    @cached_property
    def free_matrices(self) -> tuple[Any, Any]:
        """Stiffness and mass of the free amplitudes, sparse (free, free)."""
        all_matrices = matrices(self.meridian, self.structure, self.order)
        reduced = (self.reduction.T @ matrix @ self.reduction for matrix in all_matrices)
        stiffness, mass = (matrix.tocsc() for matrix in reduced)
        return stiffness, mass

    @cached_property
    def rigid_motions(self) -> Array:
        """Free amplitudes of motions without strain, mass-normalised, shape (free, 0 to 2).

        Order 0: along z, about z. Order 1: along x or y and about y or x. The rigid body on its
        mounts has them; the elastic modes are orthogonal to them.
        """
        motions = np.zeros((freedom_count(self.meridian), 2 if self.order < 2 else 0))
        nodes = motions[: NODE_DOFS * (self.meridian.elements + 1)]
        radius, height = self.meridian.nodes.T
        if self.order == 0:
            nodes[AXIAL::NODE_DOFS, 0] = 1.0
            nodes[CIRCUMFERENTIAL::NODE_DOFS, 1] = radius
        elif self.order == 1:
            nodes[RADIAL::NODE_DOFS] = np.stack([np.ones_like(height), height], axis=1)
            nodes[CIRCUMFERENTIAL::NODE_DOFS] = -nodes[RADIAL::NODE_DOFS]
            nodes[AXIAL::NODE_DOFS, 1] = -radius
            nodes[ROTATION::NODE_DOFS, 1] = -1.0
        free = motions[self.kept]
        gram = free.T @ self.free_matrices[1] @ free
        return np.asarray(np.linalg.solve(np.linalg.cholesky(gram), free.T).T)

    def modes(self, maximum_frequency_hz: float) -> tuple[Array, Array]:
        """Natural frequencies (mode,) in Hz and mass-normalised amplitudes (freedom, mode).

        The lowest motions by shifted and inverted Lanczos iteration, of which the rigid ones are
        left out.
        """
        limit = (2.0 * np.pi * maximum_frequency_hz) ** 2
        squares, shapes = self._lowest(limit)
        elastic = np.argsort(squares)[self.rigid_motions.shape[1] :]
        elastic = elastic[squares[elastic] <= limit]
        return np.sqrt(squares[elastic]) / (2.0 * np.pi), self.reduction @ shapes[:, elastic]

    def _lowest(self, limit: float) -> tuple[Array, Array]:
        """Lowest motions, at least all with squares of angular frequency up to a limit, rigid ones
        too."""
        stiffness, mass = self.free_matrices
        start = np.random.default_rng(0).standard_normal(self.kept.size)  # no symmetry
        count = _FIRST_MOTIONS
        while count < self.kept.size // 2:
            squares, shapes = eigsh(stiffness, count, mass, sigma=-limit, v0=start)
            if squares.max() > limit:
                return squares, shapes
            count *= 2
        return eigh(stiffness.toarray(), mass.toarray())  # type: ignore[no-any-return]

    def static_flexibility(self, dofs: IndexArray) -> Array:
        """Displacement per steady force without the rigid motions, shape (dof, dof).

        The force is balanced by the inertia of the rigid motions that it starts.

        Parameters
        ----------
        dofs : numbers among all amplitudes, shape (dof,)
        """
        forces = self.reduction.T[:, dofs]
        stiffness, mass = self.free_matrices
        momentum, rigid = mass @ self.rigid_motions, self.rigid_motions.shape[1]
        right = forces.toarray() - momentum @ (forces.T @ self.rigid_motions).T
        if rigid:  # without their momentum; its rows as large as the others
            momentum *= abs(stiffness).max() / abs(momentum).max()
            stiffness = bmat([[stiffness, momentum], [momentum.T, None]], "csc")
            right = np.concatenate([right, np.zeros((rigid, dofs.size))])
        return np.asarray(forces.T @ splu(stiffness).solve(right)[: self.kept.size])


_FIRST_MOTIONS: Final = 24
"""Asked for at first: few orders have as many below 10 kHz."""
_ALL: Final = (RADIAL, AXIAL, CIRCUMFERENTIAL, ROTATION)
_ON_AXIS: Final = {
    0: (RADIAL, CIRCUMFERENTIAL, ROTATION),
    1: (AXIAL, CIRCUMFERENTIAL),
}
"""Freedoms without motion on the axis; all of them from order 2 up."""
