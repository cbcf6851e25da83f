"""The frame in the shell: bodies of a scroll compressor and what holds them together.

A machine without this table hands the loads of its sources on to the shell's joints as they are.
"""

from math import pi
from typing import Literal

import numpy as np
from pydantic import Field

from ..base.arrays import Array
from ..base.parameters import Parameters
from .shell_structure import Joint

HEIGHT = Field(ge=-2.0, le=2.0)
RADIUS = Field(gt=0.0, le=1.0)
STIFFNESS = Field(ge=0.0, le=1e15)
LOSS = Field(ge=0.0, le=1.0)


class RoundPart(Parameters):
    """A rigid part as heavy as it is, with the inertia of a solid disc."""

    mass_kg: float = Field(gt=0.0, le=100.0)
    radius_m: float = RADIUS
    thickness_m: float = Field(gt=0.0, le=1.0)
    height_m: float = HEIGHT
    """Its middle, from the centre of mass at rest."""

    @property
    def inertia_kg_m2(self) -> Array:
        """About its middle, shape (3, 3)."""
        polar = 0.5 * self.mass_kg * self.radius_m**2
        across = 0.5 * polar + self.mass_kg * self.thickness_m**2 / 12.0
        return np.diag([across, across, polar])


class Bolts(Parameters):
    """Bolts that hold the fixed scroll to the bearing housing."""

    number: int = Field(ge=1, le=64)
    radius_m: float = RADIUS
    height_m: float = HEIGHT
    first_angle_rad: float = Field(default=0.0, ge=-2.0 * pi, le=2.0 * pi)
    lateral_stiffness_n_per_m: float = STIFFNESS
    """Of each, with the friction of what it presses together."""
    axial_stiffness_n_per_m: float = STIFFNESS
    """Of each, with the members."""
    guide_stiffness_n_per_m: float = STIFFNESS
    """Of each along z in place of the axial one where the fixed scroll may slide along it."""


class Face(Parameters):
    """An annular face that presses along z."""

    radius_m: float = RADIUS
    height_m: float = HEIGHT
    stiffness_n_per_m: float = STIFFNESS
    """Of the face around."""


class ContactStiffness(Parameters):
    """Of each contact of the frame with the shell, alike in all directions."""

    weld_n_per_m: float = STIFFNESS
    """Of the bearing housing."""
    leg_n_per_m: float = STIFFNESS
    """Of the lower bearing's bracket with its weld."""
    seal_n_per_m: float = STIFFNESS
    """Of the fixed scroll."""
    land_n_per_m: float = STIFFNESS
    """Of the stator."""


class Frame(Parameters):
    """Bodies, bolts, faces, bearings and contacts; the shaft is a table of its own."""

    keys_on: Literal["fixed-scroll", "bearing-housing"]
    """Which part has the slots that stand."""
    radially_compliant: bool
    """The drive lets the flanks close: their contact takes the radial gas force."""
    axially_compliant: bool
    """Back pressure presses the fixed scroll on the tips: they take the axial gas force."""
    wraps_height_m: float = HEIGHT
    """Middle of the wraps, where the gas acts."""
    lower_bearing_height_m: float = HEIGHT
    """Middle of the lower bearing, from which the heights on the shaft count."""
    fixed_scroll: RoundPart
    bearing_housing: RoundPart
    orbiting_scroll: RoundPart
    lower_bearing: RoundPart
    stator: RoundPart
    bolts: Bolts
    thrust_face: Face
    tips: Face
    keys_radius_m: float = RADIUS
    keys_stiffness_n_per_m: float = STIFFNESS
    """Of the keys between orbiting scroll and standing slots, around the shaft."""
    pin_stiffness_n_per_m: float = STIFFNESS
    bearing_loss_factor_ratio: float = LOSS
    """Of bearings and pin."""
    joint_loss_factor_ratio: float = LOSS
    """Of bolts, faces, keys and contacts with the shell."""
    contacts: ContactStiffness
    legs: Joint
    """Of the lower bearing's bracket on the wall."""

    @property
    def mass_kg(self) -> float:
        """Of all bodies."""
        parts = (self.fixed_scroll, self.bearing_housing, self.orbiting_scroll)
        return sum(part.mass_kg for part in (*parts, self.lower_bearing, self.stator))
