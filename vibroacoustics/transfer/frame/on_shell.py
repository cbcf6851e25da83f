"""A machine's frame in its elastic shell: what loads on the parts do to the shell."""

from dataclasses import dataclass
from typing import Final

import numpy as np

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
from ..shell_modes import modal_forces, velocity_per_force
from ..shell_modes.loads import PatchLoads
from ..shell_modes.projection import ProjectedModes
from ..shell_modes.statics import local_flexibility_factor
from .contacts import Contacts, contacts_of
from .inner import InnerSet, inner_set
from .solve import contact_forces, reaction_forces, shell_compliance

SHAFT_ELEMENT_M: Final = 0.04
"""A sixth of the wavelength of bending at 4 kHz; cubic shapes err by 0.1 % of a frequency."""


@dataclass(frozen=True)
class ShellForces:
    """What unit loads on the parts do to the shell.

    Attributes
    ----------
    on_contacts : force at each contact, shape (frequency, contact, part times component)
    on_modes : generalised force of each elastic mode, shape (mode, part, component, frequency)
    rigid_velocity : of the shell as a rigid body beyond that of the machine as one, about its
        centre of mass, shape (6, part, component, frequency), m/s and rad/s
    """

    on_contacts: ComplexArray
    on_modes: ComplexArray
    rigid_velocity: ComplexArray


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

    def compliance(self, frequency_hz: Array) -> ComplexArray:
        """Of the shell at its contacts, (frequency, contact, contact), m/N."""
        rows = self.contacts.rigid
        return shell_compliance(
            self.modal_forces,
            self.natural_hz,
            self.modal_mass_kg,
            self.loss_factor_ratio,
            self.residual,
            rows @ np.linalg.solve(self.shell_mass, rows.T),
            frequency_hz,
        )

    def forces(self, frequency_hz: Array) -> ShellForces:
        """Forces on the shell per load on a part; none at frequency zero.

        Parameters
        ----------
        frequency_hz : shape (frequency,)
        """
        moves = frequency_hz > 0.0
        frequency, loads = frequency_hz[moves], len(PARTS) * PART_COMPONENTS
        on_contacts = np.zeros((moves.size, len(self.contacts.part), loads), dtype=complex)
        on_contacts[moves] = contact_forces(
            self.inner, self.contacts.stiffness, self.compliance(frequency), frequency
        )
        shape = (-1, len(PARTS), PART_COMPONENTS, moves.size)
        on_modes = np.moveaxis(self.modal_forces @ on_contacts, 0, -1).reshape(shape)
        together = np.tile(np.linalg.inv(self.machine_mass), len(PARTS))
        acceleration = np.linalg.solve(self.shell_mass, self.contacts.rigid.T) @ on_contacts
        velocity = _velocity(acceleration - together, frequency_hz)
        return ShellForces(on_contacts, on_modes, np.moveaxis(velocity, 0, -1).reshape(shape))

    def under_modal_forces(self, driven: ComplexArray, frequency_hz: Array) -> ShellForces:
        """Forces on a shell whose modes something else drives: those, and the parts' reaction.

        Parameters
        ----------
        driven : generalised forces, shape (mode, frequency)
        frequency_hz : shape (frequency,)

        Returns
        -------
        with one part and component in the place of a load's
        """
        moves = frequency_hz > 0.0
        frequency = frequency_hz[moves]
        elastic = velocity_per_force(
            self.natural_hz, self.modal_mass_kg, self.loss_factor_ratio, frequency
        )
        moved = self.modal_forces.T @ (elastic * driven[:, moves] / (2j * np.pi * frequency))
        on_contacts = np.zeros((moves.size, len(self.contacts.part), 1), dtype=complex)
        on_contacts[moves] = reaction_forces(
            self.inner,
            self.contacts.stiffness,
            self.compliance(frequency),
            frequency,
            np.asarray(moved.T[:, :, None]),
        )
        on_modes = driven + (self.modal_forces @ on_contacts)[..., 0].T
        acceleration = np.linalg.solve(self.shell_mass, self.contacts.rigid.T) @ on_contacts
        velocity = np.moveaxis(_velocity(acceleration, frequency_hz), 0, -1)
        return ShellForces(on_contacts, on_modes[:, None, None], velocity[:, None])


def _velocity(acceleration: ComplexArray, frequency_hz: Array) -> ComplexArray:
    """Over frequency, the first axis; none at frequency zero."""
    omega = 2.0 * np.pi * frequency_hz[:, None, None]
    moves = omega > 0.0
    return np.asarray(np.where(moves, acceleration / (1j * np.where(moves, omega, 1.0)), 0.0))


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
