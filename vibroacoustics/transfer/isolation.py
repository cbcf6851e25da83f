"""Motion of rigid bodies on bushings, and the forces that the bushings pass on."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag, eigh

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError, SolverError
from ..mechanics.bushings import FREE, Bushing, RigidBody, check_joined, motion_at


@dataclass(frozen=True)
class Isolation:
    """Rigid bodies on bushings, such as a block on springs in a shell on grommets.

    The motion of a body is (tx, ty, tz, rx, ry, rz) of its centre of mass, m and rad; its load is
    force and moment about it, N and N m. Small motion: rotations add linearly; the stiffness that
    gravity adds is neglected.

    Attributes
    ----------
    bodies : in the order of the body axis of loads and motions
    bushings : in the order of the bushing axis of the forces
    """

    bodies: tuple[RigidBody, ...]
    bushings: tuple[Bushing, ...]

    def __post_init__(self) -> None:
        names = [body.name for body in self.bodies]
        if not names:
            raise ParameterError("bodies: at least one is needed")
        check_joined(names, self.bushings)

    @cached_property
    def mass_matrix(self) -> Array:
        """Shape (6 bodies, 6 bodies), kg and kg m²."""
        return np.asarray(block_diag(*(body.mass_matrix for body in self.bodies)))

    @cached_property
    def bushing_motion(self) -> Array:
        """Motion of body against other body at each bushing, shape (bushing, 6, 6 bodies)."""
        numbers = {body.name: number for number, body in enumerate(self.bodies)}
        motion = np.zeros((len(self.bushings), 6, 6 * len(self.bodies)))
        for row, bushing in zip(motion, self.bushings, strict=True):
            for sign, name in ((1.0, bushing.body), (-1.0, bushing.other_body)):
                if name is not None:
                    number = numbers[name]
                    centre = self.bodies[number].centre_of_mass_m
                    row[:, 6 * number : 6 * number + 6] = sign * motion_at(
                        bushing.position_m, centre
                    )
        return motion

    @cached_property
    def stiffness_matrix(self) -> Array:
        """Real part, shape (6 bodies, 6 bodies), N/m, N and N m: Σ Gᵀ k G."""
        return self._assembled(self._bushing_stiffness)

    @cached_property
    def structural_damping_matrix(self) -> Array:
        """Imaginary part of the stiffness above frequency zero: Σ η Gᵀ k G."""
        return self._assembled(self._bushing_loss)

    @cached_property
    def damping_matrix(self) -> Array:
        """Viscous, shape (6 bodies, 6 bodies), N s/m, N s and N m s: Σ Gᵀ c G."""
        return self._assembled(self._bushing_damping)

    def real_stiffness(self, frequency_hz: float) -> Array:
        """Real part at a frequency, without damping, shape (6 bodies, 6 bodies)."""
        matrix = self.stiffness_matrix.copy()
        for _, motion, bushing in self._over_frequency:
            matrix += motion.T @ (bushing.added_stiffness(frequency_hz).real[:, None] * motion)
        return matrix

    def complex_stiffness(self, frequency_hz: Array | float) -> ComplexArray:
        """Stiffness with structural losses, shape (..., 6 bodies, 6 bodies), N/m, N and N m.

        Parameters
        ----------
        frequency_hz : at least zero, shape (...)
        """
        frequency = np.asarray(frequency_hz, dtype=float)
        moving = (frequency > 0.0)[..., None, None]
        lossy = self.stiffness_matrix + 1j * self.structural_damping_matrix
        stiffness = np.where(moving, lossy, self.stiffness_matrix)
        for _, motion, bushing in self._over_frequency:
            added = bushing.added_stiffness(frequency)
            stiffness += np.einsum("ki,...k,kj->...ij", motion, added, motion)
        return stiffness

    def natural_modes(self) -> tuple[Array, Array]:
        """Undamped natural frequencies (mode,) in Hz, mass-normalised shapes (mode, body, 6).

        A body that nothing holds has frequencies zero.
        """
        squares, shapes = eigh(self.stiffness_matrix, self.mass_matrix)
        squares[squares < FREE * squares[-1]] = 0.0
        return np.sqrt(squares) / (2.0 * np.pi), shapes.T.reshape(-1, len(self.bodies), 6)

    def receptance(self, frequency_hz: Array | float) -> ComplexArray:
        """Motion per load, shape (..., 6 bodies, 6 bodies): (K + jKη + jωC - ω²M)⁻¹.

        The loss factor is structural, the same at every frequency above zero; at frequency zero
        there is no motion to lose energy and the stiffness is real.

        Parameters
        ----------
        frequency_hz : at least zero, shape (...)

        Raises
        ------
        SolverError
            At frequency zero with a free body, or undamped at a natural frequency.
        """
        frequency = np.asarray(frequency_hz, dtype=float)
        if np.any(frequency == 0.0) and self.natural_modes()[0][0] == 0.0:
            raise SolverError("frequency 0 Hz: a body can move freely, there is no static response")
        omega = 2.0 * np.pi * frequency[..., None, None]
        dynamic = self.complex_stiffness(frequency)
        if self.damping_matrix.any():
            dynamic += 1j * omega * self.damping_matrix
        dynamic -= omega**2 * self.mass_matrix
        try:
            return np.asarray(np.linalg.inv(dynamic))
        except np.linalg.LinAlgError:
            raise SolverError(
                "bushings: undamped motion at a natural frequency has no bound; give damping"
            ) from None

    def displacement(self, load: ComplexArray, frequency_hz: Array | float) -> ComplexArray:
        """Motion of each body, shape (..., body, 6), m and rad, complex peak.

        Parameters
        ----------
        load : force and moment at each body's centre of mass, shape (..., body, 6), complex peak
        frequency_hz : at least zero, broadcasts against load[..., 0, 0]
        """
        flat = np.reshape(load, (*np.shape(load)[:-2], -1))
        motion = np.einsum("...ij,...j->...i", self.receptance(frequency_hz), flat)
        return np.asarray(motion.reshape(*motion.shape[:-1], len(self.bodies), 6))

    def bushing_force(
        self, displacement: ComplexArray, frequency_hz: Array | float
    ) -> ComplexArray:
        """Force and moment of the body on the other one or the ground, shape (..., bushing, 6).

        At the bushing's point, in the axes of the frame, N and N m, complex peak.

        Parameters
        ----------
        displacement : displacement of each body, shape (..., body, 6), m and rad, complex peak
        frequency_hz : at least zero, broadcasts against displacement[..., 0, 0]
        """
        omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)[..., None, None]
        flat = displacement.reshape(*displacement.shape[:-2], -1)

        def force(matrices: Array) -> ComplexArray:
            per_motion = (matrices @ self.bushing_motion).reshape(-1, flat.shape[-1])
            return np.asarray(flat @ per_motion.T).reshape(*flat.shape[:-1], -1, 6)

        total = force(self._bushing_stiffness)
        for rate, matrices in ((omega > 0.0, self._bushing_loss), (omega, self._bushing_damping)):
            if matrices.any():
                total += 1j * rate * force(matrices)
        for number, motion, bushing in self._over_frequency:
            total[..., number, :3] += bushing.added_stiffness(frequency_hz) * (flat @ motion.T)
        return total

    @cached_property
    def _over_frequency(self) -> list[tuple[int, Array, Bushing]]:
        """Bushings whose stiffness changes: number, displacement per motion (3, 6 bodies)."""
        return [
            (number, self.bushing_motion[number, :3], bushing)
            for number, bushing in enumerate(self.bushings)
            if bushing.over_frequency is not None
        ]

    @cached_property
    def _bushing_stiffness(self) -> Array:
        return self._stacked([b.in_frame(b.stiffness) for b in self.bushings])

    @cached_property
    def _bushing_loss(self) -> Array:
        return self._stacked([b.loss_factor_ratio * b.in_frame(b.stiffness) for b in self.bushings])

    @cached_property
    def _bushing_damping(self) -> Array:
        return self._stacked([b.in_frame(b.damping) for b in self.bushings])

    @staticmethod
    def _stacked(matrices: list[Array]) -> Array:
        """Shape (bushing, 6, 6), also without any bushing."""
        return np.array(matrices).reshape(-1, 6, 6)

    def _assembled(self, matrices: Array) -> Array:
        motion = self.bushing_motion
        return np.asarray((motion.transpose(0, 2, 1) @ (matrices @ motion)).sum(axis=0))
