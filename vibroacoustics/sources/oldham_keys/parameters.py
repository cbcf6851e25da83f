"""Keys of an Oldham ring in their slots: contact, film, friction."""

from typing import Literal

from pydantic import Field

from ...base.parameters import Parameters

INERTIA = Field(gt=0.0, le=10.0)


class OldhamKeys(Parameters):
    """Two keys in the housing's slots, two in the slots of the orbiting scroll, all alike."""

    radius_m: float = Field(ge=1e-3, le=1.0)
    """Of the middle of each key from the ring's centre."""
    clearance_m: float = Field(ge=1e-6, le=1e-3)
    """Gap on each side of a key in the middle of its slot; the slot is wider by two gaps."""
    contact_law: Literal["lankarani-nikravesh", "flores"]
    contact_stiffness_n_per_m1p5: float = Field(ge=1e7, le=1e13)
    """K of the contact force K δ^1.5."""
    restitution_ratio: float = Field(ge=0.1, le=1.0)
    """Speed of rebound over speed of approach."""
    least_approach_speed_m_per_s: float = Field(ge=1e-3, le=10.0)
    """Taken for contacts that begin slower: the damping of both laws grows without limit there."""
    film_damping_ns_per_m: float = Field(ge=0.0, le=1e5)
    """Squeeze film of a key in its slot, both sides together."""
    friction_ratio: float = Field(ge=0.0, le=0.5)
    """Coulomb friction along the slot over the force of contact."""
    ring_inertia_kg_m2: float = INERTIA
    """About the shaft's direction, through the ring's centre of mass."""
    scroll_inertia_kg_m2: float = INERTIA
    """Of the part that the ring keeps from turning, about its centre."""
