"""A scroll compressor that mini-cranks keep from turning: four-bar links, inertias, loads."""

from typing import Literal

from pydantic import Field

from .base import Parameters
from .machine import Erratum

LINK = Field(gt=0.0, le=10.0)
ERROR = Field(default=0.0, ge=-1e-3, le=1e-3)


class FourBar(Parameters):
    """Nominal links and their errors: crankshaft l1, scroll l2, mini-crank l3, bracket l4."""

    crank_m: float = LINK
    scroll_m: float = LINK
    minicrank_m: float = LINK
    bracket_m: float = LINK
    crank_error_m: float = ERROR
    scroll_error_m: float = ERROR
    minicrank_error_m: float = ERROR
    bracket_error_m: float = ERROR
    branch: Literal[1, -1]
    """M of equation (5): which way the mechanism is assembled."""


class Masses(Parameters):
    scroll_inertia_kg_m2: float = Field(gt=0.0, le=1e4)
    """J2, about the crank pin, where its centre of mass is."""
    minicrank_inertia_kg_m2: float = Field(ge=0.0, le=1e4)
    """J3, about its own axis."""
    minicrank_mass_kg: float = Field(ge=0.0, le=1e3)
    """m3, with its centre of mass at the pin in the scroll."""
    rotor_inertia_kg_m2: float = Field(gt=0.0, le=1e6)
    """Of all that turns with the crankshaft, the scroll's mass at the crank pin included."""
    motor_slope_ratio: float = Field(ge=-3.0, le=1.0)
    """Relative change of the motor's torque per relative change of speed."""


class ScrollLoads(Parameters):
    tangential_force_n: float = Field(ge=0.0, le=1e7)
    """Mean tangential gas force F_t."""
    ripple_ratio: float = Field(ge=0.0, le=1.0)
    """Amplitude of its once-per-revolution part over the mean."""
    overturning_arm_m: float = Field(ge=0.0, le=1.0)
    """Overturning moment M_m over F_t."""
    plate_friction: float = Field(ge=0.0, le=0.5)
    """µ_d between orbiting and fixed scroll."""
    friction_angle_rad: float = Field(ge=-7.0, le=7.0)
    """γ - η, from the line of the overturning moment to the direction of friction."""


class MiniCrankMachine(Parameters):
    name: str = Field(min_length=1)
    kind: Literal["minicrank-scroll"]
    four_bar: FourBar
    masses: Masses
    loads: ScrollLoads
    errata: tuple[Erratum, ...] = ()
