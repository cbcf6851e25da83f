"""A made-up test bench: a rigid machine on four mounts on a panel of forty modes.

Each state of it is solved in its 43 modal coordinates, so that the truth of a change of mounts, an
added mass or an absorber shares no algebra with what predicts it.
"""

from dataclasses import dataclass

import numpy as np

import vibroacoustics as va

POINTS, MICROPHONES = 8, 2
STIFFNESS = 2.0e5 * (1.0 + 0.1j)
CORNERS = np.array([(-0.12, -0.1), (0.12, -0.1), (0.12, 0.1), (-0.12, 0.1)])
BODY = (30.0, 0.4, 0.5)
"""Mass, kg, and moments of inertia, kg m²."""
PANEL = (0.9, 0.7, 9.3, 3.0)
"""Sides, m, √(bending stiffness / mass per area), m²/s, and a quarter of the mass, kg."""


@dataclass(frozen=True)
class State:
    """Responses of points and microphones.

    Attributes
    ----------
    frf : per unit force at the points, shape (frequency, 10, 8)
    running : while the machine runs, shape (frequency, 10)
    """

    frf: np.ndarray
    running: np.ndarray


def state(frequency, stiffness):
    """Responses with elements of this dynamic stiffness between the points.

    Points are four feet of the machine, then four of the panel, all vertical; microphones follow.

    Parameters
    ----------
    frequency : Hz
    stiffness : N/m, shape (frequency, 8, 8); see `between`
    """
    rng = np.random.default_rng(7)
    omega = 2.0 * np.pi * frequency
    plate, own = panel()
    shapes = np.zeros((POINTS, 3 + own.size))
    shapes[:4, :3] = np.column_stack([np.ones(4), CORNERS[:, 1], -CORNERS[:, 0]])
    shapes[4:, 3:] = plate
    mass = np.array([*BODY, *[PANEL[3]] * own.size])
    elastic = np.array([0.0, 0.0, 0.0, *own**2 * (1.0 + 0.03j)]) * mass
    sound = 0.01 * (rng.normal(size=(2, 43)) + 1j * rng.normal(size=(2, 43)))
    sound[:, :3] *= 0.02
    load = np.zeros((omega.size, 43, 1), complex)
    load[:, :3, 0] = np.exp(2j * np.pi * rng.random((omega.size, 3))) * [40.0, 3.0, 4.0]
    dynamic = np.einsum("fm,mn->fmn", elastic - omega[:, None] ** 2 * mass, np.eye(43))
    solved = np.linalg.inv(dynamic + shapes.T @ stiffness @ shapes)
    heard = -(omega[:, None, None] ** 2) * sound
    seen = np.concatenate([np.broadcast_to(shapes, (omega.size, *shapes.shape)), heard], axis=1)
    return State(seen @ solved @ shapes.T, (seen @ solved @ load)[..., 0])


def panel(at=CORNERS):
    """Forty modes of a simply supported plate at some points: shapes and angular frequencies."""
    a, b, stiff, _ = PANEL
    numbers = np.array([(m, n) for m in range(1, 15) for n in range(1, 15)])
    own = stiff * np.pi**2 * ((numbers[:, 0] / a) ** 2 + (numbers[:, 1] / b) ** 2)
    first = np.argsort(own)[:40]
    x, y = (at + np.array([0.41, 0.33])).T
    m, n = numbers[first].T
    return 2.0 * np.sin(np.pi * np.outer(x, m) / a) * np.sin(np.pi * np.outer(y, n) / b), own[first]


def mounts():
    """Elongations of the four mounts, shape (4, 8)."""
    return np.hstack([np.eye(4), -np.eye(4)])


def between(elongation, values, frequency):
    """Stiffness between the points, shape (frequency, 8, 8), of elements.

    Parameters
    ----------
    elongation : shape (element, 8)
    values : N/m, shape (element,) or (frequency, element)
    frequency : Hz
    """
    values = np.broadcast_to(values, (len(frequency), len(elongation)))
    return np.einsum("ep,fe,eq->fpq", elongation, values, elongation)


def noisy(values, share, rng):
    """Complex values with a relative error of this RMS."""
    error = rng.normal(size=values.shape) + 1j * rng.normal(size=values.shape)
    return values * (1.0 + share * error / np.sqrt(2.0))


FREQUENCY = np.arange(20.0, 821.0, 8.0)
AS_MEASURED = between(mounts(), [STIFFNESS] * 4, FREQUENCY)
NODES = [va.Node(number, "+z") for number in (1, 2, 3, 4, 11, 12, 13, 14)]
RECEIVERS = [va.Node(101), va.Node(102)]
HEAD = """
title = "Bench"

[measured]
frequency_responses = {responses}
operating = {operating}
{quality}

[measured.points]
machine_1 = {{ node = 1, direction = "+z" }}
machine_2 = {{ node = 2, direction = "+z" }}
machine_3 = {{ node = 3, direction = "+z" }}
machine_4 = {{ node = 4, direction = "+z" }}
panel_1 = {{ node = 11, direction = "+z" }}
panel_2 = {{ node = 12, direction = "+z" }}
panel_3 = {{ node = 13, direction = "+z" }}
panel_4 = {{ node = 14, direction = "+z" }}

[measured.microphones]
front = {{ node = 101 }}
left = {{ node = 102 }}

[mounts.one]
ends = ["machine_1", "panel_1"]
stiffness_n_per_mm = 200.0
loss_factor_percent = 10.0

[mounts.two]
ends = ["machine_2", "panel_2"]
stiffness_n_per_mm = 200.0
loss_factor_percent = 10.0

[mounts.three]
ends = ["machine_3", "panel_3"]
stiffness_n_per_mm = 200.0
loss_factor_percent = 10.0

[mounts.four]
ends = ["machine_4", "panel_4"]
stiffness_n_per_mm = 200.0
loss_factor_percent = 10.0
"""


def responses(measured, unit="m/s²"):
    """Frequency responses of a state as functions: points in a unit, microphones in Pa."""
    made = []
    for row, response in enumerate([*NODES, *RECEIVERS]):
        for column, reference in enumerate(NODES):
            made.append(
                va.MeasuredFunction(
                    "frequency response", FREQUENCY, measured.frf[:, row, column], response,
                    reference, "m" if row < POINTS else "Pa", "N",
                )
            )  # fmt: skip
    return [function.with_response_in(unit) if function.response.direction else function
            for function in made]  # fmt: skip


def spectra(measured, unit="m/s²"):
    """Operating spectra, peak."""
    made = [
        va.MeasuredFunction(
            "spectrum",
            FREQUENCY,
            measured.running[:, row],
            node,
            None,
            "m" if row < POINTS else "Pa",
        )
        for row, node in enumerate([*NODES, *RECEIVERS])
    ]
    return [function.with_response_in(unit) if function.response.direction else function
            for function in made]  # fmt: skip


def write(folder, changes, measured, quality="relative_error_percent = 3.0\ndraws = 50", **files):
    """Files of a state and the file for `predict`; returns the latter."""
    va.export_functions(responses(measured), folder / "hammer.uff")
    va.export_functions(spectra(measured), folder / "running.csv")
    names = {"responses": '["hammer.uff"]', "operating": '["running.csv"]'} | files
    (folder / "bench.toml").write_text(HEAD.format(**names, quality=quality) + changes)
    return folder / "bench.toml"
