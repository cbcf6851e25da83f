"""Contacts of the parts in the shell with its wall: where they are, how stiff they are."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...machine.frame import BEARING_HOUSING, FIXED_SCROLL, LOWER_BEARING, PARTS, STATOR, Frame
from ...machine.shell_structure import Joint, ShellStructure
from ...mechanics.ports import Port
from ..shell_modes.loads import weld_angles


@dataclass(frozen=True)
class Contacts:
    """Contacts of all parts, one joint after another: outwards, up and around at each weld.

    Attributes
    ----------
    joints : their places on the wall
    parts : that the joints hold
    radius_m : radius of the wall
    stiffness : with loss, shape (contact,), N/m
    """

    joints: tuple[Joint, ...]
    parts: tuple[Port, ...]
    radius_m: float
    stiffness: ComplexArray

    @property
    def rigid(self) -> Array:
        """Motion of the contacts per motion about the centre of mass, shape (contact, 6)."""
        return np.concatenate([rigid_rows(joint, self.radius_m) for joint in self.joints])

    @property
    def part(self) -> IndexArray:
        """Index of the part of each contact among PARTS, shape (contact,)."""
        held = [PARTS.index(part) for part in self.parts]
        return np.repeat(held, [3 * joint.welds for joint in self.joints])


def contacts_of(frame: Frame, structure: ShellStructure, radius_m: float) -> Contacts:
    """The machine's contacts; a joint without stiffness is none.

    Parameters
    ----------
    frame : stiffness, legs of the lower bearing
    structure : joints of the other parts
    radius_m : radius of the wall
    """
    contact_stiffness = frame.contacts
    every: Sequence[tuple[Port, Joint, float]] = (
        (BEARING_HOUSING, structure.bearing_housing, contact_stiffness.weld_n_per_m),
        (LOWER_BEARING, frame.legs, contact_stiffness.leg_n_per_m),
        (FIXED_SCROLL, structure.fixed_scroll, contact_stiffness.seal_n_per_m),
        (STATOR, structure.stator, contact_stiffness.land_n_per_m),
    )
    held = [each for each in every if each[2] > 0.0]
    stiffness = np.repeat([each[2] for each in held], [3 * each[1].welds for each in held])
    return Contacts(
        tuple(joint for _, joint, _ in held),
        tuple(part for part, _, _ in held),
        radius_m,
        stiffness * (1.0 + 1j * frame.joint_loss_factor_ratio),
    )


def rigid_rows(joint: Joint, radius_m: float) -> Array:
    """Mean motion of each weld per translation and rotation about the origin, (contact, 6).

    Outwards, up and around at each weld, of points on the wall.

    Parameters
    ----------
    joint : welds
    radius_m : radius of the wall
    """
    angle, z = weld_angles(joint), joint.height_m
    mean = np.sinc(joint.spread_rad / (2.0 * np.pi))
    cosine, sine = mean * np.cos(angle), mean * np.sin(angle)
    none, unit = np.zeros_like(angle), np.ones_like(angle)
    rows = np.array(
        [
            [cosine, sine, none, -z * sine, z * cosine, none],
            [none, none, unit, radius_m * sine, -radius_m * cosine, none],
            [-sine, cosine, none, -z * cosine, -z * sine, radius_m * unit],
        ]
    )
    return np.asarray(rows.transpose(2, 0, 1).reshape(-1, 6))
