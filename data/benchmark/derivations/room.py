"""Sound in a box room whose six walls react locally: modes across, closed form along.

Across y and z the modes of the walls' admittances are roots of a transcendental equation, followed
from hard walls by Newton's method; along x the field of each pair of modes is in closed form.
"""

from cmath import cos, exp, sin, sqrt
from collections.abc import Iterator
from math import log10, pi
from pathlib import Path

from .rows import Row, inputs, table

MODES = 24
STEPS = 12
"""Modes of an axis, and steps from hard walls to those of the case."""
AXES = ("x", "y", "z")
SIDES = (("-x", "+x"), ("-y", "+y"), ("floor", "ceiling"))


def exact_room(folder: Path) -> Iterator[Row]:
    """Third octaves of the mean of |G|^2 over lines 5 Hz apart, dB re 1/m^2."""
    given, walls = inputs(folder), _walls(folder)
    size = [given[f"size_{axis}"] for axis in AXES]
    source = [given[f"source_{axis}"] for axis in AXES]
    points = {n: [given[f"microphone_{n}_{axis}"] for axis in AXES] for n in (1, 2, 3)}
    bands: dict[int, list[list[float]]] = {}
    for row in range(85):
        frequency = 80.0 + 5.0 * row
        band = round(10.0 * log10(frequency))
        if 20 <= band <= 26:
            ends = {side: _admittance(wall, frequency) for side, wall in walls.items()}
            k = 2.0 * pi * frequency / given["speed_of_sound"]
            green = _green(size, ends, k, source, list(points.values()))
            bands.setdefault(band, []).append([abs(value) ** 2 for value in green])
    for band, lines in bands.items():
        for number, squares in zip(points, zip(*lines, strict=True), strict=True):
            level = 10.0 * log10(sum(squares) / len(squares))
            key = f"microphone {number}, third octave {_nominal(band)} Hz"
            words = "modes by Newton's method; 0.3 dB for a wave solver with 4 points a wave"
            yield Row(key, "dB re 1/m2", level, 0.3, words)


def _nominal(band: int) -> int:
    return {20: 100, 21: 125, 22: 160, 23: 200, 24: 250, 25: 315, 26: 400}[band]


Branch = tuple[float, float, float]


def _walls(folder: Path) -> dict[str, list[Branch]]:
    walls: dict[str, list[Branch]] = {}
    for row in table(folder):
        branch = (float(row["octave_hz"]), float(row["weight"]), float(row["quality"]))
        walls.setdefault(row["side"], []).append(branch)
    return walls


def _admittance(wall: list[Branch], frequency: float) -> complex:
    """Sum of w/(1 + jQ(f/f0 - f0/f)): rho c u/p of a wall."""
    return sum(w / (1.0 + 1j * q * (frequency / f0 - f0 / frequency)) for f0, w, q in wall)


Ends = dict[str, complex]


def _green(
    size: list[float], ends: Ends, k: float, source: list[float], points: list[list[float]]
) -> list[complex]:
    """Green's function from the source to each point, exp(-jkr)/(4 pi r) at its source, 1/m."""
    across = {}
    for axis in (1, 2):
        below, above = (ends[side] for side in SIDES[axis])
        across[axis] = [_mode(size[axis], k, below, above, number) for number in range(MODES)]
    total = [0j] * len(points)
    for y, (square_y, shape_y) in enumerate(across[1]):
        for square_z, shape_z in across[2][: MODES - y // 2]:
            gamma = sqrt(square_y + square_z - k**2)
            strength = shape_y(source[1]) * shape_z(source[2])
            for row, point in enumerate(points):
                along = _between(size[0], k, gamma, ends["-x"], ends["+x"], source[0], point[0])
                total[row] += strength * shape_y(point[1]) * shape_z(point[2]) * along
    return total


def _mode(length: float, k: float, below: complex, above: complex, number: int):
    """Square of a mode's wavenumber, and its shape with the integral of the square 1.

    v = cos(qx) + (jk Y0/q) sin(qx); v' + jk YL v = 0 at the end.
    """
    square = complex((number * pi / length) ** 2)
    for step in range(1, STEPS + 1):
        low, high = (1j * k * end * step / STEPS for end in (below, above))
        if number == 0 and step == 1:
            square = (low + high) / length
        square = _root(length, low, high, square)
    q = sqrt(square)
    first = 1j * k * below / q

    def shape(x: float) -> complex:
        return cos(q * x) + first * sin(q * x)

    double = 2.0 * q * length
    norm = sqrt(
        length / 2.0 * (1.0 + first**2)
        + sin(double) / (4.0 * q) * (1.0 - first**2)
        + first * (1.0 - cos(double)) / (2.0 * q)
    )
    return square, lambda x: shape(x) / norm


def _root(length: float, low: complex, high: complex, square: complex) -> complex:
    """Newton's method on the square of the wavenumber."""

    def miss(value: complex) -> complex:
        q = sqrt(value)
        sine = sin(q * length)
        return (low + high) * cos(q * length) + (low * high / q - q) * sine

    for _ in range(30):
        step = 1e-6 * (1.0 + abs(square))
        slope = (miss(square + step) - miss(square - step)) / (2.0 * step)
        change = miss(square) / slope
        square -= change
        if abs(change) < 1e-12 * (1.0 + abs(square)):
            return square
    return square


def _between(
    length: float,
    k: float,
    gamma: complex,
    below: complex,
    above: complex,
    start: float,
    end: float,
) -> complex:
    """Green's function along an axis of d2/dx2 - gamma^2, damped by the walls at its ends."""
    low, high = min(start, end), max(start, end)
    first = (gamma - 1j * k * below) / (gamma + 1j * k * below)
    last = (gamma - 1j * k * above) / (gamma + 1j * k * above)
    ways = (1.0 + first * exp(-2.0 * gamma * low)) * (
        1.0 + last * exp(-2.0 * gamma * (length - high))
    )
    return (
        exp(-gamma * (high - low))
        * ways
        / (2.0 * gamma * (1.0 - first * last * exp(-2.0 * gamma * length)))
    )
