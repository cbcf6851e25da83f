"""Keys of an Oldham ring in their slots, and the squeeze film and elastic face of one."""

from math import inf, log, pi, sin, sqrt, tan
from typing import Annotated, Final, NamedTuple

import numba
import numpy as np
from pydantic import Field
from scipy.optimize import brentq

from ...base.arrays import Array
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


TERMS: Final = 50
"""Odd terms of the series of the flat face; the next one is below 1e-10 of the sum."""
LEAST_WETTED: Final = 1e-9
"""Least wetted sag over the whole; it keeps the mobility finite at the layer's surface."""


class Face(NamedTuple):
    """Constants of a crowned face with its film; numba takes named tuples, not dataclasses.

    Attributes
    ----------
    stiffness : K of the elastic force K d^1.5, N/m^1.5
    damping : η of the damping force η d^¼ d', N s/m^1.25
    sphere : 6 π μ R², film coefficient times thickness of the crown alone, N s
    sag : S, sag of the crown at the edge of an equivalent face, m
    shape : a of the film law, 1 for a round or square face
    layer : t, thickness of the oil on both faces together, m
    """

    stiffness: float
    damping: float
    sphere: float
    sag: float
    shape: float
    layer: float


def flat_face_ratio(length_ratio: Array | float) -> Array:
    """Return β of c = β μ L W³/h³, the film coefficient of flat parallel rectangles.

    β = 1 - 192 W/(π⁵ L) Σ tanh(k π L/(2 W))/k⁵ over odd k; 0.422 for a square, 1 for a long face
    (series solution of Reynolds' equation; Gross, Fluid Film Lubrication, 1980, section 7).

    Parameters
    ----------
    length_ratio : L/W, longer over shorter side
    """
    ratio = np.asarray(length_ratio)
    odd = 2.0 * np.arange(TERMS) + 1.0
    terms = np.tanh(0.5 * np.pi * odd * ratio[..., None]) / odd**5
    return np.asarray(1.0 - 192.0 / (np.pi**5 * ratio) * terms.sum(axis=-1))


def film_sag_m(width_m: float, length_m: float, crown_m: float) -> float:
    """Return the sag S = √(β L W³/(6 π))/R for which flat and spherical limits hold together.

    Parameters
    ----------
    width_m, length_m : sides of the face, in any order
    crown_m : R, radius of the spherical crown
    """
    short, long = sorted((width_m, length_m))
    area = float(flat_face_ratio(long / short)) * long * short**3
    return sqrt(area / (6.0 * pi)) / crown_m


def film_shape(length_ratio: Array | float) -> Array:
    """Return a = 1 + 0.21 (q - 1) + 0.045 (q - 1)², a fit to numerical solutions for q to 3.

    Parameters
    ----------
    length_ratio : q, longer over shorter side
    """
    excess = np.asarray(length_ratio) - 1.0
    return np.asarray(1.0 + 0.21 * excess + 0.045 * excess**2)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def film_mobility(thickness: float, face: Face) -> tuple[float, float]:
    """Return the speed of approach of film surfaces per force, m/(N s), and its slope by thickness.

    1/c = h (1 + 2 a r + r²)/(6 π μ R²) with r = h/s and the wetted sag s = min(S, t - h): Reynolds'
    equation without negative pressure. It is zero where the surfaces touch.

    Parameters
    ----------
    thickness : h, m
    face : constants
    """
    h = max(thickness, 0.0)
    starved = face.layer - h < face.sag
    ratio = h / max(min(face.sag, face.layer - h), LEAST_WETTED * face.sag)
    slope = 1.0 + ratio * (4.0 * face.shape + 3.0 * ratio)
    if starved:
        slope += 2.0 * ratio**2 * (face.shape + ratio)
    mobility = h * (1.0 + ratio * (2.0 * face.shape + ratio)) / face.sphere
    return mobility, slope / face.sphere


def contact_stiffness_n_per_m1p5(modulus_pa: float, crown_m: float) -> float:
    """Return K = 4/3 E* √R of a sphere on a flat (Hertz; Johnson, Contact Mechanics, 1985, 4.2).

    Parameters
    ----------
    modulus_pa : E*, effective modulus of both materials
    crown_m : R, radius of the crown
    """
    return 4.0 / 3.0 * modulus_pa * sqrt(crown_m)


def contact_damping(restitution: float, mass_kg: float, stiffness: float) -> float:
    """Return η of the damping force η d^¼ d' for which a dry impact has a restitution.

    η = α √(M K) (Tsuji et al. 1992, Powder Technol. 71, 239) makes d^1.25 a linear oscillator of
    damping ratio α/√5 = sin γ over the speed. The faces part where the force is zero, so that
    ln e = -(π - 2 γ) tan γ (Schwager & Pöschel 2007, Granul. Matter 9, 465), above e = exp(-2).

    Parameters
    ----------
    restitution : e, speed of rebound over speed of approach
    mass_kg : M, mass that strikes
    stiffness : K of the elastic force K d^1.5, N/m^1.5
    """
    angle = 0.0
    if restitution < 1.0:
        angle = brentq(
            lambda g: log(restitution) + (pi - 2.0 * g) * tan(g), 0.0, 0.5 * pi - 1e-6, xtol=1e-14
        )
    return sin(angle) * sqrt(5.0 * mass_kg * stiffness)


def contact_mass_kg(
    ring_mass_kg: float, radius_m: float, ring_inertia_kg_m2: float, scroll_inertia_kg_m2: float
) -> float:
    """Return M = 1/(1/m + R_k² (1/J_ring + 1/J_scroll)), the mass at a key in the scroll's slot.

    Parameters
    ----------
    ring_mass_kg : m
    radius_m : R_k of the keys
    ring_inertia_kg_m2, scroll_inertia_kg_m2 : about the shaft's direction
    """
    turns = 1.0 / ring_inertia_kg_m2 + 1.0 / scroll_inertia_kg_m2
    return 1.0 / (1.0 / ring_mass_kg + radius_m**2 * turns)


def key_face(keys: OldhamKeys, ring_mass_kg: float) -> Face:
    """Return the constants of one key's faces."""
    stiffness = contact_stiffness_n_per_m1p5(keys.contact_modulus_pa, keys.crown_radius_m)
    inertias = (keys.ring_inertia_kg_m2, keys.scroll_inertia_kg_m2)
    mass = contact_mass_kg(ring_mass_kg, keys.radius_m, *inertias)
    short, long = sorted((keys.width_m, keys.length_m))
    return Face(
        stiffness=stiffness,
        damping=contact_damping(keys.restitution_ratio, mass, stiffness),
        sphere=6.0 * pi * keys.oil_viscosity_pa_s * keys.crown_radius_m**2,
        sag=film_sag_m(short, long, keys.crown_radius_m),
        shape=float(film_shape(long / short)),
        layer=keys.oil_layer_m,
    )


@numba.njit(cache=True, nogil=True, error_model="numpy")
def dry_force(deflection: float, speed: float, stiffness: float, damping: float) -> float:
    """Return K d^1.5 + η d^¼ V, N: the push of a face that follows the other; never a pull.

    Parameters
    ----------
    deflection : d, m, at least zero
    speed : V, speed of approach, m/s
    stiffness, damping : K and η
    """
    root = np.sqrt(deflection)
    return float(max(stiffness * deflection * root + damping * np.sqrt(root) * speed, 0.0))


@numba.njit(cache=True, nogil=True, error_model="numpy")
def series_force(deflection: float, gap: float, speed: float, face: Face) -> float:
    """Return the push through film and face in series, N.

    F = max(K d^1.5 + η d^¼ V, 0)/(1 + η d^¼/c), as both carry F = c (V - d').

    Parameters
    ----------
    deflection, gap : d and g, m
    speed : V, speed of approach, m/s
    face : constants
    """
    if deflection <= 0.0:
        return 0.0
    mobility = film_mobility(gap + deflection, face)[0]
    damped = face.damping * np.sqrt(np.sqrt(deflection)) * mobility
    return float(dry_force(deflection, speed, face.stiffness, face.damping) / (1.0 + damped))
