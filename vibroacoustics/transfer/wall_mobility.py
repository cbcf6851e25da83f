"""Velocity of points of the shell's wall by forces on the wall and on the parts in it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.frame import PARTS
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure, ShellVariation
from .bending import BendingShell
from .frame.of_machine import frame_on_shell
from .observers import constant
from .path import ShellPath

Reference = int | tuple[str, str]
"""A force outwards at a point, by its number, or on a part along an axis, `fx`."""


def wall_points(angle_rad: Array, height_m: Array, radius_m: float) -> tuple[Array, Array]:
    """Points of a round wall from the centre of mass, m, and outward normals, both (point, 3).

    Parameters
    ----------
    angle_rad : from x towards y, shape (point,)
    height_m : shape (point,)
    radius_m : radius of the wall
    """
    normal = np.stack([np.cos(angle_rad), np.sin(angle_rad), np.zeros_like(angle_rad)], axis=1)
    return radius_m * normal + np.outer(height_m, [0.0, 0.0, 1.0]), normal


@dataclass(frozen=True)
class ShellMobilities:
    """Measured mobilities, each once, repeats averaged.

    Attributes
    ----------
    frequency_hz : shape (frequency,)
    mobility : outward velocity per force, m/(N s), shape (mobility, frequency)
    response : name of the point on the wall, by mobility
    reference : name of the point on the wall or of the part's
    unused : frequency responses of nodes that the study does not name
    """

    frequency_hz: Array
    mobility: ComplexArray
    response: tuple[str, ...]
    reference: tuple[str, ...]
    unused: int


@dataclass(frozen=True)
class Wall:
    """Outward velocities of points of the wall.

    Attributes
    ----------
    modes : per velocity of each mode of a path, shape (point, mode)
    rigid : per velocity of the six rigid motions, shape (point, 6)
    """

    modes: Array
    rigid: Array


def wall_of(path: ShellPath, angle_rad: Array, height_m: Array) -> Wall:
    """Points of the wall of a path; see `wall_points`."""
    points, normal = wall_points(angle_rad, height_m, path.radius_m)
    modes = [(mode.velocity(points) * normal).sum(axis=1) for mode in path.modes]
    rigid = np.concatenate([normal, np.cross(points, normal)], axis=1)
    return Wall(np.stack(modes, axis=1), rigid)


def wall_mobility(
    machine: Machine,
    path: ShellPath,
    wall: Wall,
    references: Sequence[Reference],
    frequency_hz: Array,
) -> ComplexArray:
    """Outward velocity of points per force, m/(N s), shape (point, reference, frequency).

    By the modes of the shell, with its frame where it has one, as the sources drive them. A force
    on the wall drives the elastic modes alone: the part of the rigid machine is omitted.

    Parameters
    ----------
    machine : wall, frame, how the real shell differs
    path : modes and joints of the study
    wall : points
    references : forces
    frequency_hz : above zero, shape (frequency,)
    """
    structure, variation = machine.table(ShellStructure), machine.table(ShellVariation)
    shell_path = path.with_structure(structure)
    shell = BendingShell(
        shell_path, structure.loss_factor_ratio, variation, frame_on_shell(machine, shell_path)
    )
    points, lines = constant(wall.rigid, wall.modes), np.arange(frequency_hz.size)
    parts = {part.name: part for part in PARTS}
    columns = []
    for reference in references:
        if isinstance(reference, int):
            forces = np.repeat(wall.modes[reference][:, None, None], lines.size, axis=2)
            driven_by = points, forces, frequency_hz, lines, shell.frame
            columns.append(shell.of_modal_forces(*driven_by)[:, 0])
        else:
            part, axis = parts[reference[0]], parts[reference[0]].components.index(reference[1])
            columns.append(shell.response(points, part, frequency_hz, lines)[:, axis])
    return np.stack(columns, axis=1)
