"""Masses on springs assembled by hand, to which the package is compared."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.linalg import eig


class Mass(NamedTuple):
    """A rigid body."""

    mass_kg: float
    inertia_kg_m2: np.ndarray
    centre_m: np.ndarray


class Spring(NamedTuple):
    """Complex stiffness, (6, 6), between a body and another one or, at None, the ground."""

    first: int
    second: int | None
    point_m: np.ndarray
    stiffness: np.ndarray


def of_points(point_m: np.ndarray, centre_m: np.ndarray) -> np.ndarray:
    """Motion of a point per motion of the centre: u = t + θ × (p - c), one column at a time."""
    columns = np.eye(6)
    for axis in range(3):
        columns[:3, 3 + axis] = np.cross(np.eye(3)[axis], np.asarray(point_m) - centre_m)
    return columns


def assembled(masses: Sequence[Mass], springs: Sequence[Spring]) -> tuple[np.ndarray, np.ndarray]:
    """Mass and stiffness, shape (6 bodies, 6 bodies)."""
    size = 6 * len(masses)
    mass, stiffness = np.zeros((size, size)), np.zeros((size, size), complex)
    for number, one in enumerate(masses):
        at = slice(6 * number, 6 * number + 6)
        mass[at, at][:3, :3], mass[at, at][3:, 3:] = one.mass_kg * np.eye(3), one.inertia_kg_m2
    for spring in springs:
        stretch = np.zeros((6, size))
        for end, sign in ((spring.first, 1.0), (spring.second, -1.0)):
            if end is not None:
                at = slice(6 * end, 6 * end + 6)
                stretch[:, at] = sign * of_points(spring.point_m, masses[end].centre_m)
        stiffness += stretch.T @ spring.stiffness @ stretch
    return mass, stiffness


def on_feet(machine) -> list[Spring]:
    """Four mounts in a square under body 0 of a machine whose file gives no feet."""
    mounts = machine.mounts
    lateral, vertical = mounts.lateral_stiffness_n_per_m, mounts.vertical_stiffness_n_per_m
    factor = 1.0 + 1j * mounts.loss_factor_ratio
    stiffness = factor * np.diag([lateral, lateral, vertical, 0.0, 0.0, 0.0])
    half, height = 0.5 * mounts.pitch_m, -machine.shell.centre_of_mass_height_m
    corners = ((half, half), (half, -half), (-half, half), (-half, -half))
    return [Spring(0, None, np.array([x, y, height]), stiffness) for x, y in corners]


def mass_of(housing, centre_m=(0.0, 0.0, 0.0)) -> Mass:
    """A table of the machine's file."""
    moments = [getattr(housing, f"inertia_{axes}_kg_m2") for axes in ("xx", "yy", "zz")]
    return Mass(housing.mass_kg, np.diag(moments), np.asarray(centre_m))


def solved(mass: np.ndarray, stiffness: np.ndarray, load: np.ndarray, hertz: float) -> np.ndarray:
    """Displacement of all bodies; at rest without loss."""
    omega = 2.0 * np.pi * hertz
    held = stiffness if hertz > 0.0 else stiffness.real
    return np.linalg.solve(held - omega**2 * mass, load)


def foot_forces(springs: Sequence[Spring], displacement: np.ndarray) -> np.ndarray:
    """Of the springs to the ground, shape (foot, 3)."""
    origin = np.zeros(3)
    return np.array(
        [
            (one.stiffness @ of_points(one.point_m, origin) @ displacement[:6])[:3]
            for one in springs
            if one.second is None
        ]
    )


def natural_hz(mass: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Without loss, rising, Hz."""
    squares = eig(stiffness.real, mass, right=False)
    return np.sort(np.sqrt(squares.real)) / (2.0 * np.pi)
