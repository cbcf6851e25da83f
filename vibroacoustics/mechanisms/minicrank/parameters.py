"""A scroll compressor that mini-cranks keep from turning: links, masses, loads."""

from pydantic import Field

from ...base.parameters import Parameters
from ...machine.machine import Machine
from ...mechanics.capabilities import HEIGHT, BalancePlanes, CrankFrame
from .links import FourBar

MASS = Field(gt=0.0, le=1e3)


class Masses(Parameters):
    crank_pin_mass_kg: float = Field(ge=0.0, le=1e3)
    """m1, of what turns on the radius of the crank besides the scroll."""
    scroll_mass_kg: float = MASS
    """m2, with its centre of mass at the crank pin."""
    scroll_inertia_kg_m2: float = Field(gt=0.0, le=1e4)
    """J2, about the crank pin."""
    minicrank_inertia_kg_m2: float = Field(ge=0.0, le=1e4)
    """J3 of each, about its own axis."""
    minicrank_mass_kg: float = Field(ge=0.0, le=1e3)
    """m3 of each, with its centre of mass at the pin in the scroll."""
    minicrank_balance_ratio: float = Field(ge=0.0, le=2.0)
    """Share of m3 l3 that a counterweight on the mini-crank itself takes."""
    rotor_inertia_kg_m2: float = Field(gt=0.0, le=1e6)
    """Inertia of all that turns with the crankshaft, the scroll's mass at the crank pin
    included."""
    motor_slope_ratio: float = Field(ge=-3.0, le=1.0)
    """Relative change of the motor's torque per relative change of speed."""

    def of_all(self, minicranks: int) -> "Masses":
        """Return the masses of all mini-cranks as one, less what their own counterweights
        balance."""
        unbalanced_share = 1.0 - self.minicrank_balance_ratio
        return self.model_copy(
            update={
                "minicrank_inertia_kg_m2": minicranks * self.minicrank_inertia_kg_m2,
                "minicrank_mass_kg": minicranks * unbalanced_share * self.minicrank_mass_kg,
                "minicrank_balance_ratio": 0.0,
            }
        )


class ScrollLoads(Parameters):
    tangential_force_n: float = Field(ge=0.0, le=1e7)
    """Mean tangential gas force F_t."""
    ripple_ratio: float = Field(ge=0.0, le=1.0)
    """Amplitude of its once-per-revolution part over the mean."""
    radial_force_n: float = Field(ge=0.0, le=1e7)
    """Radial gas force F_r, towards the axis of the crankshaft."""
    overturning_arm_m: float = Field(ge=0.0, le=1.0)
    """Overturning moment M_m over F_t."""
    plate_friction: float = Field(ge=0.0, le=0.5)
    """µ_d between orbiting and fixed scroll."""
    friction_angle_rad: float = Field(ge=-7.0, le=7.0)
    """γ - η, from the line of the overturning moment to the direction of friction."""


class MiniCrankTables(Machine):
    """Values of the machine and the axes of its mechanism."""

    four_bar: FourBar
    masses: Masses
    loads: ScrollLoads
    crankshaft_height_m: float = HEIGHT
    """Height of the shaft's axis from the centre of mass at rest."""
    links_offset_m: float = HEIGHT
    """Offset of the links' plane along the shaft from the centre of mass at rest."""
    counterweights: BalancePlanes
    """Counterweights of the crankshaft; heights along the shaft from the links' plane. Their mass
    moments follow from (10)."""

    @property
    def crank_frame(self) -> CrankFrame:
        """Axes in the plane of the links."""
        return self.plane(0.0)

    def plane(self, height_m: float) -> CrankFrame:
        """Axes of the mechanism about the shaft's axis, at a height along it from the links.

        From the mini-crank's axis upwards is a positive crank angle.
        """
        along = self.links_offset_m + height_m
        return CrankFrame(
            stroke=(1.0, 0.0, 0.0),
            across=(0.0, 0.0, 1.0),
            shaft=(0.0, -1.0, 0.0),
            origin_m=(0.0, -along, self.crankshaft_height_m),
        )
