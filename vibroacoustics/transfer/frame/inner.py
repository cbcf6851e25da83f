"""The parts in the shell with what holds them together: mass, stiffness, loads, contacts."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from ...base.arrays import Array, ComplexArray
from ...machine.frame import (
    BEARING_HOUSING,
    LOWER_BEARING,
    ORBITING_SCROLL,
    PARTS,
    Frame,
    RoundPart,
)
from ...mechanics.beam_rotor import NODE_FREEDOMS
from ...mechanics.bushings import RigidBody, motion_at
from ...mechanics.critical_speed import FreeShaft
from ...mechanics.ports import WRENCH
from ..isolation import Isolation
from .contacts import Contacts
from .springs import springs_of

BODY_FREEDOMS = len(WRENCH) * len(PARTS)


@dataclass(frozen=True)
class InnerSet:
    """Five bodies, six freedoms each about their middles, then the shaft's nodes, x, y, θx, θy.

    Attributes
    ----------
    mass : shape (freedom, freedom)
    stiffness : with loss, shape (freedom, freedom)
    contacts : motion at the contacts with the shell per freedom, shape (contact, freedom)
    loads : on the freedoms per load on each part, shape (freedom, part times component)
    rigid : freedoms per motion of all about the centre of mass, shape (freedom, 6)
    """

    mass: Array
    stiffness: ComplexArray
    contacts: Array
    loads: Array
    rigid: Array

    @property
    def rigid_mass(self) -> Array:
        """Mass and inertia of all about the centre of mass of the machine, shape (6, 6).

        The shaft neither slides along z nor turns about it here; so much stays with the shell.
        """
        return np.asarray(self.rigid.T @ self.mass @ self.rigid)


def inner_set(frame: Frame, shaft: FreeShaft, contacts: Contacts) -> InnerSet:
    """Assemble the bodies of a frame and the shaft.

    Parameters
    ----------
    frame : bodies and springs
    shaft : free, with its bearings' stiffness
    contacts : with the shell
    """
    bodies = [_body(part.name, getattr(frame, part.name)) for part in PARTS]
    middles = [body.centre_of_mass_m for body in bodies]
    held = Isolation(tuple(bodies), springs_of(frame))
    stiffness = block_diag(
        held.stiffness_matrix + 1j * held.structural_damping_matrix, shaft.rotor.stiffness
    )
    stiffness += _bearings(frame, shaft, middles)
    to_middle = np.stack([motion_at(middle, np.zeros(3)) for middle in middles])
    nodes = shaft.rotor.mass.shape[0]
    loads = np.zeros((BODY_FREEDOMS + nodes, BODY_FREEDOMS))
    # A wrench about the origin works on the motion there, which a body's own motion makes.
    loads[:BODY_FREEDOMS] = block_diag(*np.linalg.inv(to_middle).transpose(0, 2, 1))
    at_contacts = np.zeros((len(contacts.part), BODY_FREEDOMS + nodes))
    for row, (part, rigid) in enumerate(zip(contacts.part, contacts.rigid, strict=True)):
        first = len(WRENCH) * part
        at_contacts[row, first : first + 6] = rigid @ np.linalg.inv(to_middle[part])
    rigid = np.concatenate([to_middle.reshape(-1, 6), _shaft_rigid(frame, shaft)])
    mass = block_diag(held.mass_matrix, shaft.rotor.mass)
    return InnerSet(mass, stiffness, at_contacts, loads, rigid)


def _body(name: str, part: RoundPart) -> RigidBody:
    middle = np.array([0.0, 0.0, part.height_m])
    return RigidBody(name, part.mass_kg, part.inertia_kg_m2, middle)


def _bearings(frame: Frame, shaft: FreeShaft, middles: list[Array]) -> ComplexArray:
    """Springs along x and y between the shaft and what carries it."""
    size = BODY_FREEDOMS + shaft.rotor.mass.shape[0]
    total = np.zeros((size, size), dtype=complex)
    for part, node, stiffness in (
        (ORBITING_SCROLL, shaft.pin_node, frame.pin_stiffness_n_per_m),
        (BEARING_HOUSING, shaft.main_node, shaft.bearing_stiffness_n_per_m),
        (LOWER_BEARING, 0, shaft.bearing_stiffness_n_per_m),
    ):
        height = frame.lower_bearing_height_m + shaft.heights_m[node]
        between = np.zeros((2, size))
        number, last = PARTS.index(part), BODY_FREEDOMS + NODE_FREEDOMS * node
        first = len(WRENCH) * number
        point = np.array([0.0, 0.0, height])
        between[:, first : first + 6] = motion_at(point, middles[number])[:2]
        between[:, last : last + 2] = -np.eye(2)
        lossy = stiffness * (1.0 + 1j * frame.bearing_loss_factor_ratio)
        total += lossy * between.T @ between
    return total


def _shaft_rigid(frame: Frame, shaft: FreeShaft) -> Array:
    """Freedoms of the nodes per motion about the origin, shape (freedom, 6)."""
    rows = np.zeros((len(shaft.heights_m), NODE_FREEDOMS, 6))
    rows[:, [0, 1, 2, 3], [0, 1, 3, 4]] = 1.0
    rows[:, 0, 4] = frame.lower_bearing_height_m + shaft.heights_m
    rows[:, 1, 3] = -rows[:, 0, 4]
    return rows.reshape(-1, 6)
