"""A rigid machine on four grommets: six degrees of freedom at the centre of mass."""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np
from scipy.linalg import eigh

from ..base.arrays import Array, ComplexArray
from ..machine.housing import Housing
from ..machine.mounts import Mounts

FOOT_NAMES: Final = ("front_left", "front_right", "rear_left", "rear_right")
"""Front is +x, left is +y."""


@dataclass(frozen=True)
class RigidBodyOnMounts:
    """Mass and mounts of the machine; the floor is taken as rigid.

    Displacements are (tx, ty, tz, rx, ry, rz) of the centre of mass, m and rad; generalised
    forces are force and moment, N and N m. Small motion: rotations add linearly.

    Attributes
    ----------
    housing : mass and principal moments of inertia
    mounts : stiffness of one grommet, pitch, loss factor
    foot_height_m : height of the grommets relative to the centre of mass
    """

    housing: Housing
    mounts: Mounts
    foot_height_m: float

    bodies: ClassVar[tuple[str, ...]] = ("machine",)

    @cached_property
    def foot_position(self) -> Array:
        """Grommets in the order of FOOT_NAMES, shape (4, 3), m from the centre of mass."""
        return corners(self.mounts.pitch_m, self.foot_height_m)

    @cached_property
    def mass_matrix(self) -> Array:
        """Shape (6, 6), kg and kg m²."""
        body = self.housing
        return np.diag(
            [body.mass_kg] * 3
            + [body.inertia_xx_kg_m2, body.inertia_yy_kg_m2, body.inertia_zz_kg_m2]
        )

    @cached_property
    def foot_stiffness(self) -> Array:
        """Stiffness of one grommet along x, y, z, N/m."""
        lateral = self.mounts.lateral_stiffness_n_per_m
        return np.array([lateral, lateral, self.mounts.vertical_stiffness_n_per_m])

    @cached_property
    def foot_motion(self) -> Array:
        """Displacement of each foot per unit motion of the body, shape (4, 3, 6): u = t + r x p."""
        identity = np.broadcast_to(np.eye(3), (4, 3, 3))
        return np.concatenate([identity, -np.array([_cross(p) for p in self.foot_position])], 2)

    @cached_property
    def stiffness_matrix(self) -> Array:
        """Shape (6, 6), N/m, N and N m: Σ over the feet of Gᵀ k G."""
        motion = self.foot_motion
        return np.asarray(np.einsum("fai,a,faj->ij", motion, self.foot_stiffness, motion))

    def natural_modes(self) -> tuple[Array, Array]:
        """Undamped natural frequencies (6,) in Hz and mass-normalised shapes (mode, dof)."""
        squares, shapes = eigh(self.stiffness_matrix, self.mass_matrix)
        return np.sqrt(squares) / (2.0 * np.pi), shapes.T

    def receptance(self, frequency_hz: Array) -> ComplexArray:
        """Displacement per generalised force, shape (..., 6, 6): (K(1+jη) - ω²M)⁻¹.

        The loss factor is structural, of the same stiffness at every frequency above zero; at
        frequency zero there is no motion to lose energy and the stiffness is real.

        Parameters
        ----------
        frequency_hz : shape (...), at least zero
        """
        frequency = np.asarray(frequency_hz, dtype=float)[..., None, None]
        loss = np.where(frequency > 0.0, self.mounts.loss_factor_ratio, 0.0)
        dynamic = (
            self.stiffness_matrix * (1.0 + 1j * loss)
            - (2.0 * np.pi * frequency) ** 2 * self.mass_matrix
        )
        return np.asarray(np.linalg.inv(dynamic))

    def velocity(self, load: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Velocity of the centre of mass, shape (..., 6), m/s and rad/s, complex peak.

        Parameters
        ----------
        load : force and moment on the housing about the centre of mass, shape (..., 6)
        frequency_hz : broadcasts against load[..., 0]
        """
        speed = 2j * np.pi * np.asarray(frequency_hz, dtype=float)[..., None]
        return np.asarray(speed * self._displacement(load, frequency_hz))

    def foot_force(self, load: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Force of the machine on the floor at each foot, shape (..., foot, axis), N."""
        frequency = np.asarray(frequency_hz, dtype=float)
        loss = np.where(frequency > 0.0, self.mounts.loss_factor_ratio, 0.0)
        displacement = self._displacement(load, frequency_hz)
        foot = np.einsum("fai,...i->...fa", self.foot_motion, displacement)
        return np.asarray(foot * self.foot_stiffness * (1.0 + 1j * loss)[..., None, None])

    def _displacement(self, load: ComplexArray, frequency_hz: Array) -> ComplexArray:
        return np.asarray(np.einsum("...ij,...j->...i", self.receptance(frequency_hz), load))


def corners(pitch_m: float, height_m: float) -> Array:
    """Corners of a square in the order of FOOT_NAMES, shape (4, 3), m."""
    half = pitch_m / 2.0
    return np.array(
        [(x, y, height_m) for x, y in ((half, half), (half, -half), (-half, half), (-half, -half))]
    )


def _cross(vector: Array) -> Array:
    """Matrix of the cross product: _cross(a) @ b = a x b."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
