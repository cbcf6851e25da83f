"""The parts in the shell with what holds them together: mass, stiffness, loads, contacts."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from ...base.arrays import Array, ComplexArray
from ...machine.frame import PARTS, Frame, RoundPart
from ...mechanics.beam_rotor import NODE_DOFS
from ...mechanics.bushings import RigidBody, motion_at
from ...mechanics.critical_speed import FreeShaft
from ...mechanics.ports import WRENCH
from ..isolation import Isolation
from .bearings import Bearing, bearings_of
from .contacts import Contacts
from .natural import Elastic
from .springs import springs_of

BODY_DOFS = len(WRENCH) * len(PARTS)


@dataclass(frozen=True)
class InnerSet:
    """Five bodies, six degrees of freedom each about their middles, then the shaft's nodes, x, y,
    θx, θy.

    Attributes
    ----------
    bodies : with bolts, faces and keys
    shaft : free
    bearings : between shaft and bodies
    gaps : motion at the contacts with the shell, then of the bodies at the bearings less that of
        the shaft, along x and y, per freedom, shape (contact and bearing's direction, freedom)
    loads : loads on the degrees of freedom per load on each part, shape (dof, part times component)
    rigid : displacement per motion of all about the centre of mass, shape (dof, 6)
    """

    bodies: Elastic
    shaft: Elastic
    bearings: tuple[Bearing, ...]
    gaps: Array
    loads: Array
    rigid: Array

    @property
    def mass(self) -> Array:
        """Mass of bodies and shaft, shape (freedom, freedom)."""
        return np.asarray(block_diag(self.bodies.mass, self.shaft.mass))

    def flexibility(self, omega: Array) -> ComplexArray:
        """Flexibility of the bearings' directions, shape (bearing's direction, frequency), m/N.

        Parameters
        ----------
        omega : shape (frequency,), rad/s
        """
        return np.repeat([bearing.flexibility(omega) for bearing in self.bearings], 2, axis=0)

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
    frame : bodies, springs, bearings
    shaft : free
    contacts : with the shell
    """
    bodies = [_body(part.name, getattr(frame, part.name)) for part in PARTS]
    middles = [body.centre_of_mass_m for body in bodies]
    held = Isolation(tuple(bodies), springs_of(frame))
    to_middle = np.stack([motion_at(middle, np.zeros(3)) for middle in middles])
    nodes = shaft.rotor.mass.shape[0]
    loads = np.zeros((BODY_DOFS + nodes, BODY_DOFS))
    # A wrench about the origin works on the motion there, which a body's own motion makes.
    loads[:BODY_DOFS] = block_diag(*np.linalg.inv(to_middle).transpose(0, 2, 1))
    at_contacts = np.zeros((len(contacts.part), BODY_DOFS + nodes))
    for row, (part, rigid) in enumerate(zip(contacts.part, contacts.rigid, strict=True)):
        first = len(WRENCH) * part
        at_contacts[row, first : first + 6] = rigid @ np.linalg.inv(to_middle[part])
    bearings = bearings_of(frame, shaft)
    heights = frame.lower_bearing_height_m + shaft.heights_m
    at_bearings = [_at_bearing(bearing, heights, middles) for bearing in bearings]
    return InnerSet(
        Elastic(held.mass_matrix, held.stiffness_matrix, frame.joint_loss_factor_ratio),
        Elastic(shaft.rotor.mass, shaft.rotor.stiffness, frame.metal_loss_factor_ratio),
        bearings,
        np.concatenate([at_contacts, *at_bearings]),
        loads,
        np.concatenate([to_middle.reshape(-1, 6), _shaft_rigid(heights)]),
    )


def _body(name: str, part: RoundPart) -> RigidBody:
    middle = np.array([0.0, 0.0, part.height_m])
    return RigidBody(name, part.mass_kg, part.inertia_kg_m2, middle)


def _at_bearing(bearing: Bearing, heights: Array, middles: list[Array]) -> Array:
    """Motion of the part less that of the shaft along x and y per freedom, shape (2, freedom)."""
    between = np.zeros((2, BODY_DOFS + NODE_DOFS * heights.size))
    number, node = PARTS.index(bearing.part), BODY_DOFS + NODE_DOFS * bearing.node
    first = len(WRENCH) * number
    point = np.array([0.0, 0.0, heights[bearing.node]])
    between[:, first : first + 6] = motion_at(point, middles[number])[:2]
    between[:, node : node + 2] = -np.eye(2)
    return between


def _shaft_rigid(heights: Array) -> Array:
    """Freedoms of the nodes per motion about the origin, shape (freedom, 6)."""
    rows = np.zeros((heights.size, NODE_DOFS, 6))
    rows[:, [0, 1, 2, 3], [0, 1, 3, 4]] = 1.0
    rows[:, 0, 4], rows[:, 1, 3] = heights, -heights
    return rows.reshape(-1, 6)
