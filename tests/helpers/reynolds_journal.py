"""A plain bearing by finite differences: Reynolds' equation, pressures below zero cut off."""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import spsolve

AROUND, ALONG = 240, 24


def force(bearing, position, velocity):
    """Force of the film on the journal, N; cells of half the length, the middle is a mirror.

    Parameters
    ----------
    bearing : diameter m, length m, clearance m, viscosity Pa s, speed rad/s
    position, velocity : of the journal in a sleeve at rest, m and m/s, along two axes
    """
    diameter, length, clearance, viscosity, speed = bearing
    arc, slice_m = 0.5 * diameter * 2.0 * np.pi / AROUND, 0.5 * length / ALONG
    angle = (np.arange(AROUND) + 0.5) * 2.0 * np.pi / AROUND
    cosine, sine = np.cos(angle), np.sin(angle)

    def height(at):
        return clearance - position[0] * np.cos(at) - position[1] * np.sin(at)

    edges = height(angle + np.pi / AROUND) ** 3
    shift = sparse.csr_matrix(np.roll(np.eye(AROUND), 1, axis=1))
    around = sparse.diags(edges) @ (shift - sparse.eye(AROUND))
    around = (around - sparse.csr_matrix(shift.T) @ around) / arc**2
    along = sparse.diags([1.0, -2.0, 1.0], [-1, 0, 1], (ALONG, ALONG)).tolil()
    along[0, 0], along[-1, -1] = -1.0, -3.0
    equations = sparse.kron(sparse.eye(ALONG), around)
    equations += sparse.kron(along.tocsr() / slice_m**2, sparse.diags(height(angle) ** 3))
    wedge = 6.0 * viscosity * speed * (position[0] * sine - position[1] * cosine)
    squeeze = -12.0 * viscosity * (velocity[0] * cosine + velocity[1] * sine)
    pressure = spsolve(equations.tocsc(), np.tile(wedge + squeeze, ALONG))
    per_arc = 2.0 * slice_m * arc * np.maximum(pressure, 0.0).reshape(ALONG, AROUND).sum(axis=0)
    return -np.array([per_arc @ cosine, per_arc @ sine])


def coefficients(bearing, eccentricity_ratio):
    """Load N, stiffness and damping, both (2, 2), by central differences about a position."""
    clearance, speed = bearing[2], bearing[4]
    at, still, step = np.array([eccentricity_ratio * clearance, 0.0]), np.zeros(2), 1e-3 * clearance
    units = step * np.eye(2)
    stiffness = [force(bearing, at - u, still) - force(bearing, at + u, still) for u in units]
    damping = [force(bearing, at, -speed * u) - force(bearing, at, speed * u) for u in units]
    load = np.linalg.norm(force(bearing, at, still))
    return load, np.transpose(stiffness) / (2 * step), np.transpose(damping) / (2 * step * speed)
