"""A made-up test bench: a rigid machine on four mounts on a panel, before and after a change.

The state before gives the inputs, the state after the expected values. Both are solved in modal
coordinates, so that the truth shares no algebra with methods that use the measured functions.
"""

import csv
from cmath import exp, pi
from collections.abc import Iterator
from math import sin
from pathlib import Path

from .rows import Row, inputs

FREQUENCIES = (30.0, 60.0, 120.0, 240.0, 480.0)
FEET = ((-0.12, -0.1), (0.12, -0.1), (0.12, 0.1), (-0.12, 0.1))
BODY = (30.0, 0.4, 0.5)
"""Mass, kg, and moments of inertia, kg m2."""
PANEL_MODES = tuple((m, n) for m in (1, 2, 3, 4) for n in (1, 2, 3))
PANEL = (0.9, 0.7, 9.3, 3.0)
"""Sides, m, root of bending stiffness over mass per area, m2/s, and a quarter of the mass, kg."""
MICROPHONES = ("front", "left")
POINTS = tuple(f"{body} {n}" for body in ("machine", "panel") for n in (1, 2, 3, 4))

Matrix = list[list[complex]]


def changed_mounts(folder: Path) -> Iterator[Row]:
    """Pressure at the microphones with the new mounts; inputs.csv is written from the old ones."""
    given = inputs(folder)
    old = 1e3 * given["old_stiffness"] * (1.0 + 1j * given["old_loss_factor"])
    new = 1e3 * given["new_stiffness"] * (1.0 + 1j * given["new_loss_factor"])
    with (folder / "inputs.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["frequency_hz", "response", "reference", "unit", "real", "imaginary"])
        for frequency in FREQUENCIES:
            for cells in _measured(frequency, old):
                writer.writerow(cells)
    for frequency in FREQUENCIES:
        pressures = _running(frequency, new)[len(POINTS) :]
        for name, value in zip(MICROPHONES, pressures, strict=True):
            for part, number in (("real", value.real), ("imaginary", value.imag)):
                words = "solved in modal coordinates; 0.1 % of the magnitude for nine digits"
                key = f"{name}, {frequency:g} Hz: {part}"
                yield Row(key, "Pa", number, 1e-3 * abs(value), words)


def _measured(frequency: float, stiffness: complex) -> Iterator[list[object]]:
    """Rows of inputs.csv: response to a unit force at a point, and while the machine runs."""
    shapes = _shapes(frequency)
    modes = len(shapes[0])
    for column, reference in enumerate(POINTS):
        load = [shapes[column][mode] for mode in range(modes)]
        for name, value in zip(
            POINTS + MICROPHONES, _response(frequency, stiffness, load), strict=True
        ):
            unit = "m/N" if name in POINTS else "Pa/N"
            yield [
                f"{frequency:g}",
                name,
                reference,
                unit,
                f"{value.real:.9e}",
                f"{value.imag:.9e}",
            ]
    for name, value in zip(POINTS + MICROPHONES, _running(frequency, stiffness), strict=True):
        unit = "m" if name in POINTS else "Pa"
        yield [f"{frequency:g}", name, "", unit, f"{value.real:.9e}", f"{value.imag:.9e}"]


def _running(frequency: float, stiffness: complex) -> list[complex]:
    """Responses to the forces of the running machine, which do not change."""
    load = [0j] * (3 + len(PANEL_MODES))
    for part, size in enumerate((40.0, 3.0, 4.0)):
        load[part] = size * exp(1j * (0.7 * part + 0.011 * frequency))
    return _response(frequency, stiffness, load)


def _response(frequency: float, stiffness: complex, load: list[complex]) -> list[complex]:
    """Displacements of the points and pressures at the microphones."""
    omega, shapes = 2.0 * pi * frequency, _shapes(frequency)
    size = len(load)
    dynamic: Matrix = [[0j] * size for _ in range(size)]
    for mode in range(size):
        mass = BODY[mode] if mode < 3 else PANEL[3]
        elastic = 0.0 if mode < 3 else mass * _own(mode - 3) ** 2 * (1.0 + 0.03j)
        dynamic[mode][mode] = elastic - omega**2 * mass
    for mount in range(4):
        stretch = [a - b for a, b in zip(shapes[mount], shapes[mount + 4], strict=True)]
        for row in range(size):
            for column in range(size):
                dynamic[row][column] += stiffness * stretch[row] * stretch[column]
    motion = solved(dynamic, load)
    return [sum(s * q for s, q in zip(shape, motion, strict=True)) for shape in shapes]


def _shapes(frequency: float) -> Matrix:
    """Displacement of each point and pressure at each microphone per modal coordinate."""
    a, b, _, _ = PANEL
    rows: Matrix = []
    for x, y in FEET:
        rows.append([1.0, y, -x] + [0.0] * len(PANEL_MODES))
    for x, y in FEET:
        place = [
            2.0 * sin(m * pi * (x + 0.41) / a) * sin(n * pi * (y + 0.33) / b)
            for m, n in PANEL_MODES
        ]
        rows.append([0.0] * 3 + place)
    for microphone in range(2):
        sound = [
            -((2.0 * pi * frequency) ** 2) * 0.01 * (0.02 if mode < 3 else 1.0)
            * exp(1j * (1.3 * mode + 0.9 * microphone)) / (1.0 + 0.2 * mode)
            for mode in range(3 + len(PANEL_MODES))
        ]  # fmt: skip
        rows.append(sound)
    return rows


def _own(mode: int) -> float:
    """Natural angular frequency of a mode of the panel, rad/s."""
    m, n = PANEL_MODES[mode]
    return PANEL[2] * pi**2 * ((m / PANEL[0]) ** 2 + (n / PANEL[1]) ** 2)


def solved(matrix: Matrix, right: list[complex]) -> list[complex]:
    """Solve linear equations by elimination with pivots."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for column in range(len(rows)):
        pivot = max(range(column, len(rows)), key=lambda row: abs(rows[row][column]))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        for row in range(column + 1, len(rows)):
            share = rows[row][column] / rows[column][column]
            for other in range(column, len(rows) + 1):
                rows[row][other] -= share * rows[column][other]
    result = [0j] * len(rows)
    for row in reversed(range(len(rows))):
        known = sum(rows[row][other] * result[other] for other in range(row + 1, len(rows)))
        result[row] = (rows[row][-1] - known) / rows[row][row]
    return result
