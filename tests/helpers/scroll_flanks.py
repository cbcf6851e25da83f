"""Second method for the gas forces of a scroll: pressure integrated along flanks of fine polygons.

Contacts are found as places of least distance, chambers as polygons between them. Nothing of
`vibroacoustics.mechanisms.scroll_gas` is used but the pressures' law.
"""

from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from vibroacoustics.sources.scroll_gas.parameters import ScrollGas, ScrollWraps

POINTS = 20001
INNER, OUTER = -1.0, 1.0


@dataclass
class Flank:
    """A flank as a line of points x + jy over the involute angle."""

    angle: np.ndarray
    point: np.ndarray

    def between(self, first: float, last: float) -> np.ndarray:
        """Points from one involute angle to another, in that order."""
        low, high = sorted((first, last))
        inner = self.angle[(self.angle > low) & (self.angle < high)]
        at = np.concatenate([[low], inner, [high]])
        line = np.interp(at, self.angle, self.point.real) + 1j * np.interp(
            at, self.angle, self.point.imag
        )
        return line if first <= last else line[::-1]


def fixed_flank(wraps: ScrollWraps, side: float, further: float = 0.0) -> Flank:
    """A flank of the fixed wrap, clockwise outwards; its end touches at the closing angle."""
    angle = np.linspace(wraps.start_angle_rad, wraps.end_angle_rad + further, POINTS)
    roll = angle + side * 0.5 * wraps.thickness_m / wraps.base_radius_m
    turned = wraps.closing_crank_angle_rad + wraps.end_angle_rad - 0.5 * np.pi
    return Flank(angle, wraps.base_radius_m * (1 + 1j * roll) * np.exp(1j * (turned - angle)))


def moved(flank: Flank, wraps: ScrollWraps, crank_angle: float) -> Flank:
    """The same flank of the orbiting wrap."""
    return Flank(flank.angle, wraps.orbit_radius_m * np.exp(1j * crank_angle) - flank.point)


def contacts(orbiting: Flank, fixed: Flank, reach: float) -> np.ndarray:
    """Involute angles on the two flanks where they touch, shape (contacts, 2), outermost first.

    The gap is measured along the normal of the fixed flank; a polynomial through it near each of
    its least values gives the place between the points.
    """
    tree = cKDTree(np.c_[fixed.point.real, fixed.point.imag])
    _, nearest = tree.query(np.c_[orbiting.point.real, orbiting.point.imag])
    tangent = np.gradient(fixed.point)
    tangent /= np.abs(tangent)
    apart = (orbiting.point - fixed.point[nearest]) / tangent[nearest]
    gap = np.where((nearest > 0) & (nearest < POINTS - 1), np.abs(apart.imag), np.inf)
    foot = fixed.angle[nearest]
    found = []
    window = round(0.2 / (orbiting.angle[1] - orbiting.angle[0]))
    for at in np.flatnonzero(gap < 0.01 * reach):
        near = slice(max(at - window, 0), at + window + 1)
        if gap[at] == gap[near].min() and gap[near].max() < reach:
            offset = orbiting.angle[near] - orbiting.angle[at]
            signed = np.polynomial.Polynomial.fit(offset, apart.imag[near], 7)
            roots = signed.deriv().roots()
            root = roots[np.argmin(np.abs(roots))].real
            feet = np.polynomial.Polynomial.fit(offset, foot[near], 3)
            found.append((orbiting.angle[at] + root, float(feet(root))))
    return np.array(found)[::-1]


def area(*lines: np.ndarray) -> float:
    """Area of a polygon that consists of lines joined end to start."""
    point = np.concatenate(lines)
    return 0.5 * abs(float(np.sum((np.conj(point) * np.roll(point, -1)).imag)))


@dataclass
class Position:
    """Flanks, contacts and pockets at one crank angle."""

    wraps: ScrollWraps
    crank_angle: float
    further: float = 0.0

    def __post_init__(self):
        wraps, further = self.wraps, self.further
        self.fixed = {side: fixed_flank(wraps, side, further) for side in (INNER, OUTER)}
        self.orbiting = {
            side: moved(self.fixed[side], wraps, self.crank_angle) for side in (INNER, OUTER)
        }
        self.touching = {
            side: contacts(self.orbiting[side], self.fixed[-side], 0.1 * wraps.orbit_radius_m)
            for side in (INNER, OUTER)
        }

    def pocket_areas(self, side: float) -> np.ndarray:
        """Areas on one side of the orbiting wrap between neighbouring contacts, outermost first."""
        touching = self.touching[side]
        return np.array(
            [
                area(
                    self.orbiting[side].between(one[0], next_one[0]),
                    self.fixed[-side].between(next_one[1], one[1]),
                )
                for one, next_one in pairwise(touching)
            ]
        )

    def discharge_area(self) -> float:
        """Gas inside the innermost contacts, around the starts of both wraps."""
        start = self.wraps.start_angle_rad
        a, b = self.touching[OUTER][-1], self.touching[INNER][-1]
        return area(
            self.fixed[INNER].between(a[1], start),
            self.fixed[OUTER].between(start, b[1]),
            self.orbiting[INNER].between(b[0], start),
            self.orbiting[OUTER].between(start, a[0]),
        )


@cache
def closed_area(wraps: ScrollWraps) -> float:
    """Area of a pocket as it closes, from wraps that go on beyond their end."""
    position = Position(wraps, wraps.closing_crank_angle_rad, further=1.0)
    at = np.argmin(np.abs(position.touching[INNER][:, 0] - wraps.end_angle_rad))
    return float(position.pocket_areas(INNER)[at])


def chamber_pressures(position: Position, gas: ScrollGas, side: float, closed: float) -> np.ndarray:
    """Suction, pockets from outside inwards, discharge, Pa."""
    ratio = closed / position.pocket_areas(side)
    pockets = gas.suction_pressure_pa * ratio**gas.polytropic_index
    return np.array([gas.suction_pressure_pa, *pockets, gas.discharge_pressure_pa])


def chamber_number(contact: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Number of the chamber, from outside, that a flank faces at an involute angle."""
    return np.sum(angle[:, None] < contact[None, :], axis=1)


def force_and_moment(
    position: Position, pressure: dict[float, np.ndarray]
) -> tuple[complex, float, list[complex]]:
    """Force x + jy and moment about its own axis of the gas on the orbiting wrap, N and N m.

    The two flanks and the faces at the wrap's start and end close its outline; the start lies in
    the discharge, the end in the suction. Also the force on each of the four.
    """
    wraps = position.wraps
    centre = wraps.orbit_radius_m * np.exp(1j * position.crank_angle)
    lines, pressures = [], []
    for side in (INNER, OUTER):
        touching, flank = position.touching[side][:, 0], position.orbiting[side]
        angle = np.sort(np.concatenate([flank.angle, touching]))
        line = np.interp(angle, flank.angle, flank.point.real) + 1j * np.interp(
            angle, flank.angle, flank.point.imag
        )
        number = chamber_number(touching, 0.5 * (angle[1:] + angle[:-1]))
        lines.append(line if side == INNER else line[::-1])
        faced = pressure[side][number]
        pressures.append(faced if side == INNER else faced[::-1])
    inner, outer = lines
    end, start = np.array([inner[-1], outer[0]]), np.array([outer[-1], inner[0]])
    outline = [inner, end, outer, start]
    values = [pressures[0], pressure[INNER][:1], pressures[1], pressure[INNER][-1:]]
    whole = np.concatenate(outline)
    turning = np.sign(np.sum((np.conj(whole) * np.roll(whole, -1)).imag))
    forces, moment = [], 0.0
    for line, value in zip(outline, values, strict=True):
        pushes = 1j * turning * wraps.height_m * value * np.diff(line)
        arms = 0.5 * (line[1:] + line[:-1]) - centre
        forces.append(complex(np.sum(pushes)))
        moment += float(np.sum((np.conj(arms) * pushes).imag))
    return sum(forces), moment, forces


def axial_force(position: Position, pressure: dict[float, np.ndarray]) -> float:
    """Force that parts the scrolls over suction pressure, N.

    Areas of gas, and of the tips of both wraps between cuts at the contacts with the mean of the
    pressures on their two sides.
    """
    wraps, suction = position.wraps, pressure[INNER][0]
    force = (pressure[INNER][-1] - suction) * position.discharge_area()
    for side in (INNER, OUTER):
        force += float((pressure[side][1:-1] - suction) @ position.pocket_areas(side))
    contact = {side: position.touching[side][:, 0] for side in (INNER, OUTER)}
    cuts = np.sort([wraps.start_angle_rad, wraps.end_angle_rad, *contact[INNER], *contact[OUTER]])
    cuts = cuts[np.append(True, np.diff(cuts) > 1e-4)]
    for low, high in pairwise(cuts):
        middle = np.array([0.5 * (low + high)])
        faced = [pressure[side][chamber_number(contact[side], middle)][0] for side in contact]
        strip = area(
            position.orbiting[INNER].between(low, high), position.orbiting[OUTER].between(high, low)
        )
        force += 2.0 * strip * (float(np.mean(faced)) - suction)
    return force
