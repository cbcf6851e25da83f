"""Friction of journal and thrust bearings (Dagilis et al., equations 19 to 24)."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from .parameters import JournalBearing, ThrustBearing

MOST_STEPS: Final = 60
"""Largest number of steps: so many halvings come down to rounding; Newton's steps are about
seven."""
ROUNDING: Final = 4.0 * np.finfo(float).eps


def short_bearing_friction(eccentricity_ratio: Array, length_per_diameter: float) -> Array:
    """Friction coefficient Φ_T of (21) on the shaft of a short bearing.

    Shear of a full film, π/√(1 - ε²), and the load times the shaft's eccentricity across it,
    (l/d)² π ε² / (4 (1 - ε²)^1.5); Petroff's π of (19) for a shaft in the middle.

    Parameters
    ----------
    eccentricity_ratio : eccentricity, from 0 to below 1, shape (...)
    length_per_diameter : l/d
    """
    ratio = _checked(eccentricity_ratio)
    clear = np.sqrt(1.0 - ratio**2)
    return np.asarray(np.pi / clear + 0.25 * np.pi * (length_per_diameter * ratio) ** 2 / clear**3)


def eccentricity_ratio(load_coefficient: Array, length_per_diameter: float) -> Array:
    """Eccentricity ratio at which a short bearing carries a load.

    The load times (1 - ε²)² is a bounded, rising function of ε: Newton's steps, halved intervals
    where one would leave what is known to hold the root.

    Parameters
    ----------
    load_coefficient : Φ_p (22), at least zero, shape (...)
    length_per_diameter : length over diameter of the bearing, l/d
    """
    low, high = np.zeros_like(load_coefficient), np.ones_like(load_coefficient)
    ratio = 0.5 * high
    for _ in range(MOST_STEPS):
        excess, slope = _excess(ratio, load_coefficient, length_per_diameter)
        low, high = np.where(excess < 0.0, ratio, low), np.where(excess < 0.0, high, ratio)
        step = ratio - excess / slope
        before, ratio = ratio, np.where((low <= step) & (step <= high), step, 0.5 * (low + high))
        if np.all(np.abs(ratio - before) <= ROUNDING * ratio):
            break
    return np.asarray(np.minimum(ratio, np.nextafter(1.0, 0.0)))


def _excess(
    ratio: Array, load_coefficient: Array, length_per_diameter: float
) -> tuple[Array, Array]:
    """Load that a bearing carries beyond the given one, times (1 - ε²)², and its slope over ε."""
    square = ratio * ratio
    growth, half = 16.0 - np.pi**2, 0.5 * length_per_diameter**2
    root = np.sqrt(np.pi**2 + growth * square)
    excess = half * ratio * root - load_coefficient * (1.0 - square) ** 2
    slope = half * (root + growth * square / root) + 4.0 * load_coefficient * ratio * (1.0 - square)
    return excess, slope


def journal_friction_moment(
    bearing: JournalBearing, load_n: Array, velocity: Array, viscosity_pa_s: float
) -> Array:
    """Friction moment (23), M = µ F r with µ = η ω Φ_T / (p ψ) (21), N m.

    Parameters
    ----------
    bearing : lengths in m
    load_n : load, shape (...), N
    velocity : angular velocity, shape (...), rad/s, above zero
    viscosity_pa_s : dynamic viscosity
    """
    diameter = 2.0 * bearing.radius_m
    slenderness = bearing.length_m / diameter
    clearance = bearing.clearance_m / bearing.radius_m
    shear = viscosity_pa_s * velocity * bearing.length_m * diameter
    ratio = eccentricity_ratio(clearance**2 * load_n / shear, slenderness)
    friction = shear / clearance * short_bearing_friction(ratio, slenderness)
    return np.asarray(friction * bearing.radius_m)


def journal_friction_coefficient(
    bearing: JournalBearing, load_n: Array, velocity: Array, viscosity_pa_s: float
) -> Array:
    """Friction coefficient of a short bearing with its eccentricity (21): M/(F r).

    Parameters
    ----------
    bearing : lengths in m
    load_n : load, shape (...), N, above zero
    velocity : angular velocity, shape (...), rad/s, above zero
    viscosity_pa_s : dynamic viscosity
    """
    moment = journal_friction_moment(bearing, load_n, velocity, viscosity_pa_s)
    return np.asarray(moment / (load_n * bearing.radius_m))


def petroff_coefficient(
    bearing: JournalBearing, load_n: Array, velocity: Array, viscosity_pa_s: float
) -> Array:
    """Friction coefficient of an unloaded bearing (19): π η ω / (p ψ).

    Parameters
    ----------
    bearing : lengths in m
    load_n : load, shape (...), N
    velocity : angular velocity, shape (...), rad/s
    viscosity_pa_s : dynamic viscosity
    """
    pressure = load_n / (2.0 * bearing.radius_m * bearing.length_m)
    clearance = bearing.clearance_m / bearing.radius_m
    return np.asarray(np.pi * viscosity_pa_s * velocity / (pressure * clearance))


def loaded_coefficient(
    bearing: JournalBearing, load_n: Array, velocity: Array, viscosity_pa_s: float
) -> Array:
    """Friction coefficient without eccentricity (20): π η ω / (p ψ) + 0.55 ψ (d/l)^m.

    m is 1.5 for l < d, 1 else. The paper prints (l/d)^m, which would lower the friction of a
    short bearing.

    Parameters
    ----------
    bearing : lengths in m
    load_n : load, shape (...), N
    velocity : angular velocity, shape (...), rad/s
    viscosity_pa_s : dynamic viscosity
    """
    slenderness = bearing.length_m / (2.0 * bearing.radius_m)
    exponent = 1.5 if slenderness < 1.0 else 1.0
    clearance = bearing.clearance_m / bearing.radius_m
    unloaded = petroff_coefficient(bearing, load_n, velocity, viscosity_pa_s)
    return np.asarray(unloaded + 0.55 * clearance * slenderness**-exponent)


def thrust_friction_moment(bearing: ThrustBearing, load_n: float) -> float:
    """Friction moment of the thrust bearing (24), N m.

    Parameters
    ----------
    bearing : radii in m
    load_n : weight of crankshaft and rotor, N
    """
    outer, inner = bearing.outer_radius_m, bearing.inner_radius_m
    radius = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2)
    return bearing.friction_ratio * load_n * radius


def _checked(ratio: Array) -> Array:
    if not np.all((ratio >= 0.0) & (ratio < 1.0)):
        raise ParameterError("eccentricity_ratio: allowed 0 to below 1")
    return np.asarray(ratio)
