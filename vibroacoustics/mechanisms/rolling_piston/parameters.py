"""A rolling-piston compressor: cylinders, gas, valve, leakage, vane, roller, shaft, drive."""

from math import inf, pi, sqrt
from typing import Any, Final, Literal

from pydantic import Field

from ...base.parameters import Contradictions, Parameters
from ...machine.cavities import DischargeDome
from ...machine.limits import Limit
from ...machine.machine import PART_MASS, Machine
from ...machine.shell_structure import ShellStructure, ShellVariation
from ...mechanics.capabilities import HEIGHT, BalancePlanes
from ...mechanics.torque_control import TorqueControl
from ...sources.synchronous_motor.parameters import SynchronousMotor
from .accumulator import Accumulator

LENGTH = Field(gt=0.0, le=0.5)
GAP = Field(ge=0.0, le=1e-3)
FILM = Field(ge=1e-7, le=1e-3)
FRICTION = Field(ge=0.0, le=0.5)
PRESSURE = Field(gt=0.0, le=1e8)
ANGLE = Field(ge=0.0, le=pi)
LARGEST_ECCENTRICITY: Final = 0.45
"""Largest eccentricity over the bore's radius; at 0.5 the vane's line would miss the roller."""


class Cylinder(Parameters):
    """Bore, roller and vane of each cylinder [R_c, R_r, H, B]."""

    number: Literal[1, 2]
    """Cylinders, two with eccentrics at 180° and vanes in one plane."""
    bore_radius_m: float = LENGTH
    eccentricity_m: float = LENGTH
    """Distance of the roller's centre from the shaft's axis, R_c - R_r."""
    height_m: float = LENGTH
    vane_thickness_m: float = LENGTH
    suction_end_rad: float = ANGLE
    """Angle of the contact from the vane at which the suction port is passed."""
    middle_height_m: float = HEIGHT
    """Height of the cylinders' middle from the centre of mass at rest."""
    spacing_m: float = Field(default=0.0, ge=0.0, le=0.5)
    """Distance between the middles of two cylinders, along the shaft."""

    def contradictions(self) -> Contradictions:
        most = LARGEST_ECCENTRICITY * self.bore_radius_m
        if self.eccentricity_m > most:
            yield (
                f"eccentricity_mm = {1e3 * self.eccentricity_m:g} mm: must be at most "
                f"{1e3 * most:.4g} mm, {LARGEST_ECCENTRICITY:g} of the bore's radius"
            )
        if self.number == 2 and self.spacing_m < self.height_m:
            yield (
                f"spacing_mm = {1e3 * self.spacing_m:g} mm: must be at least height_mm = "
                f"{1e3 * self.height_m:g} mm with two cylinders"
            )

    @property
    def roller_radius_m(self) -> float:
        """R_r = R_c - e."""
        return self.bore_radius_m - self.eccentricity_m

    @property
    def stations(self) -> tuple[tuple[float, float], ...]:
        """Lead of the eccentric on the first one, rad, and height, m, of each cylinder."""
        if self.number == 1:
            return ((0.0, self.middle_height_m),)
        half = 0.5 * self.spacing_m
        return (0.0, self.middle_height_m + half), (pi, self.middle_height_m - half)


class RotaryGas(Parameters):
    """Gas between two pressures; the shell is at discharge pressure."""

    suction_pressure_pa: float = PRESSURE
    discharge_pressure_pa: float = PRESSURE
    suction_density_kg_per_m3: float = Field(gt=0.0, le=1e3)
    exponent_ratio: float = Field(gt=1.0, le=2.0)
    """Isentropic exponent κ, constant."""
    clearance_volume_m3: float = Field(gt=0.0, le=1e-3)
    """Volume of discharge port and recess, which expands back into the suction side."""

    def contradictions(self) -> Contradictions:
        if self.discharge_pressure_pa <= self.suction_pressure_pa:
            yield (
                f"discharge_pressure_bar = {1e-5 * self.discharge_pressure_pa:g} bar: must exceed "
                f"suction_pressure_bar = {1e-5 * self.suction_pressure_pa:g} bar"
            )

    @property
    def discharge_density_kg_per_m3(self) -> float:
        """Density after isentropic compression, ρ_s (p_d/p_s)^(1/κ)."""
        ratio = self.discharge_pressure_pa / self.suction_pressure_pa
        return float(self.suction_density_kg_per_m3 * ratio ** (1.0 / self.exponent_ratio))

    @property
    def discharge_sound_speed_m_per_s(self) -> float:
        """√(κ p_d/ρ_d)."""
        pressure = self.exponent_ratio * self.discharge_pressure_pa
        return sqrt(pressure / self.discharge_density_kg_per_m3)


class ReedValve(Parameters):
    """Discharge reed of each cylinder as one mass on a spring, between seat and stop."""

    port_diameter_m: float = LENGTH
    flow_ratio: float = Field(gt=0.0, le=1.0)
    """Effective over geometric area, of port and gap alike."""
    mass_kg: float = Field(gt=0.0, le=1.0)
    """Mass that moves with the lift."""
    natural_frequency_hz: float = Field(ge=1.0, le=1e5)
    damping_ratio: float = Field(ge=0.0, le=2.0)
    lift_m: float = Field(gt=0.0, le=0.05)
    """Lift to the stop."""
    seat_stiffness_n_per_m: float = Field(gt=0.0, le=1e9)
    """Stiffness of seat and stop."""
    seat_damping_ratio: float = Field(ge=0.0, le=2.0)
    """Damping ratio of the mass on seat or stop."""

    def contradictions(self) -> Contradictions:
        most = 0.25 * self.port_diameter_m
        if self.lift_m > most:
            yield (
                f"lift_mm = {1e3 * self.lift_m:g} mm: must be at most {1e3 * most:g} mm, a quarter "
                "of port_diameter_mm, where the gap is as large as the port"
            )


class Leakage(Parameters):
    """Gaps from the compression to the suction chamber of a cylinder."""

    contact_gap_m: float = GAP
    """Gap between roller and bore."""
    vane_end_gap_m: float = GAP
    """Gap at each end of the vane."""
    flow_ratio: float = Field(gt=0.0, le=1.0)
    """Effective over geometric area."""


class Vane(Parameters):
    """Vane in its slot, pressed by the gas of the shell and a spring."""

    mass_kg: float = PART_MASS
    length_m: float = LENGTH
    spring_force_n: float = Field(ge=0.0, le=1e4)
    """Force at the outermost position."""
    spring_stiffness_n_per_m: float = Field(ge=0.0, le=1e6)
    tip_friction_ratio: float = FRICTION
    slot_friction_ratio: float = FRICTION


class Roller(Parameters):
    """Roller on its eccentric, free to turn."""

    mass_kg: float = PART_MASS
    inner_radius_m: float = LENGTH
    eccentric_mass_kg: float = Field(ge=0.0, le=100.0)
    """Mass of the eccentric and what else of the shaft is on its side."""
    film_gap_m: float = FILM
    """Gap between eccentric and roller."""
    face_gap_m: float = FILM
    """Gap between each end of the roller and the cover."""


class RotaryShaft(Parameters):
    """Shaft with the motor's rotor in two plain bearings on both sides of the cylinders."""

    inertia_kg_m2: float = Field(gt=0.0, le=1e3)
    """Moment of inertia of rotor and shaft without eccentrics, rollers and counterweights."""
    main_bearing_height_m: float = HEIGHT
    sub_bearing_height_m: float = HEIGHT
    journal_radius_m: float = LENGTH
    main_length_m: float = LENGTH
    sub_length_m: float = LENGTH
    clearance_m: float = FILM
    """Radial, of both."""
    oil_viscosity_pa_s: float = Field(gt=0.0, le=10.0)
    """Oil of bearings and roller."""

    def contradictions(self) -> Contradictions:
        if self.main_bearing_height_m - self.sub_bearing_height_m < 1e-3:
            yield (
                f"main_bearing_height_mm = {1e3 * self.main_bearing_height_m:g} mm: must be at "
                f"least 1 mm above sub_bearing_height_mm = {1e3 * self.sub_bearing_height_m:g} mm"
            )


class Drive(Parameters):
    """Slope of the motor's torque over the speed."""

    supply: Literal["mains", "inverter"]
    motor_slope_ratio: float = Field(ge=-3.0, le=1.0)
    """Relative change of the motor's torque per relative change of speed within a turn."""
    torque_per_current_nm_per_a: float = Field(gt=0.0, le=1e3)
    """Torque over the peak of the phase current."""
    control: TorqueControl | None = None
    """Control by an inverter; none is a constant torque."""

    @property
    def is_inverter(self) -> bool:
        """Whether an inverter feeds the motor."""
        return self.supply == "inverter"

    def contradictions(self) -> Contradictions:
        if self.control is not None and not self.is_inverter:
            yield 'control: needs supply = "inverter"; a motor on the mains has none'


class CounterweightPlanes(BalancePlanes):
    """Planes at both ends of the rotor, and how much of the turning masses they balance."""

    balanced_ratio: float = Field(ge=0.0, le=2.0)
    """Share of force and couple of eccentrics and rollers; 1 is a balance in both planes."""


class RollingPistonTables(Machine):
    """Values of the machine."""

    cylinder: Cylinder
    gas: RotaryGas
    valve: ReedValve
    leakage: Leakage
    vane: Vane
    roller: Roller
    rotary_shaft: RotaryShaft
    drive: Drive
    counterweights: CounterweightPlanes
    accumulator: Accumulator | None = None
    """Accumulator on a bracket at the shell; none where it stands apart."""
    synchronous_motor: SynchronousMotor | None = None
    """Motor on an inverter, for the source of that name."""
    structure: ShellStructure | None = None
    """Wall of the shell, where it may bend."""
    variation: ShellVariation | None = None
    discharge_dome: DischargeDome | None = None
    """Gas of the shell above the motor; none where it is silent."""

    def contradictions(self) -> Contradictions:
        cylinder, roller, vane = self.cylinder, self.roller, self.vane
        if roller.inner_radius_m >= cylinder.roller_radius_m:
            yield (
                f"roller.inner_radius_mm = {1e3 * roller.inner_radius_m:g} mm: must be below the "
                f"roller's radius, {1e3 * cylinder.roller_radius_m:g} mm"
            )
        if vane.length_m <= 2.0 * cylinder.eccentricity_m:
            yield (
                f"vane.length_mm = {1e3 * vane.length_m:g} mm: must exceed the stroke "
                f"2 eccentricity_mm = {2e3 * cylinder.eccentricity_m:g} mm"
            )
        reason = self.discharge_dome and self.discharge_dome.why_not_in(self.shell)
        if reason:
            yield f"discharge_dome.{reason}"


def _roller_bore(machine: Any) -> tuple[float, float]:
    """The roller keeps a wall."""
    return 0.0, 0.98 * machine.cylinder.roller_radius_m


def _valve_lift(machine: Any) -> tuple[float, float]:
    return 0.0, 0.25 * machine.valve.port_diameter_m


def _vane_length(machine: Any) -> tuple[float, float]:
    return 2.1 * machine.cylinder.eccentricity_m, inf


SIZES: Final = (
    Limit("roller.inner_radius_m", _roller_bore),
    Limit("valve.lift_m", _valve_lift),
    Limit("vane.length_m", _vane_length),
)
"""Sizes with which the parts fit together."""
