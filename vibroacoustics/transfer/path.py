"""The elastic shell as a path: from loads on its joints to sound at the receivers."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level
from ..machine.shell import Shell
from ..machine.shell_structure import JOINTS, ShellStructure, ShellVariation
from .shell_modes import (
    JointLoads,
    SampledMode,
    ShellMode,
    elastic_shell,
    modal_forces,
    velocity_per_force,
)

MODES_BEYOND: Final = 1.1
"""Modes up to this many times the highest frequency take part."""


@dataclass(frozen=True)
class ShellPath:
    """The elastic modes of a machine's shell, and how loads on its joints drive them.

    Attributes
    ----------
    modes : computed or measured
    joint_forces : generalised force per unit load, shape (mode, joint, component)
    """

    modes: tuple[ShellMode, ...] | tuple[SampledMode, ...]
    joint_forces: Array

    @cached_property
    def natural_hz(self) -> Array:
        """Shape (mode,)."""
        return np.array([mode.frequency_hz for mode in self.modes])

    @cached_property
    def modal_mass_kg(self) -> Array:
        """Shape (mode,)."""
        return np.array([mode.modal_mass_kg for mode in self.modes])


def computed_path(
    shell: Shell, structure: ShellStructure, maximum_frequency_hz: float, least_factor: float
) -> ShellPath:
    """Modes of the closed shell that reach the highest frequency.

    Parameters
    ----------
    shell : its shape
    structure : wall, material and joints
    maximum_frequency_hz : of the sound
    least_factor : smallest factor on the natural frequencies that any draw may have
    """
    highest = MODES_BEYOND * maximum_frequency_hz / least_factor
    elastic = elastic_shell(shell, structure, highest)
    loads = [modal_forces(elastic, JointLoads(getattr(structure, name))) for name in JOINTS]
    return ShellPath(elastic.modes, np.stack(loads, axis=1))


def measured_path(
    modes: Sequence[SampledMode], structure: ShellStructure, radius_m: float
) -> ShellPath:
    """Modes that were measured, as far as they reach.

    Parameters
    ----------
    modes : sampled at points of the shell
    structure : its joints
    radius_m : of the wall
    """
    joints = [getattr(structure, name) for name in JOINTS]
    forces = [[mode.modal_forces(joint, radius_m) for joint in joints] for mode in modes]
    return ShellPath(tuple(modes), np.array(forces))


def pressure_per_load(
    path: ShellPath,
    pressure_per_velocity: ComplexArray,
    frequency_hz: Array,
    loss_factor_ratio: float,
    variation: ShellVariation,
) -> ComplexArray:
    """Pressure per unit load on a joint, shape (receiver, joint, component, frequency).

    Σ over the modes of transfer vector, velocity per force and force per load.

    Parameters
    ----------
    path : modes and joints
    pressure_per_velocity : of the modes, shape (receiver, mode, frequency), Pa s/m
    frequency_hz : shape (frequency,)
    loss_factor_ratio : of the shell
    variation : how the real shell differs
    """
    natural_hz = variation.frequency_factor_ratio * path.natural_hz
    moving = velocity_per_force(natural_hz, path.modal_mass_kg, loss_factor_ratio, frequency_hz)
    sound = pressure_per_velocity * moving
    gain = amplitude_of_level(variation.mobility_change_db)
    return np.asarray(gain * np.einsum("rmf,mjc->rjcf", sound, path.joint_forces, optimize=True))
