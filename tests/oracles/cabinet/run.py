"""Sound of the shell in its cabinet over the floor, by `collocation`.

A second method beside the package's cut cells: it shares no code with `vibroacoustics` and needs
NumPy and SciPy alone (see README.md). Lengths in m, z from the floor.
"""

import argparse
import csv
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
from collocation import (
    AIR_DENSITY_KG_PER_M3,
    IMAGES,
    SPEED_OF_SOUND_M_PER_S,
    Array,
    ComplexArray,
    Mesh,
    Radiation,
)

RADIUS_M, BOTTOM_M, TOP_M, CENTRE_OF_MASS_M = 0.0825, 0.025, 0.442, 0.215
HALF_DEPTH_M, HALF_WIDTH_M, HEIGHT_M, THICKNESS_M = 0.15, 0.4, 0.7, 0.036
"""The cabinet's inside, and its panels; it is open towards +x."""
PATTERNS: Final = ("tx", "tz", "ry")
FREQUENCIES_HZ: Final = (50, 100, 150, 200, 250, 285, 290, 350, 420, 480, 535, 600)
MICROPHONES: Final = {
    "front": (1.0825, 0.0, 0.23),
    "left": (-0.5413, 1.4, 0.23),
    "right": (-0.3702, -1.4, 0.4),
    "above": (0.06, 0.03, 1.9),
    "front left": (1.0, 0.8, 0.6),
    "behind": (-1.2, 0.3, 0.5),
    "front right": (0.8, -0.4, 1.2),
    "low left": (0.5, 1.2, 0.1),
}
PLACES: Final[Array] = np.array(list(MICROPHONES.values()))
PARTS: Final = (3, 4)
"""Of the coarser and the finer mesh."""
COLUMNS: Final = (
    "pattern",
    "frequency_hz",
    "microphone",
    "x_m",
    "y_m",
    "height_m",
    "pressure_real_pa",
    "pressure_imaginary_pa",
    "uncertainty_pa",
)


def _patch(points: Array, outward: Array) -> Array:
    """Elements of a grid of nodes (m, n, 3), turned so that normals point as asked, (3,).

    Zeros ask for away from the z axis.
    """
    quads = np.stack([points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]], axis=2)
    quads = quads.reshape(-1, 4, 3)
    normal = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    asked = outward if outward.any() else quads.mean(axis=1) * [1.0, 1.0, 0.0]
    inverted = np.sum(normal * asked, axis=1) < 0.0
    quads[inverted] = quads[inverted, ::-1]
    return quads


def _panels(parts: int) -> Iterator[Array]:
    a, b, h, t = HALF_DEPTH_M, HALF_WIDTH_M, HEIGHT_M, THICKNESS_M
    outer, wide, high = a + t, b + t, h + t
    depth, inner_depth = (np.linspace(low, outer, 3 * parts + 1) for low in (-outer, -a))
    width, inner_width = (np.linspace(0.0, reach, 4 * parts + 1) for reach in (wide, b))
    height, inner_height = (np.linspace(0.0, reach, 6 * parts + 1) for reach in (high, h))
    side, lid = (np.linspace(low, low + t, parts + 1) for low in (b, h))
    faces = [
        (0, -1, -outer, width, height),
        (1, +1, wide, depth, height),
        (2, +1, high, depth, width),
        (0, +1, -a, inner_width, inner_height),
        (1, -1, b, inner_depth, inner_height),
        (2, -1, h, inner_depth, inner_width),
        (0, +1, outer, side, height),
        (0, +1, outer, inner_width, lid),
    ]
    for axis, sign, place, first, second in faces:
        points = np.full((first.size, second.size, 3), place)
        one, other = [coordinate for coordinate in range(3) if coordinate != axis]
        points[..., one], points[..., other] = first[:, None], second
        yield _patch(points, sign * np.eye(3)[axis])


def _shell(parts: int) -> Iterator[Array]:
    """Side, bottom and top; the polygon has the circle's area."""
    turn = np.linspace(0.0, np.pi, 4 * parts + 1)
    radius = RADIUS_M * np.sqrt(turn[1] / np.sin(turn[1]))
    around = np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], axis=1)
    height = np.linspace(BOTTOM_M, TOP_M, 7 * parts + 1)[:, None, None] * [0.0, 0.0, 1.0]
    yield _patch(height + radius * around, np.zeros(3))
    rings = np.linspace(0.0, radius, parts + 1)[:, None, None]
    for place, sign in ((BOTTOM_M, -1.0), (TOP_M, 1.0)):
        yield _patch(rings * around + [0.0, 0.0, place], np.array([0.0, 0.0, sign]))


def cabinet_mesh(parts: int) -> Mesh:
    """Shell and panels; every length has a multiple of `parts` elements."""
    shell, panels = (np.concatenate(list(faces(parts))) for faces in (_shell, _panels))
    moving = np.arange(len(shell) + len(panels)) < len(shell)
    return Mesh(np.concatenate([shell, panels]), moving)


def points_inside() -> Array:
    """Points in the shell and in the panels, (point, 3)."""
    in_shell = [(0.03, 0.02, 0.13), (-0.04, 0.01, 0.22), (0.01, 0.03, 0.31), (0.02, 0.04, 0.38)]
    back, side, lid = -HALF_DEPTH_M - 0.015, HALF_WIDTH_M + 0.02, HEIGHT_M + 0.016
    in_panels = [(back, 0.13, 0.21), (back, 0.29, 0.55), (0.04, side, 0.17), (0.11, side, 0.47)]
    return np.array([*in_shell, *in_panels, (0.05, 0.11, lid), (-0.07, 0.31, lid)])


def rigid_motions(mesh: Mesh) -> ComplexArray:
    """Normal velocity of 1 m/s along x and z, 1 rad/s about y through the centre of mass."""
    points = mesh.gauss[0] - [0.0, 0.0, CENTRE_OF_MASS_M]
    n_x, n_z = mesh.normal[:, 0], mesh.normal[:, 2]
    turning = mesh.mean(points[..., 2] * n_x[:, None] - points[..., 0] * n_z[:, None])
    velocity: ComplexArray = np.stack([n_x, n_z, turning], axis=1).astype(complex)
    return np.where(mesh.moving[:, None], velocity, 0.0)


def monopoles() -> tuple[Array, Array]:
    """In the shell alone, and in the panels too: places (source, 3), strengths (source, 2)."""
    shell = [(0.02, 0.01, 0.12), (-0.03, 0.0, 0.26), (0.01, 0.02, 0.36)]
    a, b, h, t = HALF_DEPTH_M, HALF_WIDTH_M, HEIGHT_M, THICKNESS_M
    out, along, up = (
        np.arange(low, high, t / 1.5) for low, high in ((-a, a), (t / 3, b), (t / 3, h))
    )
    back = [(-a - t / 2, y, z) for y in along for z in up]
    side = [(x, b + t / 2, z) for x in out for z in up]
    lid = [(x, y, h + t / 2) for x in out for y in along]
    places = np.array([*shell, *back, *side, *lid])
    strengths = np.zeros((len(places), 2))
    strengths[:3] = np.array([1.0, -2.0, 1.5])[:, None]
    strengths[3:, 1] = 0.02 * np.cos(places[3:] @ [2.0, 5.0, 4.0] + 0.7)
    return places, strengths


def manufactured(mesh: Mesh, frequency_hz: float) -> tuple[ComplexArray, ComplexArray]:
    """Normal velocity of the monopoles' field (element, case), its pressure (microphone, case)."""
    omega = 2 * np.pi * frequency_hz
    k = omega / SPEED_OF_SOUND_M_PER_S
    velocity, pressure = (np.zeros((n, 2), dtype=complex) for n in (len(mesh.normal), len(PLACES)))
    for place, strength in zip(*monopoles(), strict=True):
        for image in IMAGES:
            offset = mesh.gauss[0] - place * image
            distance = np.linalg.norm(offset, axis=2)
            slope = (1 + 1j * k * distance) * np.exp(-1j * k * distance) / distance**3
            normal = np.einsum("eqi,ei->eq", offset, mesh.normal) * slope / (4 * np.pi)
            velocity += mesh.mean(normal)[:, None] * strength
            distance = np.linalg.norm(PLACES - place * image, axis=1)
            green = np.exp(-1j * k * distance) / (4 * np.pi * distance)
            pressure += 1j * omega * AIR_DENSITY_KG_PER_M3 * green[:, None] * strength
    return velocity, pressure


def solve(parts: int) -> tuple[ComplexArray, ComplexArray]:
    """Pressures (frequency, microphone, pattern), and the exact ones of the last two patterns."""
    mesh = cabinet_mesh(parts)
    print(f"{parts} parts: {len(mesh.normal)} elements, {mesh.moving.sum()} on the shell")
    radiation = Radiation(mesh, points_inside(), PLACES)
    solved, exact = [], []
    for frequency_hz in FREQUENCIES_HZ:
        begin = time.process_time()
        velocity, pressure = manufactured(mesh, frequency_hz)
        both = np.concatenate([rigid_motions(mesh), velocity], axis=1)
        solved.append(radiation.pressures(both, frequency_hz))
        exact.append(pressure)
        print(f"  {frequency_hz:g} Hz: {time.process_time() - begin:.1f} s", flush=True)
    return np.array(solved), np.array(exact)


def _mean(values: ComplexArray) -> Array:
    """Root mean square over the microphones, (frequency, pattern)."""
    mean: Array = np.sqrt(np.mean(np.abs(values) ** 2, axis=1))
    return mean


def main() -> None:
    """Print the proof and the meshes' difference, and write the results."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--out", type=Path, default=Path(__file__).with_name("results.csv"))
    path = parser.parse_args().out
    (coarse, exact), (fine, _) = (solve(parts) for parts in PARTS)
    pressure = fine + (fine - coarse) / ((PARTS[1] / PARTS[0]) ** 2 - 1.0)
    largest = np.abs(exact).max(axis=1)
    print("| Hz | shell: coarse, fine, both % | shell and panels % | tx, tz, ry: last step % |")
    worst = [np.abs(got[..., 3:] - exact).max(axis=1) / largest for got in (coarse, fine, pressure)]
    step = _mean((pressure - fine)[..., :3]) / _mean(pressure[..., :3])
    for hertz, errors, steps in zip(FREQUENCIES_HZ, np.stack(worst, axis=2), step, strict=True):
        cells = [", ".join(f"{100 * value:.2f}" for value in row) for row in (*errors, steps)]
        print(f"| {hertz} | " + " | ".join(cells) + " |")
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(COLUMNS)
        for p, f, m in np.ndindex(len(PATTERNS), len(FREQUENCIES_HZ), len(PLACES)):
            value, uncertain = pressure[f, m, p], abs(pressure[f, m, p] - fine[f, m, p])
            rows.writerow(
                [PATTERNS[p], FREQUENCIES_HZ[f], list(MICROPHONES)[m], *PLACES[m]]
                + [f"{number:.6e}" for number in (value.real, value.imag, uncertain)]
            )


if __name__ == "__main__":
    main()
