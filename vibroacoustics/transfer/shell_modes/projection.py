"""Modes of the shell: of another thickness or material by projection; forces and response."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...machine.shell import Shell
from ...machine.shell_structure import Joint, ShellStructure
from .elements import squared_strains
from .loads import Load, mean_over_band, patch_factors
from .modes import ElasticShell, elastic_shell
from .statics import WallFlexibility


def modal_forces(shell: ElasticShell, load: Load) -> Array:
    """Generalised force of each mode per unit load, shape (mode, load): 1 for a force, 1/m for a
    moment.

    An internal pair drives a mode with the difference of its two joints.

    Parameters
    ----------
    shell : its modes
    load : unit loads
    """
    parts = [
        shapes @ load.generalised(shell.meridian, around)
        for around, (_, shapes) in shell.by_around.items()
    ]
    rows = np.concatenate([rows for rows, _ in shell.by_around.values()])
    return np.asarray(np.concatenate(parts)[np.argsort(rows)])


def patch_forces(shell: ElasticShell, joint: Joint) -> Array:
    """Generalised force of each mode per unit force outwards, up and around on each weld of a
    joint, one weld after another, shape (mode, contact).

    Parameters
    ----------
    shell : its modes
    joint : welds
    """
    mean = mean_over_band(shell.meridian, joint)
    reached = np.flatnonzero(mean.any(axis=1))
    forces = np.empty((len(shell.modes), joint.welds, 3))
    factors = patch_factors(joint, list(shell.by_around))
    for (rows, shapes), factor in zip(shell.by_around.values(), factors, strict=True):
        forces[rows] = (shapes[:, reached] @ mean[reached])[:, None] * factor
    return forces.reshape(len(forces), -1)


def velocity_per_force(
    natural_hz: Array, modal_mass_kg: Array, loss_factor_ratio: float, frequency_hz: Array
) -> ComplexArray:
    """Velocity amplitude of each mode per generalised force, shape (mode, frequency), m/(N s).

    jω / (m (ω_r² (1 + jη) - ω²)).

    Parameters
    ----------
    natural_hz, modal_mass_kg : natural frequency and modal mass of the modes, shape (mode,)
    loss_factor_ratio : structural
    frequency_hz : shape (frequency,)
    """
    omega = 2.0 * np.pi * np.asarray(frequency_hz, dtype=float)
    lossy = (2.0 * np.pi * natural_hz[:, None]) ** 2 * (1.0 + 1j * loss_factor_ratio)
    return np.asarray(1j * omega / (modal_mass_kg[:, None] * (lossy - omega**2)))


@dataclass(frozen=True)
class ProjectedModes:
    """Change of natural frequencies and modal masses by a changed wall.

    Attributes
    ----------
    shell : nominal shell; its middle surface stays
    """

    shell: ElasticShell

    def frequency_factor(self, structure: ShellStructure) -> Array:
        """Natural frequency over the nominal one, shape (mode,)."""
        stiffness = self.stiffness(structure) / self.stiffness(self.shell.structure)
        return np.asarray(np.sqrt(stiffness / self.mass_factor(structure)))

    def mass_factor(self, structure: ShellStructure) -> float:
        """Modal mass over the nominal one, equal for all modes."""
        nominal = self.shell.structure
        density = structure.density_kg_per_m3 / nominal.density_kg_per_m3
        return density * structure.thickness_m / nominal.thickness_m

    def stiffness(self, structure: ShellStructure) -> Array:
        """Modal stiffness of another wall in the nominal shapes, shape (mode,), N/m."""
        thickness, poisson = structure.thickness_m, structure.poisson_ratio
        plate = structure.youngs_modulus_pa * thickness / (1.0 - poisson**2)
        stretching, bending = self._squares[:, 0] + poisson * self._squares[:, 1]
        return np.asarray(plate * (stretching + thickness**2 / 12.0 * bending))

    def below(self, maximum_frequency_hz: float, walls: Sequence[ShellStructure]) -> IndexArray:
        """Modes that come below a frequency with a wall between those that are given.

        Parameters
        ----------
        maximum_frequency_hz : the frequency
        walls : that differ in one value each, at the ends of its range
        """
        lowest = np.array([mode.frequency_hz for mode in self.shell.modes])
        for wall in walls:
            lowest *= np.minimum(self.frequency_factor(wall), 1.0)
        return np.flatnonzero(lowest <= maximum_frequency_hz)

    @cached_property
    def flexibility(self) -> WallFlexibility:
        """Steady flexibility of the nominal wall; its orders are computed once."""
        return WallFlexibility(self.shell)

    @cached_property
    def _squares(self) -> Array:
        """`squared_strains` of all modes, shape (stretching or bending, part, mode)."""
        modes = self.shell.modes
        squares = np.zeros((2, 2, len(modes)))
        for order in {mode.around.order for mode in modes}:
            rows = [row for row, mode in enumerate(modes) if mode.around.order == order]
            shapes = np.stack([modes[row].shape for row in rows], axis=1)
            squares[..., rows] = squared_strains(self.shell.meridian, order, shapes)
        return squares


def projection_error(
    projected: ProjectedModes, shell: Shell, structure: ShellStructure, maximum_frequency_hz: float
) -> float:
    """Largest relative error of a projected natural frequency, against modes computed anew.

    Parameters
    ----------
    projected : nominal modes
    shell : its outside
    structure : the changed wall
    maximum_frequency_hz : highest frequency of the modes that are compared, by name
    """
    anew = _frequencies_hz(shell, structure, maximum_frequency_hz)
    factors = projected.frequency_factor(structure)
    expected = {
        mode.name: factor * mode.frequency_hz
        for mode, factor in zip(projected.shell.modes, factors, strict=True)
    }
    errors = [
        abs(expected[name] / frequency - 1.0)
        for name, frequency in anew.items()
        if name in expected
    ]
    return float(max(errors, default=0.0))


@lru_cache(maxsize=16)
def _frequencies_hz(
    shell: Shell, structure: ShellStructure, maximum_frequency_hz: float
) -> dict[str, float]:
    """Natural frequencies by name of the mode."""
    modes = elastic_shell(shell, structure, maximum_frequency_hz).modes
    return {mode.name: mode.frequency_hz for mode in modes}


def least_frequency_factor(nominal: ShellStructure, ends: Sequence[ShellStructure]) -> float:
    """A bound below the frequency factors of all walls between ends that differ in one value each.

    Stretching stiffness goes as E h, bending as E h³, mass as ρ h; Poisson's ratio enters both
    between 1/(1 - ν) and 1/(1 + ν).

    Parameters
    ----------
    nominal : wall for which the modes are computed
    ends : walls with one value at an end of its range
    """
    return float(np.prod([min(1.0, _least(nominal, end)) for end in ends]))


def _least(nominal: ShellStructure, changed: ShellStructure) -> float:
    poisson_nominal, other = nominal.poisson_ratio, changed.poisson_ratio
    poisson = min((1.0 - poisson_nominal) / (1.0 - other), (1.0 + poisson_nominal) / (1.0 + other))
    modulus = changed.youngs_modulus_pa / nominal.youngs_modulus_pa
    density = changed.density_kg_per_m3 / nominal.density_kg_per_m3
    thickness = changed.thickness_m / nominal.thickness_m
    return float(min(1.0, thickness) * np.sqrt(modulus * poisson / density))
