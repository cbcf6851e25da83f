"""The elastic shell as a path: from loads on its joints to sound at the receivers."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import amplitude_of_level
from ..machine.frame import PARTS
from ..machine.shell import Shell
from ..machine.shell_structure import JOINTS, ShellStructure, ShellVariation
from ..mechanics.ports import WRENCH
from .cavity.in_shell import GasInShell
from .shell_modes.loads import JOINT_LOADS, JointLoads
from .shell_modes.modes import ShellMode, elastic_shell
from .shell_modes.projection import (
    ProjectedModes,
    least_frequency_factor,
    modal_forces,
    velocity_per_force,
)
from .shell_modes.sampled import SampledMode

MODES_BEYOND: Final = 1.1
"""Modes up to this many times the highest frequency take part."""


@dataclass(frozen=True)
class ShellPath:
    """The elastic modes of a machine's shell, and how loads on its joints drive them.

    Attributes
    ----------
    modes : computed or measured
    structure : its joints and, where the modes are computed, its wall
    wall : all nominal modes, for walls that differ; none where they are measured
    radius_m : radius of the wall
    rows : the path's modes among those of the wall, shape (mode,)
    frequency_factor : natural frequencies over those of the nominal modes, shape (mode,) or ()
    mass_factor : modal mass relative to that of the nominal modes, shape (mode,) or ()
    gas : spaces of gas in the shell with the nominal modes, by their shape, as they are needed
    """

    modes: tuple[ShellMode, ...] | tuple[SampledMode, ...]
    structure: ShellStructure
    wall: ProjectedModes | None
    radius_m: float
    rows: IndexArray
    frequency_factor: Array | float = 1.0
    mass_factor: float = 1.0
    gas: dict[Hashable, GasInShell] = field(default_factory=dict, repr=False)

    @cached_property
    def natural_hz(self) -> Array:
        """Shape (mode,)."""
        return self.frequency_factor * np.array([mode.frequency_hz for mode in self.modes])

    @cached_property
    def modal_mass_kg(self) -> Array:
        """Shape (mode,)."""
        return self.mass_factor * np.array([mode.modal_mass_kg for mode in self.modes])

    @cached_property
    def joint_forces(self) -> Array:
        """Generalised force per unit load, shape (mode, joint, component)."""
        joints = [getattr(self.structure, name) for name in JOINTS]
        if self.wall is not None:
            loads = [modal_forces(self.wall.shell, JointLoads(joint)) for joint in joints]
            return np.stack(loads, axis=1)[self.rows]
        modes = [mode for mode in self.modes if isinstance(mode, SampledMode)]
        return np.array(
            [[mode.modal_forces(joint, self.radius_m) for joint in joints] for mode in modes]
        )

    def forces_of_parts(self) -> Array:
        """Generalised force of each mode per load on a part that its joint hands on.

        Returns
        -------
        shape (mode, part times component, 1), the same at every frequency
        """
        forces = np.zeros((len(self.modes), len(PARTS), len(WRENCH)))
        for number, part in enumerate(PARTS):
            of_joint = self.joint_forces[:, JOINTS.index(part.joint)]
            for component in part.handed_on:
                column = of_joint[:, JOINT_LOADS.index(component)]
                forces[:, number, WRENCH.index(component)] = column
        return forces.reshape(len(forces), -1, 1)

    def with_structure(self, structure: ShellStructure) -> "ShellPath":
        """The path with sampled values of joints and wall.

        Joints are exact; another wall changes frequencies and masses of the nominal modes, by
        `ProjectedModes`, not their shapes. Measured modes stay.
        """
        path = replace(self, structure=structure)
        if self.wall is not None:
            path = replace(
                path,
                frequency_factor=self.wall.frequency_factor(structure)[self.rows],
                mass_factor=self.wall.mass_factor(structure),
            )
        return path


def computed_path(
    shell: Shell,
    structure: ShellStructure,
    maximum_frequency_hz: float,
    least_factor: float,
    walls: Sequence[ShellStructure] = (),
) -> ShellPath:
    """Modes of the closed shell that come below the highest frequency in any sample.

    Parameters
    ----------
    shell : its shape
    structure : wall, material and joints
    maximum_frequency_hz : highest frequency of the sound
    least_factor : smallest factor on the natural frequencies that any sample may have
    walls : that differ in one value each, at the ends of the ranges
    """
    highest = MODES_BEYOND * maximum_frequency_hz / least_factor
    bound = least_frequency_factor(structure, walls)
    elastic = elastic_shell(shell, structure, highest / bound)
    projected = ProjectedModes(elastic)
    rows = projected.below(highest, walls)
    return ShellPath(
        tuple(elastic.modes[row] for row in rows),
        structure,
        projected,
        shell.cylinder.radius_m,
        rows,
    )


def measured_path(
    modes: Sequence[SampledMode], structure: ShellStructure, radius_m: float
) -> ShellPath:
    """Modes that were measured, as far as they reach."""
    return ShellPath(tuple(modes), structure, None, radius_m, np.arange(len(modes)))


def pressure_per_load(
    path: ShellPath,
    pressure_per_velocity: ComplexArray,
    frequency_hz: Array,
    loss_factor_ratio: float,
    variation: ShellVariation,
    forces: Array | ComplexArray,
) -> ComplexArray:
    """Pressure of the modes per unit load, shape (receiver, load, frequency).

    Σ over the modes of transfer vector, velocity per force and force per load.

    Parameters
    ----------
    path : modes and joints
    pressure_per_velocity : pressure per velocity of the modes, shape (receiver, mode, frequency),
        Pa s/m
    frequency_hz : shape (frequency,)
    loss_factor_ratio : loss factor of the shell
    variation : how the real shell differs
    forces : generalised, per load, shape (mode, load, frequency or 1)
    """
    natural_hz = variation.frequency_factor_ratio * path.natural_hz
    moving = velocity_per_force(natural_hz, path.modal_mass_kg, loss_factor_ratio, frequency_hz)
    sound = pressure_per_velocity * moving
    gain = amplitude_of_level(variation.mobility_change_db)
    if forces.shape[-1] == 1:  # the same at all frequencies: one product
        per_load = np.moveaxis(np.tensordot(gain * sound, forces[..., 0], (1, 0)), -1, 1)
    else:
        by_frequency = np.moveaxis(gain * sound, -1, 0) @ np.moveaxis(forces, -1, 0)
        per_load = np.moveaxis(by_frequency, 0, -1)
    return np.asarray(per_load, dtype=complex)
