"""Compiled walls: branches of mass, resistance and spring; re-entrant edges of furniture."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from ...base.constants import SPEED_OF_SOUND_M_PER_S
from ..arrays import Array, IndexArray
from .box_step import kernel
from .cutting import AirBox, Face
from .impedance import Branches, fitted_branches
from .room import WAVE_OCTAVES, Material
from .settings import STEPS_PER_PERIOD

EDGE_RATIO: Final = 0.163
"""Excess air of a node beside a re-entrant edge over its width, by `interface_air_m`."""
_LEAST_RATIO: Final = 0.3
"""Least share of the air of a node that is kept."""
_ASIDE_M: Final = 1e-5


def interface_air_m(
    boxes: Sequence[AirBox], face: Face, nodes: Sequence[int], air_m: float
) -> Array:
    """Return the length of air at each node of an interface, shape (node, node), m.

    It is less beside re-entrant edges.

    Around an edge of 270 degrees of air the flux grows as r^(-1/3) (P. Grisvard, Elliptic Problems
    in Nonsmooth Domains, 1985, section 4.4). A node beside it passes it as if it were even over its
    width, with too much kinetic energy: frequencies fall by the spacing's power of 4/3. Too much is
    a length of air in proportion to the width. `EDGE_RATIO` is the one with which the lowest
    frequency of M. Dauge's L-shaped region is exact; square nodes of 1/4, 1/8 and 1/12 of its short
    edges need 0.162 to 0.166, at any time step.

    Parameters
    ----------
    boxes : boxes of the air
    face : interface between two of them
    nodes : its nodes along both axes
    air_m : length of air at a node away from edges, m
    """
    across = np.delete(np.arange(3), face.ends[0].axis)
    lengths = np.full(tuple(nodes), air_m)
    widths = (face.upper - face.lower) / nodes
    for row in (0, 1):
        other = 1 - row
        along = face.lower[other] + widths[other] * (np.arange(nodes[other]) + 0.5)
        for end, border in ((0, face.lower[row]), (-1, face.upper[row])):
            edge = np.zeros((along.size, 3))
            edge[:, face.ends[0].axis] = boxes[face.ends[0].box].upper[face.ends[0].axis]
            edge[:, across[row]], edge[:, across[other]] = border, along
            turns = _turns(boxes, edge, (face.ends[0].axis, int(across[row])))
            beside = np.moveaxis(lengths, row, 0)[end]  # a view
            beside -= EDGE_RATIO * widths[row] * turns
    return np.asarray(np.maximum(lengths, _LEAST_RATIO * air_m))


def _turns(boxes: Sequence[AirBox], edge: Array, axes: tuple[int, int]) -> Array:
    """Whether two boxes fill three of the four quadrants around points of an edge, (point,).

    Two interfaces of three boxes share the flux; their excess is small (0.02 to 0.04 widths).
    """
    quadrants = []
    for first in (-_ASIDE_M, _ASIDE_M):
        for second in (-_ASIDE_M, _ASIDE_M):
            points = edge.copy()
            points[:, axes[0]] += first
            points[:, axes[1]] += second
            quadrants.append(_boxes_of(boxes, points))
    held = np.sort(quadrants, axis=0)
    distinct = 1 + np.count_nonzero(np.diff(held[1:], axis=0), axis=0)
    return np.asarray((held[0] < 0) & (held[1] >= 0) & (distinct == 2))


def _boxes_of(boxes: Sequence[AirBox], points: Array) -> IndexArray:
    """Number of the box that holds each point, -1 in a solid, (point,)."""
    held = np.full(len(points), -1, dtype=np.intp)
    for number, box in enumerate(boxes):
        held[np.all((points > box.lower) & (points < box.upper), axis=1)] = number
    return held


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
