"""A single-acting reciprocating compressor: slider-crank, bearings, gas, drive."""

from collections.abc import Iterable
from math import pi
from typing import ClassVar, Final

from pydantic import Field, model_validator

from ...base.curves import Curve
from ...base.parameters import Parameters
from ...base.registry import register
from ...machine.machine import Machine
from ...mechanics.capabilities import (
    HEIGHT,
    BalancePlanes,
    Capability,
    CrankFrame,
    Slider,
)
from ...mechanics.moving_parts import Revolution
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
    """About its centre of mass."""

    @model_validator(mode="after")
    def _centre_on_the_rod(self) -> "PistonAndRod":
        total = self.small_end_to_centre_m + self.big_end_to_centre_m
        if abs(total - self.rod_length_m) > 1e-3 * self.rod_length_m:
            raise ValueError(
                "small_end_to_centre_mm + big_end_to_centre_mm = "
                f"{1e3 * total:g} mm: must be rod_length_mm = {1e3 * self.rod_length_m:g} mm"
            )
        return self


class Crankshaft(Parameters):
    inertia_kg_m2: float = Field(gt=0.0, le=1e6)
    """Of all that turns with the shaft, balanced about its axis."""
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

    @model_validator(mode="after")
    def _compresses(self) -> "CylinderGas":
        ratio = self.discharge_pressure_pa / self.suction_pressure_pa
        if ratio <= 1.0:
            raise ValueError(
                f"discharge_pressure_mpa = {1e-6 * self.discharge_pressure_pa:g} MPa: must exceed "
                f"suction_pressure_mpa = {1e-6 * self.suction_pressure_pa:g} MPa"
            )
        if self.clearance_ratio * (ratio ** (1.0 / self.polytropic_index) - 1.0) >= 1.0:
            raise ValueError(
                f"clearance_ratio = {self.clearance_ratio:g}: the gas in the clearance expands "
                "over the whole stroke and nothing is drawn in"
            )
        return self


@register
class ReciprocatingMachine(Machine):
    """One upright cylinder, or banks of them; the shaft lies along y under the centre of mass."""

    kind: ClassVar[str] = "reciprocating"
    axes: ClassVar[str] = "across the shaft (x), along it (y) and upright (z)"
    orders: ClassVar[str] = (
        "The tilt of the connecting rod makes the even orders, the swing of the shaft's speed "
        "under the gas load the others. Orders are multiples of the mean shaft frequency in "
        "time."
    )
    reads: ClassVar[frozenset[str]] = Machine.reads | {"cylinders"}
    piston_and_rod: PistonAndRod
    crankshaft: Crankshaft
    sliding_pairs: SlidingPairs
    gas: CylinderGas
    crankshaft_height_m: float = HEIGHT
    """Of the shaft's axis from the centre of mass at rest."""
    cylinders: CylinderBanks | None = None
    """Banks and crank throws; none is one cylinder."""
    counterweights: BalancePlanes
    """Where weights can sit on the crank; heights along the shaft from the cylinder's axis."""

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

    @property
    def capabilities(self) -> tuple[Capability, ...]:
        """Piston and the part of the rod that goes with it, by its two eyes, of one cylinder."""
        if self.cylinders is not None:
            return ()
        part = self.piston_and_rod
        radius = 2.0 * part.displacement_m3 / (pi * part.bore_m**2)
        rod_mass = part.rod_mass_kg * radius / part.crank_to_rod_ratio / part.rod_length_m
        share = rod_mass * part.big_end_to_centre_m / part.rod_length_m
        slider = Slider(
            part.piston_mass_kg + share,
            radius,
            0.0,
            self.counterweights,
            self.crank_frame,
        )
        return (slider,)

    def revolution(self, speed_rpm: float, samples: int) -> Revolution:
        """Steady revolution of the moving parts; see `reciprocating_revolution`."""
        from .revolution import reciprocating_revolution

        return reciprocating_revolution(self, speed_rpm, samples)

    def curves(self, speed_rpm: float) -> Iterable[Curve]:
        """Torques, friction, losses and efficiency; see `reciprocating_curves`."""
        from .curves import reciprocating_curves

        return reciprocating_curves(self, speed_rpm)

    def leaves_out(self, inner_sources: bool) -> tuple[str, ...]:
        """What the model leaves out."""
        return _LEAVES_OUT if self.cylinders is None else _LEAVES_OUT_OF_BANKS


_LEAVES_OUT_OF_BANKS: Final = (
    "All cylinders have the same gas and dimensions. But for the counterweights of its throws the "
    "crankshaft is balanced about its axis; it is rigid, in bending and in torsion.",
)
_LEAVES_OUT: Final = (
    "One cylinder stands for the machine. The crankshaft is balanced about its axis, the big end "
    "of the rod is not; the paper gives no counterweight. Lanchester's weights are in the plane "
    "of the cylinder's axis, without the moment of their gears.",
)
