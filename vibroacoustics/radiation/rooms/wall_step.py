"""Compiled walls: branches of mass, resistance and spring behind a length of air."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, IndexArray
from .box_step import kernel
from .impedance import Branches, fitted_branches
from .room import WAVE_OCTAVES, Material
from .settings import STEPS_PER_PERIOD

_LOWEST_HZ: Final = 20.0
_HIGHEST_STEPS: Final = 1.25 / STEPS_PER_PERIOD
"""Highest frequency that is fitted times the time step: a quarter above that of interest, where
the fit would be worst at its end."""
_FREQUENCIES: Final = 60
_STAY: Final = 1e-3
"""Weight by which branches that matter little stay what they are."""


@dataclass(frozen=True)
class WallPatch:
    """Nodes of one material, one after the other."""

    first_node: int
    nodes: int
    material: Material
    mass_m: float
    """Length of air between the pressure that is known and the wall, m."""


class Walls:
    """State of all patches of walls of a room, and what a step does to it.

    U = rho c u out of the room midway in the steps, S the sum of its means over the steps.
    The trapezoidal rule for each branch, L (U+ - U-)/dt + R (U+ + U-)/2 + K dt (S+ + S-)/4 = p,
    keeps the branches passive whatever the step (Bilbao et al. (2016), section IV), and p is what
    the mass of air in front leaves, p - d/c (U+ - U-)/dt with the sum of U over the branches.
    """

    def __init__(self, patches: Sequence[WallPatch], time_step_s: float) -> None:
        self.patches: IndexArray = np.array(
            [[patch.first_node, patch.nodes] for patch in patches], dtype=np.intp
        ).reshape(-1, 2)
        count = WAVE_OCTAVES
        self.coefficients = np.zeros((len(patches), 3, count))
        self.mass = np.zeros(len(patches))
        for number, patch in enumerate(patches):
            self.mass[number] = patch.mass_m / (SPEED_OF_SOUND_M_PER_S * time_step_s)
            self.coefficients[number] = _coefficients(patch.material, time_step_s)
        total = int(self.patches[:, 1].sum())
        self.flux = np.zeros((count, total))
        self.sums = np.zeros((count, total))
        self.work = np.zeros((3, max((patch.nodes for patch in patches), default=1)))

    @property
    def arguments(self) -> tuple[Any, ...]:
        """Arguments of `pass_walls` after the pressure and the change of the flux."""
        return self.patches, self.coefficients, self.mass, self.flux, self.sums, self.work


@lru_cache
def _coefficients(material: Material, time_step_s: float) -> Array:
    """Coefficients of p, U- and S- in the next flux of each branch, (3, branch)."""
    stepped = stepped_branches(fitted_branches(material), time_step_s)
    mass, spring = stepped.mass / time_step_s, stepped.spring * time_step_s
    resistance = stepped.resistance / 2.0
    total = mass + resistance + spring / 4.0
    rows = [1.0 / total, (mass - resistance - spring / 4.0) / total, spring / (2.0 * total)]
    return np.asarray(np.array(rows))


def stepped_branches(branches: Branches, time_step_s: float) -> Branches:
    """Branches whose steps have the admittance of those given; all parts above zero: passive.

    The trapezoidal rule turns omega into W = tan(omega dt/2) 2/dt. Least squares of the admittance
    over the frequencies of interest, relative to it.
    """
    from scipy.optimize import least_squares

    frequency = np.geomspace(_LOWEST_HZ, _HIGHEST_STEPS / time_step_s, _FREQUENCIES)
    warped = np.tan(np.pi * frequency * time_step_s) / (np.pi * time_step_s)
    wanted = branches.admittance(frequency)
    parts = np.array([branches.mass, branches.resistance, branches.spring])

    def trial(logarithm: Array) -> Branches:
        return Branches(*(parts * np.exp(logarithm.reshape(parts.shape))))

    def error(logarithm: Array) -> Array:
        difference = trial(logarithm).admittance(warped) / wanted - 1.0
        return np.concatenate([difference.real, difference.imag, _STAY * logarithm])

    def slopes(logarithm: Array) -> Array:
        relative = trial(logarithm).slopes(warped).reshape(len(warped), -1) / wanted[:, None]
        return np.concatenate([relative.real, relative.imag, _STAY * np.eye(parts.size)])

    return trial(least_squares(error, np.zeros(parts.size), slopes, method="lm").x)


@kernel
def pass_walls(pressure: Any, change: Any, walls: Any) -> None:  # pragma: no cover
    """Fluxes into all walls a step on, and their change at the nodes."""
    patches, coefficients, mass, flux, sums, work = walls
    start = 0
    for patch in range(patches.shape[0]):
        first, count = patches[patch]
        p, c = pressure[first : first + count], change[first : first + count]
        history, total, wall = work[0, :count], work[1, :count], work[2, :count]
        gives, keeps, pulls = coefficients[patch]
        history[:] = 0.0
        total[:] = 0.0
        for branch in range(gives.size):
            u, s = flux[branch, start : start + count], sums[branch, start : start + count]
            keep, pull = keeps[branch], pulls[branch]
            for n in range(count):
                history[n] += keep * u[n] - pull * s[n]
                total[n] += u[n]
        give, air = gives.sum(), mass[patch]
        share = 1.0 / (1.0 + give * air)
        for n in range(count):
            after = share * (give * (p[n] + air * total[n]) + history[n])
            c[n] = after - total[n]
            wall[n] = p[n] - air * c[n]
        for branch in range(gives.size):
            u, s = flux[branch, start : start + count], sums[branch, start : start + count]
            give, keep, pull = gives[branch], keeps[branch], pulls[branch]
            for n in range(count):
                new = give * wall[n] + keep * u[n] - pull * s[n]
                s[n] += new + u[n]
                u[n] = new
        start += count
