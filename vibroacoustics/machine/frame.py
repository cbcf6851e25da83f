"""The frame in the shell: bodies of a scroll compressor and what holds them together.

A machine without this table hands the loads of its sources on to the shell's joints as they are.
"""

from dataclasses import dataclass
from math import pi
from typing import Final, Literal

import numpy as np
from pydantic import Field

from ..base.arrays import Array
from ..base.parameters import Parameters
from ..mechanics.ports import Port
from ..mechanics.scroll_shaft import ScrollShaft
from .housing import Housing
from .shell_structure import Joint, ShellStructure, ShellVariation

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
        """Inertia about its middle, shape (3, 3)."""
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
    """Stiffness of each, with the friction of what it presses together."""
    axial_stiffness_n_per_m: float = STIFFNESS
    """Stiffness of each, with the members."""
    guide_stiffness_n_per_m: float = STIFFNESS
    """Stiffness of each along z in place of the axial one where the fixed scroll may slide along
    it."""


class Face(Parameters):
    """An annular face that presses along z."""

    radius_m: float = RADIUS
    height_m: float = HEIGHT
    stiffness_n_per_m: float = STIFFNESS
    """Stiffness of the face around."""


class PlainBearing(Parameters):
    """A plain bearing with an oil film."""

    diameter_m: float = RADIUS
    length_m: float = RADIUS
    radial_clearance_m: float = Field(gt=0.0, le=1e-3)


class ContactStiffness(Parameters):
    """Stiffness of each contact of the frame with the shell, alike in all directions."""

    weld_n_per_m: float = STIFFNESS
    """Stiffness of the bearing housing."""
    leg_n_per_m: float = STIFFNESS
    """Stiffness of the lower bearing's bracket with its weld."""
    seal_n_per_m: float = STIFFNESS
    """Stiffness of the fixed scroll."""
    land_n_per_m: float = STIFFNESS
    """Stiffness of the stator."""


class Frame(Parameters):
    """Bodies, bolts, faces, bearings and contacts; the shaft is a table of its own."""

    keys_on: Literal["fixed-scroll", "bearing-housing"]
    """Part with the fixed slots."""
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
    """Stiffness of the keys between orbiting scroll and standing slots, around the shaft."""
    pin_stiffness_n_per_m: float = STIFFNESS
    """Metal of bushing and pin; the oil film is in series."""
    pin_load_n: float = Field(gt=0.0, le=1e6)
    """Mean force of gas and unbalance, which turns with the crank; journals by the lever."""
    pin_film: PlainBearing
    main_film: PlainBearing
    lower_film: PlainBearing
    oil_viscosity_pa_s: float = Field(gt=0.0, le=10.0)
    """Oil of pin and journals."""
    film_speed_rpm: float = Field(gt=0.0, le=1e5)
    """Shaft speed at which the films are computed."""
    metal_loss_factor_ratio: float = LOSS
    """Steel of shaft, pin and bearing seats."""
    joint_loss_factor_ratio: float = LOSS
    """Loss factor of bolts, faces, keys and contacts with the shell."""
    contacts: ContactStiffness
    legs: Joint
    """Joint of the lower bearing's bracket on the wall."""

    @property
    def mass_kg(self) -> float:
        """Mass of all bodies."""
        return float(sum(getattr(self, part.name).mass_kg for part in PARTS))


SHELL_TABLES: Final = (Housing, ShellStructure, ShellVariation, Frame, ScrollShaft)
"""Tables that the response of every port in the elastic shell reads."""


@dataclass(frozen=True, kw_only=True)
class Part(Port):
    """A part in the elastic shell, loaded by a wrench about the machine's centre of mass at rest.

    Attributes
    ----------
    tables : tables of every port in the shell
    joint : joint of the shell, to which the part hands its load on in a machine without a frame
    handed_on : components of the load that it hands on so

    Examples
    --------
    >>> va.STATOR.name, va.STATOR.handed_on
    ('stator', ('fx', 'fy', 'fz', 'mz'))
    """

    tables: tuple[type[Parameters], ...] = SHELL_TABLES
    joint: str
    handed_on: tuple[str, ...] = ("fx", "fy", "fz", "mz")


FIXED_SCROLL: Final = Part("fixed_scroll", joint="fixed_scroll")
BEARING_HOUSING: Final = Part("bearing_housing", joint="bearing_housing")
ORBITING_SCROLL: Final = Part(
    "orbiting_scroll", joint="bearing_housing", handed_on=("fx", "fy", "fz")
)
"""Acts through pin and main bearing; what turns it presses the keys, which are a source."""
LOWER_BEARING: Final = Part("lower_bearing", joint="stator")
STATOR: Final = Part("stator", joint="stator")
PARTS: Final = (FIXED_SCROLL, BEARING_HOUSING, ORBITING_SCROLL, LOWER_BEARING, STATOR)
"""Parts in the shell that sources load, in the order of the frame's bodies."""
