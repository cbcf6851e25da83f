"""A hermetic reciprocating compressor: slider-crank, gas, motor, journal bearings and shaft."""

from typing import Literal

from pydantic import Field, model_validator

from .base import Parameters
from .machine import Erratum

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


class Rod(Parameters):
    """Connecting rod; its centre of mass lies on the line of the two pins."""

    length_m: float = LENGTH
    mass_kg: float = MASS
    centre_of_mass_m: float = Field(ge=0.0, le=2.0)
    """From the piston pin."""
    inertia_kg_m2: float = INERTIA
    """About the axis of the crankshaft's direction through the centre of mass."""

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


class Gas(Parameters):
    suction_pressure_pa: float = Field(gt=0.0, le=1e8)
    discharge_pressure_pa: float = Field(gt=0.0, le=1e8)
    exponent_ratio: float = Field(ge=1.0, le=2.0)
    """Polytropic exponent."""
    clearance_ratio: float = Field(gt=0.0, le=1.0)
    """Clearance volume over swept volume."""

    @model_validator(mode="after")
    def _compresses(self) -> "Gas":
        if self.discharge_pressure_pa <= self.suction_pressure_pa:
            raise ValueError(
                f"discharge_pressure_pa = {self.discharge_pressure_pa:g} Pa: must exceed "
                f"suction_pressure_pa = {self.suction_pressure_pa:g} Pa"
            )
        reached = (1.0 + 1.0 / self.clearance_ratio) ** self.exponent_ratio
        if self.discharge_pressure_pa >= reached * self.suction_pressure_pa:
            raise ValueError(
                f"discharge_pressure_pa = {self.discharge_pressure_pa:g} Pa: must be less than "
                f"{reached * self.suction_pressure_pa:g} Pa, the compression at "
                f"clearance_ratio = {self.clearance_ratio:g}"
            )
        return self


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

    @model_validator(mode="after")
    def _triangle_inequality(self) -> "Rotor":
        if self.axial_inertia_kg_m2 > 2.0 * self.transverse_inertia_kg_m2:
            raise ValueError(
                "axial_inertia_kg_m2: must not exceed the sum of the two transverse ones, got "
                f"{self.axial_inertia_kg_m2:g} > 2 x {self.transverse_inertia_kg_m2:g} kg m²"
            )
        return self


class Shaft(Parameters):
    """Uniform shaft from the crank's centre, where the upper bearing is, past the lower bearing
    to the middle of the motor rotor."""

    diameter_m: float = LENGTH
    bearing_distance_m: float = LENGTH
    rotor_distance_m: float = LENGTH
    """Middle of the rotor below the lower bearing."""
    youngs_modulus_pa: float = Field(gt=0.0, le=1e13)
    density_kg_per_m3: float = Field(gt=0.0, le=1e5)


class HermeticCompressor(Parameters):
    name: str = Field(min_length=1)
    kind: Literal["hermetic-reciprocating"]
    piston: Piston
    rod: Rod
    crank: Crank
    gas: Gas
    motor: InductionMotor
    bearing: JournalBearing
    rotor: Rotor
    shaft: Shaft
    errata: tuple[Erratum, ...] = ()

    @model_validator(mode="after")
    def _mechanism_closes(self) -> "HermeticCompressor":
        if self.rod.length_m <= self.crank.radius_m:
            raise ValueError(
                f"rod.length_m = {self.rod.length_m:g} m: must exceed crank.radius_m = "
                f"{self.crank.radius_m:g} m, or the mechanism cannot close"
            )
        return self
