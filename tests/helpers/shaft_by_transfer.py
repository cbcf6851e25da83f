"""A second model of shaft and frame: 88 cells of a beam by transfer matrices, exact in each.

The state of the beam is deflection, slope, moment and shear force; its change along a cell is the
exponential of the cell's matrix. Rotary inertia is in it, shear is not.
"""

from itertools import pairwise

import numpy as np
from scipy.linalg import expm

from vibroacoustics.machine.frame import BEARING_HOUSING, LOWER_BEARING, ORBITING_SCROLL, PARTS
from vibroacoustics.mechanics.bushings import RigidBody, motion_at
from vibroacoustics.transfer.frame.inner import springs_of
from vibroacoustics.transfer.isolation import Isolation

CELLS = 88


def flexibility(shaft, omega, loss_factor):
    """Deflection of a free shaft at lower bearing, main bearing and pin per force there, m/N."""
    at = np.array([0.0, shaft.main_bearing_height_m, shaft.length_m])
    edges = np.linspace(0.0, shaft.length_m, CELLS + 1)
    states = [np.eye(4)]
    for low, high in pairwise(edges):
        states.append(expm(cell(shaft, low, high, omega, loss_factor) * (high - low)) @ states[-1])
    nodes = np.searchsorted(edges, at - 1e-9)
    assert abs(edges[nodes] - at).max() < 1e-9
    result = np.zeros((3, 3), dtype=complex)
    for column, node in enumerate(nodes):
        # A unit force at a node jumps the shear; moment and shear vanish at both ends.
        jump = states[-1] @ np.linalg.inv(states[node]) @ [0.0, 0.0, 0.0, 1.0]
        start = np.linalg.solve(states[-1][2:, :2], -jump[2:])
        for row, other in enumerate(nodes):
            state = states[other][:, :2] @ start
            if other > node:
                state = state + states[other] @ np.linalg.inv(states[node]) @ [0.0, 0.0, 0.0, 1.0]
            result[row, column] = state[0]
    return result


def cell(shaft, low, high, omega, loss_factor):
    """Change of the state per length; the ring's share of the cell is spread over it."""
    d, outer = shaft.diameter_m, shaft.rotor_diameter_m
    area, moment = np.pi * d**2 / 4.0, np.pi * d**4 / 64.0
    mass, rotary = shaft.density_kg_per_m3 * area, shaft.density_kg_per_m3 * moment
    ends = shaft.rotor_height_m + 0.5 * shaft.rotor_length_m * np.array([-1.0, 1.0])
    share = max(min(high, ends[1]) - max(low, ends[0]), 0.0) / (high - low)
    ring = share * shaft.rotor_mass_kg / shaft.rotor_length_m
    mass, rotary = mass + ring, rotary + ring * (d**2 + outer**2) / 16.0
    bending = shaft.youngs_modulus_pa * (1.0 + 1j * loss_factor) * moment
    matrix = np.zeros((4, 4), dtype=complex)
    matrix[0, 1], matrix[1, 2] = 1.0, 1.0 / bending
    matrix[2, 3], matrix[2, 1] = 1.0, -rotary * omega**2
    matrix[3, 0] = mass * omega**2
    return matrix


def forces_on_rigid_wall(frame, shaft, contacts, bearings, frequency_hz):
    """Forces of the contacts on a wall at rest per load on the parts, (contact, part, 6).

    Parameters
    ----------
    frame, shaft : tables
    contacts : with the wall
    bearings : dynamic stiffness of pin, main and lower bearing, N/m
    frequency_hz : one
    """
    omega = 2.0 * np.pi * frequency_hz
    middles = [np.array([0.0, 0.0, getattr(frame, part.name).height_m]) for part in PARTS]
    bodies = tuple(
        RigidBody(part.name, part_of.mass_kg, part_of.inertia_kg_m2, middle)
        for part, middle in zip(PARTS, middles, strict=True)
        for part_of in [getattr(frame, part.name)]
    )
    held = Isolation(bodies, springs_of(frame))
    dynamic = held.stiffness_matrix + 1j * held.structural_damping_matrix
    dynamic = dynamic - omega**2 * held.mass_matrix
    stretch = np.zeros((len(contacts.part), len(dynamic)))
    for row, (part, rigid) in enumerate(zip(contacts.part, contacts.rigid, strict=True)):
        to_middle = motion_at(middles[part], np.zeros(3))
        stretch[row, 6 * part : 6 * part + 6] = rigid @ np.linalg.inv(to_middle)
    dynamic += stretch.T @ (contacts.stiffness[:, None] * stretch)
    heights = frame.lower_bearing_height_m + np.array(
        [0.0, shaft.main_bearing_height_m, shaft.length_m]
    )
    at_bearings = np.zeros((2, 3, len(dynamic)))
    for row, (part, height) in enumerate(
        zip((LOWER_BEARING, BEARING_HOUSING, ORBITING_SCROLL), heights, strict=True)
    ):
        number = PARTS.index(part)
        moved = motion_at(np.array([0.0, 0.0, height]), middles[number])[:2]
        at_bearings[:, row, 6 * number : 6 * number + 6] = moved
    springs = np.diag(1.0 / np.array(bearings)[::-1])
    joined = np.linalg.inv(springs + flexibility(shaft, omega, frame.metal_loss_factor_ratio))
    for plane in at_bearings:
        dynamic += plane.T @ joined @ plane
    loads = np.zeros((len(dynamic), len(PARTS), 6))
    for number, middle in enumerate(middles):
        at = slice(6 * number, 6 * number + 6)
        loads[at, number] = np.linalg.inv(motion_at(middle, np.zeros(3))).T
    moved = np.linalg.solve(dynamic, loads.reshape(len(dynamic), -1))
    forces = contacts.stiffness[:, None] * (stretch @ moved)
    return forces.reshape(-1, len(PARTS), 6)
