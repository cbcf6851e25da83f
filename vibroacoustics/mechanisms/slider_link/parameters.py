"""A slider-link compressor: piston with cross link, slider on the crank pin, cantilever shaft.

Symbols in brackets are those of Dagilis, Vaitkus and Kirejchick (2006). Offsets along y are in
the paper's frame: x along the cylinder, z down along the shaft, origin on the shaft at the height
of the block's centre of mass.
"""

from math import pi

from pydantic import Field

from ...base.parameters import Contradictions, Parameters
from ...base.units import shaft_frequency_hz
from ...machine.machine import PART_MASS, Machine
from ...machine.suspension import Suspension
from ...mechanics.capabilities import BalancePlanes, CrankFrame
from ...mechanics.cylinder_gas import CylinderGas

LENGTH = Field(gt=0.0, le=0.5)
OFFSET = Field(ge=-0.05, le=0.05)
CLEARANCE = Field(ge=1e-7, le=1e-3)
FRICTION = Field(ge=0.0, le=0.5)


class SliderLink(Parameters):
    """Crank, slider, link, piston and cylinder."""

    crank_radius_m: float = Field(ge=1e-4, le=0.1)
    """[R]"""
    bore_m: float = Field(ge=1e-3, le=0.3)
    """[D]"""
    piston_length_m: float = LENGTH
    """Length from the piston's end to the axis of the link [L_p]."""
    cylinder_length_m: float = LENGTH
    """Engaged length at top dead centre [L_c]."""
    slider_diameter_m: float = Field(gt=0.0, le=0.2)
    """[D_s]"""
    link_offset_m: float = OFFSET
    """Shaft axis from the cylinder's axis, along y [e]."""
    piston_mass_offset_m: float = OFFSET
    """Centre of mass of piston and link from the cylinder's axis, along y [e_cl]."""
    cylinder_friction_ratio: float = FRICTION
    """[µ_c]"""
    link_friction_ratio: float = FRICTION
    """[µ_s]"""
    piston_clearance_m: float = CLEARANCE
    """Radial [c_p]."""

    def contradictions(self) -> Contradictions:
        stroke = 2.0 * self.crank_radius_m
        if self.cylinder_length_m <= stroke:
            yield (
                f"cylinder_length_mm = {1e3 * self.cylinder_length_m:g} mm: must be above the "
                f"stroke 2 crank_radius_mm = {1e3 * stroke:g} mm, the piston would leave it"
            )
        room = self.piston_length_m - self.cylinder_length_m
        if room < 0.5 * self.slider_diameter_m:
            yield (
                f"piston_length_mm = {1e3 * self.piston_length_m:g} mm: must exceed "
                f"cylinder_length_mm by half of slider_diameter_mm, by "
                f"{500.0 * self.slider_diameter_m:g} mm, the link would hit the cylinder"
            )


class MovingMasses(Parameters):
    """Masses of the three moving bodies; the product of inertia takes x' through the crank pin."""

    piston_mass_kg: float = PART_MASS
    """Piston and link [m_p]."""
    slider_mass_kg: float = PART_MASS
    """[m_s]"""
    crankshaft_mass_kg: float = PART_MASS
    """Crankshaft, rotor and counterweight [m_r]."""
    crankshaft_mass_offset_m: float = OFFSET
    """Their centre of mass from the shaft's axis, away from the crank pin [e_cr]."""
    crankshaft_inertia_kg_m2: float = Field(gt=0.0, le=100.0)
    """Inertia about the shaft's axis [J_z]."""
    crankshaft_product_kg_m2: float = Field(ge=-1.0, le=1.0)
    """∫ x' z dm [J_x'z]."""


class Heights(Parameters):
    """Distances along the shaft."""

    piston_axis_m: float = Field(ge=-0.5, le=0.5)
    """Height from the block's centre of mass up to the piston's axis [z_s]."""
    upper_bearing_m: float = LENGTH
    """Height of the piston's axis above the centre of the upper bearing [z_p]."""
    bearing_distance_m: float = LENGTH
    """Distance between the middles of the two bearings [z_b]."""


class JournalBearing(Parameters):
    """A full journal bearing."""

    radius_m: float = Field(ge=1e-3, le=0.2)
    length_m: float = Field(ge=1e-3, le=0.5)
    clearance_m: float = CLEARANCE
    """Radial."""

    def contradictions(self) -> Contradictions:
        if self.clearance_m > 0.1 * self.radius_m:
            yield (
                f"clearance_um = {1e6 * self.clearance_m:g} µm: must not exceed a tenth of "
                f"radius_mm = {1e3 * self.radius_m:g} mm"
            )


class ThrustBearing(Parameters):
    outer_radius_m: float = Field(gt=0.0, le=0.5)
    """[R_t]"""
    inner_radius_m: float = Field(ge=0.0, le=0.5)
    """[r_t]"""
    friction_ratio: float = FRICTION
    """[µ_t]"""

    def contradictions(self) -> Contradictions:
        if self.inner_radius_m >= self.outer_radius_m:
            yield (
                f"inner_radius_mm = {1e3 * self.inner_radius_m:g} mm: must be below "
                f"outer_radius_mm = {1e3 * self.outer_radius_m:g} mm"
            )


class Bearings(Parameters):
    crank_pin: JournalBearing
    upper: JournalBearing
    lower: JournalBearing
    thrust: ThrustBearing


class Oil(Parameters):
    viscosity_pa_s: float = Field(ge=1e-5, le=10.0)
    """[η]"""
    pump_power_w: float = Field(ge=0.0, le=1e3)
    """Power of the oil pump at the speed below; its moment is constant [M_p]."""
    pump_speed_rpm: float = Field(ge=60.0, le=60000.0)

    @property
    def pump_moment_n_m(self) -> float:
        return self.pump_power_w / (2.0 * pi * shaft_frequency_hz(self.pump_speed_rpm))


class Motor(Parameters):
    slope_n_m_s_per_rad: float = Field(ge=0.0, le=10.0)
    """Fall of the torque per rise of the speed."""


class SliderLinkTables(Machine):
    """Values of the machine and the axes of its crank."""

    mechanism: SliderLink
    masses: MovingMasses
    heights: Heights
    bearings: Bearings
    oil: Oil
    gas: CylinderGas
    """The shell is at suction pressure [p_0]."""
    motor: Motor
    counterweights: BalancePlanes
    """Planes for further weights on the shaft."""
    centre_of_mass_offset_m: float = Field(ge=-0.2, le=0.2)
    """Block's centre of mass from the shaft's axis, along x [x_c]."""
    suspension: Suspension
    """Block, stator and moving parts [M, J_X, J_Y, J_Z] on the internal springs."""

    @property
    def crank_frame(self) -> CrankFrame:
        """The paper's frame: z down, and the crank turns from x to the paper's y."""
        return CrankFrame(
            stroke=(1.0, 0.0, 0.0),
            across=(0.0, -1.0, 0.0),
            shaft=(0.0, 0.0, -1.0),
            origin_m=(-self.centre_of_mass_offset_m, 0.0, 0.0),
        )

    def contradictions(self) -> Contradictions:
        pin = 2.0 * self.bearings.crank_pin.radius_m
        if pin >= self.mechanism.slider_diameter_m:
            yield (
                f"slider_diameter_mm = {1e3 * self.mechanism.slider_diameter_m:g} mm: must be "
                f"above the crank pin's diameter of {1e3 * pin:g} mm"
            )
