"""Parameters of the balancing options, one class per kind."""

from typing import Annotated, Literal

from pydantic import Field

from .base import Parameters
from .machines import Machine

ADDED_MASS = Field(gt=0.0, le=100.0)


class NoBalancer(Parameters):
    """The machine as it is; the reference of every change."""

    kind: Literal["none"]


class Pendulum(Parameters):
    """Two equal pendulums hung from the Oldham ring (thesis 7.1).

    The masses follow from (7.5): all of the ring's momentum is to be taken by bobs that swing out
    by `horizontal_reach_m` at the end of the stroke.
    """

    kind: Literal["pendulum"]
    length_m: float = Field(ge=1e-3, le=1.0)
    horizontal_reach_m: float = Field(ge=1e-3, le=1.0)
    damping_ratio: float = Field(ge=1e-4, le=1.0)
    """Damping of the bearing, as a fraction of critical of the hanging pendulum."""


class SprungMass(Parameters):
    """A mass between two springs on the Oldham ring (thesis 7.2)."""

    stiffness_n_per_m: float = Field(gt=0.0, le=1e7)
    """Stiffness K of each of the two springs."""
    tuned_speed_rpm: float = Field(ge=60.0, le=60000.0)
    damping_ratio: float = Field(ge=0.0, le=1.0)
    """Damping of the mass on both springs, as a fraction of critical."""
    height_below_ring_m: float = Field(ge=-1.0, le=1.0)


class SpringMass(SprungMass):
    """The sprung mass as dynamics tune it."""

    kind: Literal["spring-mass"]


class SpringMassPrinted(SprungMass):
    """The sprung mass of equation (7.20) as printed, which has a sign error."""

    kind: Literal["spring-mass-printed"]


class TwinOldham(Parameters):
    """A second Oldham ring in opposite phase at the other end of the shaft (thesis 7.3)."""

    kind: Literal["twin-oldham"]
    mass_kg: float = ADDED_MASS
    stroke_ratio: float = Field(gt=0.0, le=10.0)
    """Stroke amplitude of the twin over that of the ring."""
    distance_below_ring_m: float = Field(ge=-2.0, le=2.0)


class RingDamping(Parameters):
    """Rubber or springs between ring and frame (thesis 7.4)."""

    kind: Literal["ring-damping"]
    damping_ns_per_m: float = Field(ge=0.0, le=1e6)


class RotatingCounterweight(Parameters):
    """A share of the oscillating mass moment on the shaft, in the machine's two balance planes."""

    kind: Literal["rotating-counterweight"]
    share_ratio: float = Field(ge=0.0, le=2.0)


class Lanchester(Parameters):
    """Two weights that turn in opposite senses at the shaft's speed."""

    kind: Literal["lanchester"]
    share_ratio: float = Field(ge=0.0, le=2.0)
    """Share of the oscillating mass moment that both balance together."""
    radius_m: float = Field(gt=0.0, le=1.0)
    """Of the centre of mass of each weight from its shaft."""


class Redesign(Parameters):
    """The machine with other values; its file's table `change` names them."""

    kind: Literal["redesign"]
    machine: Machine
    added_mass_kg: float = Field(default=0.0, ge=-1e4, le=1e4)


Option = Annotated[
    NoBalancer
    | Pendulum
    | SpringMass
    | SpringMassPrinted
    | TwinOldham
    | RingDamping
    | RotatingCounterweight
    | Lanchester
    | Redesign,
    Field(discriminator="kind"),
]

RING_OPTIONS = (Pendulum, SpringMass, SpringMassPrinted, TwinOldham, RingDamping)
"""Options that act on an Oldham ring."""
SLIDER_OPTIONS = (RotatingCounterweight, Lanchester)
"""Options that act on any mass that slides to and fro."""
