"""A machine's frame in its elastic shell: what loads on the parts do to the shell.

Bodies, shaft and shell, each free, answer by their natural motions; the forces at bearings and
contacts are those that close the gaps between them, for many frequencies at once.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from .contacts import Contacts
from .inner import InnerSet
from .symmetric import (
    AT_A_TIME,
    NaturalMotions,
    answers,
    natural_motions,
    solve_symmetric,
    times,
    upper_pairs,
)


class SoundPerForce(NamedTuple):
    """Pressure at the receivers.

    Attributes
    ----------
    of_loads : per load on the parts, shape (receiver, part times component, frequency)
    of_modes : per generalised force on a mode of the shell at some of the frequencies, given by
        index, shape (receiver, mode, some)
    """

    of_loads: ComplexArray
    of_modes: Callable[[IndexArray], ComplexArray]


@dataclass(frozen=True)
class FrameOnShell:
    """Frame, shaft and stator in the shell, with one set of values.

    Attributes
    ----------
    inner : the parts
    contacts : contacts of the parts with the shell
    modal_forces : forces on the shell's modes per force on a contact, shape (mode, contact)
    residual : steady flexibility that the modes lack, shape (contact, contact), m/N
    natural_hz, modal_mass_kg : natural frequency and modal mass of the modes, shape (mode,)
    loss_factor_ratio : loss factor of the shell
    machine_mass : mass of the machine, shape (6, 6), kg and kg m²
    """

    inner: InnerSet
    contacts: Contacts
    modal_forces: Array
    residual: Array
    natural_hz: Array
    modal_mass_kg: Array
    loss_factor_ratio: float
    machine_mass: Array

    @property
    def shell_mass(self) -> Array:
        """Mass of what moves with the shell as a rigid body, shape (6, 6), kg and kg m²."""
        return self.machine_mass - self.inner.rigid_mass

    def sound(
        self, modes: ComplexArray, rigid: ComplexArray, frequency_hz: Array, gain: float = 1.0
    ) -> SoundPerForce:
        """Pressure per load on the parts and per force on the shell's modes.

        Zero at frequency zero; that of the machine as one rigid body is not included.

        Parameters
        ----------
        modes : pressure per velocity of the shell's modes, shape (receiver, mode, frequency),
            Pa s/m
        rigid : pressure of its six rigid motions about the centre of mass, shape (receiver, 6,
            frequency), Pa s/m and Pa s/rad
        frequency_hz : shape (frequency,)
        gain : gain of the modes' pressure
        """
        turning = 2j * np.pi * frequency_hz  # velocity per displacement
        omega = 2.0 * np.pi * np.where(frequency_hz > 0.0, frequency_hz, 1.0)
        rigid, turning = rigid * turning, gain * turning
        shell = answers(self._squares, omega) / self.modal_mass_kg[:, None]
        parts = answers(self.motions.squares, omega)
        # By reciprocity: motions of the contacts as the receivers drive the shell.
        gap_m = times(self._on_modes.T, modes * (turning * shell))
        gap_m -= times(self._of_gaps.T, rigid) / omega**2
        forces = np.moveaxis(self._joined(shell, parts, omega, np.moveaxis(gap_m, 0, 1)), 0, 1)
        through = times(self._at_gaps.T, forces) * parts
        of_loads = times(self._together.T, rigid) / omega**2
        of_loads += times(self._of_motions.T, through)

        def of_modes(some: IndexArray) -> ComplexArray:
            on_modes = times(self._on_modes, forces[..., some])
            return np.asarray((modes[..., some] * turning[some] - on_modes) * shell[:, some])

        return SoundPerForce(of_loads, of_modes)

    def velocities(
        self, on_parts: ComplexArray, on_modes: ComplexArray, frequency_hz: Array
    ) -> ComplexArray:
        """Velocities of the shell's modes and then of its six rigid motions, (motion, frequency).

        Zero at frequency zero; that of the machine as one rigid body is not included.

        Parameters
        ----------
        on_parts : loads on the parts together, shape (part times component, frequency)
        on_modes : generalised forces on the shell's modes, shape (mode, frequency)
        frequency_hz : shape (frequency,)
        """
        omega = 2.0 * np.pi * np.where(frequency_hz > 0.0, frequency_hz, 1.0)
        shell = answers(self._squares, omega) / self.modal_mass_kg[:, None]
        parts = answers(self.motions.squares, omega)
        gap_m = times(self._at_gaps, parts * times(self._of_motions, on_parts))
        gap_m -= times(self._on_modes.T, shell * on_modes)
        forces = self._joined(shell, parts, omega, gap_m[:, None])[:, 0]
        modes = shell * (on_modes + times(self._on_modes, forces))
        rigid = times(self._together, on_parts) - times(self._of_gaps, forces)
        motion = np.concatenate([modes, rigid / omega**2])
        return np.asarray(2j * np.pi * frequency_hz * motion)

    def contact_forces(self, frequency_hz: Array) -> ComplexArray:
        """Forces on the shell per load on a part, (frequency, contact, part times component).

        None at frequency zero.

        Parameters
        ----------
        frequency_hz : shape (frequency,)
        """
        omega = 2.0 * np.pi * np.where(frequency_hz > 0.0, frequency_hz, 1.0)
        shell = answers(self._squares, omega) / self.modal_mass_kg[:, None]
        parts = answers(self.motions.squares, omega)
        gap_m = np.einsum("cn,nf,nl->clf", self._at_gaps, parts, self._of_motions)
        forces = self._joined(shell, parts, omega, gap_m) * (frequency_hz > 0.0)
        return np.moveaxis(forces[: len(self.contacts.part)], -1, 0)

    def _joined(
        self, shell: ComplexArray, parts: ComplexArray, omega: Array, gap_m: ComplexArray
    ) -> ComplexArray:
        """Forces that close the gaps, shape (gap, side, frequency).

        Parameters
        ----------
        shell, parts : answers of the modes and of the parts' motions, shape (motion, frequency)
        omega : shape (frequency,)
        gap_m : gaps without them, shape (contact, side, frequency)
        """
        forces = np.empty(gap_m.shape, dtype=complex)
        for first in range(0, omega.size, AT_A_TIME):
            block = slice(first, first + AT_A_TIME)
            some = np.ascontiguousarray(gap_m[..., block])
            solve_symmetric(*self._compliance(shell[:, block], parts[:, block], omega[block]), some)
            forces[..., block] = some
        return forces

    def _compliance(
        self, shell: ComplexArray, parts: ComplexArray, omega: Array
    ) -> tuple[Array, Array]:
        """Compliance of gaps, m/N, real and imaginary part, shape (pair, frequency)."""
        order, first = self._alike
        still = np.ones((1, omega.size))
        bearings = self.inner.flexibility(omega)
        shares = np.concatenate(
            [shell[order[first]], parts, bearings, -still / omega**2, still, 1j * still]
        )
        # Contiguous parts: strided ones are multiplied without the library of linear algebra.
        return self._pairs @ shares.real.copy(), self._pairs @ shares.imag.copy()

    @cached_property
    def _pairs(self) -> Array:
        """Gap per force on another, shape (pair, share).

        Shares of modes that differ, of the parts' motions, of the bearings, of the shell's rigid
        motion, of springs with the wall's residual: real part, imaginary part.
        """
        gaps, held = len(self.inner.gaps), len(self.contacts.part)
        rows, columns = upper_pairs(gaps)
        order, first = self._alike
        modes = self._on_modes.T[:, order]
        shell = np.add.reduceat(modes[rows] * modes[columns], first, axis=1)
        parts = self._at_gaps[rows] * self._at_gaps[columns]
        bearings = np.equal(rows, columns)[:, None] & np.equal(rows[:, None], range(held, gaps))
        springs = np.zeros((gaps, gaps), dtype=complex)
        springs[:held, :held] = np.diag(1.0 / self.contacts.stiffness)
        springs[:held, :held] += self.residual / (1.0 + 1j * self.loss_factor_ratio)
        rigid = _padded(self.contacts.rigid, gaps) @ self._of_gaps
        springs_at_gaps = [each[rows, columns] for each in (rigid, springs.real, springs.imag)]
        return np.concatenate([shell, parts, bearings, np.stack(springs_at_gaps, axis=1)], axis=1)

    @cached_property
    def _alike(self) -> tuple[IndexArray, IndexArray]:
        """Order of the modes in which those that answer alike, as twins do, follow one another,
        and the first of each."""
        order = np.lexsort((self.modal_mass_kg, self.natural_hz))
        values = np.stack([self.natural_hz, self.modal_mass_kg])[:, order]
        differs = np.any(np.diff(values, prepend=np.nan) != 0.0, axis=0)
        return order, np.flatnonzero(differs)

    @cached_property
    def motions(self) -> NaturalMotions:
        """Natural motions of bodies and shaft, free of each other and of the shell."""
        return natural_motions(self.inner.bodies, self.inner.shaft)

    @property
    def _squares(self) -> ComplexArray:
        """Squares of the natural frequencies of the modes with loss, rad²/s²."""
        squares = (2.0 * np.pi * self.natural_hz) ** 2
        return np.asarray(squares * (1.0 + 1j * self.loss_factor_ratio))

    @property
    def _together(self) -> Array:
        """Acceleration of all as one rigid body per load on a part, shape (6, load)."""
        loads = self.inner.rigid.T @ self.inner.loads
        return np.asarray(np.linalg.solve(self.machine_mass, loads))

    @property
    def _on_modes(self) -> Array:
        """Generalised force of the shell's modes per force in a gap, shape (mode, gap)."""
        return _padded(self.modal_forces.T, len(self.inner.gaps)).T

    @property
    def _of_gaps(self) -> Array:
        """Acceleration of the shell as a rigid body per force in a gap, shape (6, gap)."""
        rigid = _padded(self.contacts.rigid, len(self.inner.gaps))
        return np.asarray(np.linalg.solve(self.shell_mass, rigid.T))

    @cached_property
    def _at_gaps(self) -> Array:
        """Gap per motion of the parts, shape (gap, motion)."""
        return self.inner.gaps @ self.motions.shapes

    @cached_property
    def _of_motions(self) -> Array:
        """Displacement of each motion of the parts per load on a part, (motion, part times
        component)."""
        return self.motions.shapes.T @ self.inner.loads


def _padded(rows: Array, number: int) -> Array:
    """Rows of the contacts followed by zeros for the bearings, which the shell does not touch."""
    return np.pad(rows, ((0, number - len(rows)), (0, 0)))
