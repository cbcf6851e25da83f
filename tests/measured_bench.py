"""A made-up test bench: a rigid machine on four mounts on a panel of forty modes.

Each state of it is solved in its 43 modal coordinates, so that the truth of a change of mounts, an
added mass or an absorber shares no algebra with what predicts it.
"""

from dataclasses import dataclass

import numpy as np

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
    sound = rng.normal(size=(2, 43)) + 1j * rng.normal(size=(2, 43))
    sound[:, :3] *= 0.02
    load = np.zeros((omega.size, 43, 1), complex)
    load[:, :3, 0] = np.exp(2j * np.pi * rng.random((omega.size, 3))) * [40.0, 3.0, 4.0]
    dynamic = np.einsum("fm,mn->fmn", elastic - omega[:, None] ** 2 * mass, np.eye(43))
    solved = np.linalg.inv(dynamic + shapes.T @ stiffness @ shapes)
    heard = -(omega[:, None, None] ** 2) * sound
    seen = np.concatenate([np.broadcast_to(shapes, (omega.size, *shapes.shape)), heard], axis=1)
    return State(seen @ solved @ shapes.T, (seen @ solved @ load)[..., 0])


def panel():
    """Forty modes of a simply supported plate at the four feet: shapes and angular frequencies."""
    a, b, stiff, _ = PANEL
    numbers = np.array([(m, n) for m in range(1, 15) for n in range(1, 15)])
    own = stiff * np.pi**2 * ((numbers[:, 0] / a) ** 2 + (numbers[:, 1] / b) ** 2)
    first = np.argsort(own)[:40]
    x, y = (CORNERS + np.array([0.41, 0.33])).T
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
