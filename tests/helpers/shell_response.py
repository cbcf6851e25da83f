"""Response of the elastic shell to forces at points: modal sum and a residual for other modes."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from vibroacoustics.base.arrays import Array, ComplexArray
from vibroacoustics.transfer.shell_modes.elements import (
    displacement_shapes,
    element_dofs,
    freedom_count,
)
from vibroacoustics.transfer.shell_modes.harmonic import Harmonic
from vibroacoustics.transfer.shell_modes.loads import Load
from vibroacoustics.transfer.shell_modes.meridian import Meridian
from vibroacoustics.transfer.shell_modes.modes import Around, ElasticShell, ShellMode
from vibroacoustics.transfer.shell_modes.projection import modal_forces, velocity_per_force


@dataclass(frozen=True)
class PointForces:
    """Unit forces at points of the surface.

    Attributes
    ----------
    points : x, y, z about the centre of mass, shape (load, 3), m
    directions : unit vectors, shape (load, 3)
    """

    points: Array
    directions: Array

    def generalised(self, meridian: Meridian, around: Around) -> Array:
        """As of any `Load`."""
        angle = np.arctan2(self.points[:, 1], self.points[:, 0])
        meridian_points = np.stack(
            [np.hypot(self.points[:, 0], self.points[:, 1]), self.points[:, 2]], 1
        )
        cosine, sine = np.cos(angle), np.sin(angle)
        x, y, axial = self.directions.T
        parts = np.stack(
            [
                (x * cosine + y * sine) * around.radial(angle),
                axial * around.radial(angle),
                (y * cosine - x * sine) * around.around(angle),
            ]
        )
        element, along = meridian.locate(meridian_points)
        freedoms = element_dofs(meridian)[element]
        weights = displacement_shapes(meridian, element, along)
        total = np.zeros((freedom_count(meridian), angle.size))
        total[freedoms.T, np.arange(angle.size)] = np.einsum("pia,ip->ap", weights, parts)
        return total


def dense(matrices):
    """Stiffness and mass of sparse ones."""
    return [matrix.toarray() for matrix in matrices]


def normal_velocity(mode: ShellMode, points: Array, normals: Array) -> Array:
    """Velocity along unit normals (point, 3), shape (point,)."""
    return np.asarray(np.einsum("pi,pi->p", mode.velocity(points), normals))


def elastic_flexibility(harmonic: Harmonic, load: Array, frequency_hz: float) -> Array:
    """Static elastic amplitudes (freedom, load) under loads on the amplitudes (freedom, load).

    The resultant of a load is met by the inertia of the accelerating rigid shell, which leaves
    no rigid motion: (K + s M R Rᵀ M)⁻¹ - R Rᵀ / s for any s.

    Parameters
    ----------
    harmonic : stiffness and mass
    load : force on each amplitude
    frequency_hz : of the order of the elastic modes', sets s
    """
    shift = (2.0 * np.pi * frequency_hz) ** 2
    stiffness, mass = dense(harmonic.free_matrices)
    rigid, momentum = harmonic.rigid_motions, mass @ harmonic.rigid_motions
    reduced = harmonic.reduction.T @ load
    moved = cho_solve(cho_factor(stiffness + shift * momentum @ momentum.T), reduced)
    moved -= rigid @ (rigid.T @ reduced) / shift
    return np.asarray(harmonic.reduction @ moved)


def modal_mobility(shell: ElasticShell, frequency_hz: Array) -> ComplexArray:
    """`velocity_per_force` of a shell's modes, shape (mode, frequency).

    Parameters
    ----------
    shell : modes and loss factor
    frequency_hz : shape (frequency,)
    """
    natural = np.array([mode.frequency_hz for mode in shell.modes])
    mass = np.array([mode.modal_mass_kg for mode in shell.modes])
    return velocity_per_force(natural, mass, shell.structure.loss_factor_ratio, frequency_hz)


def static_flexibility(shell: ElasticShell, response: Load, load: Load) -> Array:
    """Elastic displacement under unit loads, solved directly, shape (response, load), m/N.

    Of all orders around that have a mode; the rigid motion is left out.

    Parameters
    ----------
    shell : stiffness
    response : where and along what the displacement counts
    load : unit loads
    """
    total: Array = np.zeros(())
    for harmonic in shell.harmonics:
        for around in shell.arounds(harmonic.order):
            given = load.generalised(shell.meridian, around)
            moved = elastic_flexibility(harmonic, given, shell.maximum_frequency_hz)
            total = total + response.generalised(shell.meridian, around).T @ moved
    return total


def residual_flexibility(shell: ElasticShell, response: Load, load: Load) -> Array:
    """What the modes leave of the static flexibility, shape (response, load), m/N.

    Parameters
    ----------
    shell : modes and stiffness
    response : where and along what the displacement counts
    load : unit loads
    """
    stiffness = np.array(
        [mode.modal_mass_kg * (2.0 * np.pi * mode.frequency_hz) ** 2 for mode in shell.modes]
    )
    modal = modal_forces(shell, response).T / stiffness @ modal_forces(shell, load)
    return np.asarray(static_flexibility(shell, response, load) - modal)


def mobility(shell: ElasticShell, response: Load, load: Load, frequency_hz: Array) -> ComplexArray:
    """Velocity per unit load, shape (response, load, frequency), m/(N s) for forces.

    Modal sum, and the modes above the highest frequency by their stiffness.

    Parameters
    ----------
    shell : modes, stiffness and loss factor
    response : where and along what the velocity counts
    load : unit loads
    frequency_hz : shape (frequency,)
    """
    by_mode = modal_mobility(shell, frequency_hz)
    modal = np.einsum(
        "mr,ml,mf->rlf", modal_forces(shell, response), modal_forces(shell, load), by_mode
    )
    omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
    rest = residual_flexibility(shell, response, load) / (
        1.0 + 1j * shell.structure.loss_factor_ratio
    )
    return np.asarray(modal + 1j * omega * rest[..., None])
