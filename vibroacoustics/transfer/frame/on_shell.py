"""A machine's frame in its elastic shell: what loads on the parts do to the shell."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from scipy.linalg import block_diag

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError
from ...machine.frame import Frame
from ...machine.housing import Housing
from ...machine.machine import Machine
from ...machine.shell_structure import ShellVariation
from ...mechanics.critical_speed import free_scroll_shaft
from ...mechanics.loads import PART_COMPONENTS, PARTS
from ...mechanics.scroll_shaft import ScrollShaft
from ..path import ShellPath
from ..shell_modes import modal_forces
from ..shell_modes.loads import PatchLoads
from ..shell_modes.projection import ProjectedModes
from ..shell_modes.statics import local_flexibility_factor
from .contacts import Contacts, contacts_of
from .inner import InnerSet, inner_set
from .natural import NaturalMotions, natural_motions

SHAFT_ELEMENT_M: Final = 0.04
"""A sixth of the wavelength of bending at 4 kHz; cubic shapes err by 0.1 % of a frequency."""


@dataclass(frozen=True)
class FrameOnShell:
    """Frame, shaft and stator in the shell, with one set of values.

    Attributes
    ----------
    inner : the parts
    contacts : of the parts with the shell
    modal_forces : of the shell's modes per force on a contact, shape (mode, contact)
    residual : steady flexibility that the modes leave out, shape (contact, contact), m/N
    natural_hz, modal_mass_kg : of the modes, shape (mode,)
    loss_factor_ratio : of the shell
    machine_mass : of all, shape (6, 6), kg and kg m²
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
        """Of what moves with the shell as a rigid body, shape (6, 6), kg and kg m²."""
        return self.machine_mass - self.inner.rigid_mass

    @cached_property
    def motions(self) -> NaturalMotions:
        """Of the parts, the shell's modes and its rigid motion together; all but the machine's as
        one rigid body."""
        bodies = self.inner.mass, np.diag(self.modal_mass_kg), self.shell_mass
        stretch, elastic = self._stretch, self._elastic
        stiffness = block_diag(self.inner.stiffness, np.diag(elastic), np.zeros((6, 6)))
        stiffness = stiffness + stretch.T @ self._held @ stretch
        still = np.zeros((elastic.size, 6))
        free = np.concatenate([self.inner.rigid, still, np.eye(6)])
        return natural_motions(block_diag(*bodies), stiffness, free)

    @property
    def _elastic(self) -> ComplexArray:
        """Stiffness of the modes, N/m."""
        squares = (2.0 * np.pi * self.natural_hz) ** 2
        return np.asarray(self.modal_mass_kg * squares * (1.0 + 1j * self.loss_factor_ratio))

    @cached_property
    def _stretch(self) -> Array:
        """Of the contacts per freedom of the parts, mode and rigid motion of the shell."""
        shell = np.concatenate([self.modal_forces.T, self.contacts.rigid], axis=1)
        return np.concatenate([self.inner.contacts, -shell], axis=1)

    @cached_property
    def _held(self) -> ComplexArray:
        """Force per stretch, each contact in series with the residual flexibility of the wall."""
        wall = self.residual / (1.0 + 1j * self.loss_factor_ratio)
        return np.asarray(np.linalg.inv(np.diag(1.0 / self.contacts.stiffness) + wall))

    def contact_forces(self, frequency_hz: Array) -> ComplexArray:
        """Forces on the shell per load on a part, (frequency, contact, part times component).

        None at frequency zero.

        Parameters
        ----------
        frequency_hz : shape (frequency,)
        """
        forces = self._held @ self._stretch @ self.motions.shapes
        answer = self.motions.per_drive(frequency_hz)
        return np.asarray((forces * answer.T[:, None]) @ self.drives_of_parts)

    def sound(self, pressure_per_velocity: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Pressure per drive of each natural motion, (receiver, natural motion, frequency).

        None at frequency zero; without that of the machine as one rigid body.

        Parameters
        ----------
        pressure_per_velocity : of the shell's modes and then its six rigid motions about the
            centre of mass, shape (receiver, motion, frequency), Pa s/m and Pa s/rad
        frequency_hz : shape (frequency,)
        """
        of_shell = self.motions.shapes[len(self.inner.mass) :]
        sound = np.moveaxis(np.tensordot(pressure_per_velocity, of_shell, (1, 0)), -1, 1)
        velocity = 2j * np.pi * frequency_hz * self.motions.per_drive(frequency_hz)
        return np.asarray(sound * velocity)

    def per_load(self, sound: ComplexArray) -> ComplexArray:
        """Pressure per load on a part, (receiver, part, component, frequency).

        Parameters
        ----------
        sound : of the natural motions
        """
        per_load = np.moveaxis(np.tensordot(sound, self.drives_of_parts, (1, 0)), -1, 1)
        shape = len(sound), len(PARTS), PART_COMPONENTS, sound.shape[-1]
        return np.asarray(per_load.reshape(shape))

    def per_modal_forces(self, sound: ComplexArray, driven: ComplexArray) -> ComplexArray:
        """Pressure of a shell whose modes something else drives, shape (receiver, frequency).

        Parameters
        ----------
        sound : of the natural motions
        driven : generalised forces on the modes, shape (mode, frequency), N
        """
        parts = len(self.inner.mass)
        drives = self.motions.drives[:, parts : parts + len(driven)] @ driven
        return np.asarray(np.einsum("rnf,nf->rf", sound, drives))

    @property
    def drives_of_parts(self) -> ComplexArray:
        """Of each natural motion per load on a part, shape (motion, part times component)."""
        return np.asarray(self.motions.drives[:, : len(self.inner.mass)] @ self.inner.loads)


def frame_on_shell(machine: Machine, path: ShellPath) -> FrameOnShell | None:
    """The machine's frame in its shell; none where it has no frame.

    Parameters
    ----------
    machine : frame, shaft, mass, how the real shell differs
    path : modes with the machine's structure

    Raises
    ------
    ParameterError
        The modes are measured, the parts weigh more than the machine, or a contact lies beyond the
        wall.
    """
    if not machine.has_table(Frame):
        return None
    frame, wall = machine.table(Frame), path.wall
    if wall is None:
        raise ParameterError("shell_modes: measured modes and a frame do not go together")
    contacts = contacts_of(frame, path.structure, wall.shell.meridian.wall_radius_m)
    shaft = free_scroll_shaft(machine.table(ScrollShaft), SHAFT_ELEMENT_M)
    inner = inner_set(frame, shaft, contacts)
    factor = machine.table(ShellVariation).frequency_factor_ratio
    driven = np.concatenate([modal_forces(wall.shell, PatchLoads(j)) for j in contacts.joints], 1)
    residual = _residual(path, wall, contacts, driven) / factor**2
    on_shell = FrameOnShell(
        inner,
        contacts,
        driven[path.rows],
        residual,
        factor * path.natural_hz,
        path.modal_mass_kg,
        path.structure.loss_factor_ratio,
        _machine_mass(machine.housing),
    )
    _check_shell_mass(machine.housing, on_shell)
    return on_shell


def _residual(path: ShellPath, wall: ProjectedModes, contacts: Contacts, driven: Array) -> Array:
    """Steady flexibility at the contacts without that of the path's modes."""
    given, rows = wall.shell, path.rows
    modes = [given.modes[row] for row in rows]
    stiffness = np.array(
        [mode.modal_mass_kg * (2.0 * np.pi * mode.frequency_hz) ** 2 for mode in modes]
    )
    left = wall.flexibility.at(contacts.joints) - driven[rows].T @ (
        driven[rows] / stiffness[:, None]
    )
    return np.asarray(left * local_flexibility_factor(given.structure, path.structure))


def _machine_mass(housing: Housing) -> Array:
    moments = (housing.inertia_xx_kg_m2, housing.inertia_yy_kg_m2, housing.inertia_zz_kg_m2)
    return np.diag([*[housing.mass_kg] * 3, *moments])


def _check_shell_mass(housing: Housing, on_shell: FrameOnShell) -> None:
    if np.linalg.eigvalsh(on_shell.shell_mass)[0] <= 0.0:
        raise ParameterError(
            f"housing.mass_kg = {housing.mass_kg:g} kg: frame and shaft weigh "
            f"{on_shell.inner.rigid_mass[0, 0]:.3g} kg or turn as heavily; nothing is left for "
            "the shell"
        )
