"""A hermetic reciprocating compressor: slider-crank, gas, motor, journal bearings and shaft."""

from typing import Literal

from pydantic import Field

from ...base.parameters import Contradictions, Parameters
from ...machine.machine import Machine
from ...mechanics.capabilities import HEIGHT, BalancePlanes, CrankFrame
from ...mechanics.cylinder_gas import CylinderGas

Case = Literal["I", "II", "III"]
"""Crank held, crank free in x and y in one bearing, flexible shaft in two bearings."""

LENGTH = Field(gt=0.0, le=2.0)
MASS = Field(gt=0.0, le=100.0)
INERTIA = Field(gt=0.0, le=10.0)


class JournalBearing(Parameters):
    radius_m: float = LENGTH
    width_m: float = LENGTH
    clearance_m: float = Field(gt=0.0, le=1e-3)
    """Radial clearance."""
    viscosity_pa_s: float = Field(gt=0.0, le=10.0)


class Piston(Parameters):
    diameter_m: float = LENGTH
    mass_kg: float = MASS
    cylinder_offset_m: float = Field(ge=-0.1, le=0.1)
    """Offset of the cylinder's axis from the shaft's, towards the crank pin at a quarter turn."""


class Rod(Parameters):
    """Connecting rod; its centre of mass lies on the line of the two pins."""

    length_m: float = LENGTH
    mass_kg: float = MASS
    centre_of_mass_m: float = Field(ge=0.0, le=2.0)
    """Position of the centre of mass from the piston pin."""
    inertia_kg_m2: float = INERTIA
    """Inertia about the axis of the crankshaft's direction through the centre of mass."""

    @property
    def piston_pin_inertia_kg_m2(self) -> float:
        return self.inertia_kg_m2 + self.mass_kg * self.centre_of_mass_m**2


class Crank(Parameters):
    radius_m: float = LENGTH
    pin_offset_m: float = Field(ge=0.0, le=1.0)
    """Middle of the crank pin along the shaft from the crank's centre."""
    mass_kg: float = MASS
    mass_eccentricity_m: float = Field(ge=-0.5, le=0.5)
    """Centre of mass from the shaft axis, positive towards the crank pin."""
    axial_inertia_kg_m2: float = INERTIA
    transverse_inertia_kg_m2: float = INERTIA


class InductionMotor(Parameters):
    """Torque = slope (synchronous speed - speed), the running part of the torque curve."""

    synchronous_speed_rad_per_s: float = Field(gt=0.0, le=1e4)
    torque_slope_n_m_s: float = Field(gt=0.0, le=1e3)
    """Torque lost per rad/s gained, N m s."""


class Rotor(Parameters):
    """Motor rotor on the shaft, as a rigid disc."""

    mass_kg: float = MASS
    axial_inertia_kg_m2: float = INERTIA
    transverse_inertia_kg_m2: float = INERTIA

    def contradictions(self) -> Contradictions:
        if self.axial_inertia_kg_m2 > 2.0 * self.transverse_inertia_kg_m2:
            yield (
                "axial_inertia_kg_m2: must not exceed the sum of the two transverse ones, got "
                f"{self.axial_inertia_kg_m2:g} > 2 x {self.transverse_inertia_kg_m2:g} kg m²"
            )


class Shaft(Parameters):
    """Uniform shaft from the crank's centre, where the upper bearing is, past the lower bearing
    to the centre of the motor rotor."""

    diameter_m: float = LENGTH
    bearing_distance_m: float = LENGTH
    rotor_distance_m: float = LENGTH
    """Middle of the rotor below the lower bearing."""
    youngs_modulus_pa: float = Field(gt=0.0, le=1e13)
    density_kg_per_m3: float = Field(gt=0.0, le=1e5)


class HermeticTables(Machine):
    """Values of the machine and the axes of its crank."""

    case: Case
    crank_height_m: float = HEIGHT
    """Height of the crank's centre, where the upper bearing is, from the centre of mass at rest."""
    counterweights: BalancePlanes
    """Planes for weights on the shaft; heights from the crank's centre."""
    piston: Piston
    rod: Rod
    crank: Crank
    gas: CylinderGas
    motor: InductionMotor
    bearing: JournalBearing
    rotor: Rotor
    shaft: Shaft

    def contradictions(self) -> Contradictions:
        reach = self.crank.radius_m + abs(self.piston.cylinder_offset_m)
        if self.rod.length_m <= reach:
            yield (
                f"rod.length_mm = {1e3 * self.rod.length_m:g} mm: must exceed crank.radius_mm and "
                f"the size of piston.cylinder_offset_mm, {1e3 * reach:g} mm together, or the "
                "mechanism cannot close"
            )

    @property
    def crank_frame(self) -> CrankFrame:
        """Stroke along x; the paper's Z runs down the shaft, from the crank to the motor."""
        return CrankFrame(
            across=(0.0, -1.0, 0.0),
            shaft=(0.0, 0.0, -1.0),
            origin_m=(0.0, 0.0, self.crank_height_m),
        )
