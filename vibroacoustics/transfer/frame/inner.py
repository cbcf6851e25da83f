"""The parts in the shell with what holds them together: mass, stiffness, loads, contacts."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.linalg import block_diag

from ...base.arrays import Array, ComplexArray
from ...base.units import shaft_frequency_hz
from ...machine.frame import (
    BEARING_HOUSING,
    LOWER_BEARING,
    ORBITING_SCROLL,
    PARTS,
    Face,
    Frame,
    Part,
    PlainBearing,
    RoundPart,
)
from ...mechanics.beam_rotor import NODE_DOFS
from ...mechanics.bushings import Bushing, RigidBody, motion_at
from ...mechanics.critical_speed import FreeShaft
from ...mechanics.journal_film import JournalFilm, short_bearing
from ...mechanics.ports import WRENCH
from ..isolation import Isolation
from .contacts import Contacts
from .symmetric import Elastic

FACE_SPRINGS: Final = 8
"""Points that stand for an annular face; its tilting stiffness is exact from three on."""


def springs_of(frame: Frame) -> tuple[Bushing, ...]:
    """Bolts, thrust face, tips where they close, and the keys."""
    springs = [*_bolts(frame), *_face(frame, "thrust", frame.thrust_face, "bearing_housing")]
    if frame.axially_compliant:
        springs += _face(frame, "tip", frame.tips, "fixed_scroll")
    return (*springs, _keys(frame))


def _bolts(frame: Frame) -> list[Bushing]:
    bolts = frame.bolts
    lateral, axial = bolts.lateral_stiffness_n_per_m, bolts.axial_stiffness_n_per_m
    if frame.axially_compliant:
        axial = bolts.guide_stiffness_n_per_m
    stiffness = np.diag([lateral, lateral, axial, 0.0, 0.0, 0.0])
    points = _ring(bolts.number, bolts.radius_m, bolts.height_m, bolts.first_angle_rad)
    loss = frame.joint_loss_factor_ratio
    return [
        Bushing(
            f"bolt_{n}", "fixed_scroll", "bearing_housing", point, stiffness, loss_factor_ratio=loss
        )
        for n, point in enumerate(points, 1)
    ]


def _face(frame: Frame, name: str, face: Face, other: str) -> list[Bushing]:
    """Springs along z between the orbiting scroll and another body."""
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = face.stiffness_n_per_m / FACE_SPRINGS
    points = _ring(FACE_SPRINGS, face.radius_m, face.height_m, 0.0)
    loss = frame.joint_loss_factor_ratio
    return [
        Bushing(f"{name}_{n}", "orbiting_scroll", other, point, stiffness, loss_factor_ratio=loss)
        for n, point in enumerate(points, 1)
    ]


def _keys(frame: Frame) -> Bushing:
    """Keys that keep the orbiting scroll from turning: four in two parts of slots in series."""
    stiffness = np.zeros((6, 6))
    stiffness[5, 5] = frame.keys_stiffness_n_per_m * frame.keys_radius_m**2
    point = np.array([0.0, 0.0, frame.orbiting_scroll.height_m])
    standing = frame.keys_on.replace("-", "_")
    loss = frame.joint_loss_factor_ratio
    return Bushing("keys", "orbiting_scroll", standing, point, stiffness, loss_factor_ratio=loss)


def _ring(number: int, radius_m: float, height_m: float, first_angle: float) -> Array:
    """Points spread evenly around the axis, shape (number, 3)."""
    angle = first_angle + 2.0 * np.pi * np.arange(number) / number
    height = np.full(number, height_m)
    return np.stack([radius_m * np.cos(angle), radius_m * np.sin(angle), height], axis=1)


@dataclass(frozen=True)
class Bearing:
    """A bearing of the shaft.

    Attributes
    ----------
    part : that carries the shaft here or that the shaft carries
    node : node of the shaft
    film : film of oil
    metal_stiffness : in series, with loss, N/m
    """

    part: Part
    node: int
    film: JournalFilm
    metal_stiffness: complex

    def flexibility(self, omega: Array) -> ComplexArray:
        """Flexibility along x and along y, shape (frequency,), m/N.

        Parameters
        ----------
        omega : shape (frequency,), rad/s
        """
        return self.film.flexibility(self.metal_stiffness, omega)


def bearings_of(frame: Frame, shaft: FreeShaft) -> tuple[Bearing, ...]:
    """Pin, main and lower bearing; the pin's load on two journals by the lever."""
    speed = 2.0 * np.pi * shaft_frequency_hz(frame.film_speed_rpm)
    pin_height, main_height = shaft.heights_m[[shaft.pin_node, shaft.main_node]]
    lever = float(pin_height / main_height)
    lossy = 1.0 + 1j * frame.metal_loss_factor_ratio

    def bearing(
        part: Part, node: int, size: PlainBearing, share: float, stiffness_n_per_m: float
    ) -> Bearing:
        film = short_bearing(
            size.diameter_m, size.length_m, size.radial_clearance_m,
            frame.oil_viscosity_pa_s, speed, share * frame.pin_load_n,
        )  # fmt: skip
        return Bearing(part, node, film, stiffness_n_per_m * lossy)

    journals = shaft.bearing_stiffness_n_per_m
    return (
        bearing(ORBITING_SCROLL, shaft.pin_node, frame.pin_film, 1.0, frame.pin_stiffness_n_per_m),
        bearing(BEARING_HOUSING, shaft.main_node, frame.main_film, lever, journals),
        bearing(LOWER_BEARING, 0, frame.lower_film, lever - 1.0, journals),
    )


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
