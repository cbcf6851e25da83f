"""A single-acting reciprocating compressor: slider-crank, bearings, gas, drive."""

from pydantic import Field

from ...base.parameters import Contradictions, Parameters
from ...machine.machine import Machine
from ...mechanics.capabilities import HEIGHT, BalancePlanes, CrankFrame
from .cylinders import ONE_CYLINDER, CylinderBanks

LENGTH = Field(gt=0.0, le=10.0)
MASS = Field(gt=0.0, le=1e4)
PRESSURE = Field(gt=0.0, le=1e9)


class PistonAndRod(Parameters):
    """The reference design; other bores keep its displacement and length ratio."""

    displacement_m3: float = Field(gt=0.0, le=1.0)
    bore_m: float = LENGTH
    crank_to_rod_ratio: float = Field(gt=0.0, le=0.95)
    """Crank radius over rod length; at one and above the crank cannot turn."""
    crank_offset_m: float = Field(ge=-1.0, le=1.0)
    """Cylinder's axis from the crankshaft's, a quarter turn ahead of top dead centre."""
    piston_mass_kg: float = MASS
    rod_mass_kg: float = MASS
    rod_length_m: float = LENGTH
    small_end_to_centre_m: float = Field(ge=0.0, le=10.0)
    big_end_to_centre_m: float = Field(ge=0.0, le=10.0)
    rod_inertia_kg_m2: float = Field(ge=0.0, le=1e4)
    """Inertia about its centre of mass."""

    def contradictions(self) -> Contradictions:
        total = self.small_end_to_centre_m + self.big_end_to_centre_m
        if abs(total - self.rod_length_m) > 1e-3 * self.rod_length_m:
            yield (
                "small_end_to_centre_mm + big_end_to_centre_mm = "
                f"{1e3 * total:g} mm: must be rod_length_mm = {1e3 * self.rod_length_m:g} mm"
            )


class Crankshaft(Parameters):
    inertia_kg_m2: float = Field(gt=0.0, le=1e6)
    """Inertia of all that turns with the shaft, balanced about its axis."""
    motor_slope_ratio: float = Field(ge=-3.0, le=1.0)
    """Relative change of the motor's torque per relative change of speed."""


class SlidingPairs(Parameters):
    """Coulomb friction of the cylinder wall and of the three plain bearings."""

    wall_friction: float = Field(ge=0.0, le=0.5)
    bearing_friction: float = Field(ge=0.0, le=0.5)
    journal_radius_m: float = LENGTH
    crank_pin_radius_m: float = LENGTH
    piston_pin_radius_m: float = LENGTH


class CylinderGas(Parameters):
    suction_pressure_pa: float = PRESSURE
    discharge_pressure_pa: float = PRESSURE
    crankcase_pressure_pa: float = PRESSURE
    polytropic_index: float = Field(gt=1.0, le=2.0)
    clearance_ratio: float = Field(ge=0.0, le=0.5)
    """Clearance volume over displacement."""

    def contradictions(self) -> Contradictions:
        ratio = self.discharge_pressure_pa / self.suction_pressure_pa
        if ratio <= 1.0:
            yield (
                f"discharge_pressure_mpa = {1e-6 * self.discharge_pressure_pa:g} MPa: must exceed "
                f"suction_pressure_mpa = {1e-6 * self.suction_pressure_pa:g} MPa"
            )
        if self.clearance_ratio * (ratio ** (1.0 / self.polytropic_index) - 1.0) >= 1.0:
            yield (
                f"clearance_ratio = {self.clearance_ratio:g}: the gas in the clearance expands "
                "over the whole stroke and nothing is drawn in"
            )


class ReciprocatingTables(Machine):
    """Values of the machine and the axes of its crank."""

    piston_and_rod: PistonAndRod
    crankshaft: Crankshaft
    sliding_pairs: SlidingPairs
    gas: CylinderGas
    crankshaft_height_m: float = HEIGHT
    """Height of the shaft's axis from the centre of mass at rest."""
    cylinders: CylinderBanks | None = None
    """Banks and crank throws; none is one cylinder."""
    counterweights: BalancePlanes
    """Planes for weights on the crank; heights along the shaft from the cylinder's axis."""

    @property
    def banks(self) -> CylinderBanks:
        """Banks and crank throws, of one cylinder too."""
        return self.cylinders or ONE_CYLINDER

    @property
    def crank_frame(self) -> CrankFrame:
        """Stroke along z, shaft along y."""
        return CrankFrame(
            stroke=(0.0, 0.0, 1.0),
            across=(1.0, 0.0, 0.0),
            shaft=(0.0, 1.0, 0.0),
            origin_m=(0.0, 0.0, self.crankshaft_height_m),
        )
