"""Keys of an Oldham ring in their slots: geometry, oil, material, friction."""

from math import inf
from typing import Annotated, Final

from pydantic import Field

from ...base.parameters import Parameters, Regime

INERTIA = Field(gt=0.0, le=10.0)
SIDE = Field(ge=1e-3, le=0.1)

OIL_FILMS: Final = (
    Regime("keys nearly dry, oil layer up to 2 µm", 0.0, 2e-6),
    Regime("keys starved of oil, layer up to 10 µm", 0.0, 10e-6),
    Regime("slots full of oil, layer from 20 µm", 20e-6, inf),
)
"""Assumed limits: the net force of a loose ring falls by a third from dry keys to a layer of
2 µm and by two thirds to 10 µm; 20 µm fill most slots of 8 to 40 µm."""


class OldhamKeys(Parameters):
    """Two keys in the housing's slots, two in the slots of the orbiting scroll, all alike."""

    radius_m: float = Field(ge=1e-3, le=1.0)
    """Distance of the centre of each key from the ring's centre."""
    clearance_m: float = Field(ge=1e-6, le=1e-3)
    """Gap on each side of a key in the middle of its slot; the slot is wider by two gaps."""
    width_m: float = SIDE
    """Size of a key's face along the shaft."""
    length_m: float = SIDE
    """Size of a key's face along the slot."""
    crown_radius_m: float = Field(ge=0.01, le=100.0)
    """Radius of the spherical crown of a key's face."""
    contact_modulus_pa: float = Field(ge=1e8, le=1e12)
    """Effective modulus E* of both materials: 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂."""
    restitution_ratio: float = Field(ge=0.2, le=1.0)
    """Speed of rebound over speed of approach of dry faces."""
    oil_viscosity_pa_s: float = Field(ge=1e-5, le=1.0)
    oil_layer_m: Annotated[float, *OIL_FILMS] = Field(ge=0.0, le=0.1)
    """Thickness of the oil on key and slot face together; dry at 0, flooded beyond the slot."""
    friction_ratio: float = Field(ge=0.0, le=0.5)
    """Coulomb friction along the slot over the force of contact."""
    ring_inertia_kg_m2: float = INERTIA
    """Inertia about the shaft's direction, through the ring's centre of mass."""
    scroll_inertia_kg_m2: float = INERTIA
    """Inertia of the part that the ring keeps from turning, about its centre."""
