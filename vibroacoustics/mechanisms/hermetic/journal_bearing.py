"""Half-Sommerfeld oil films of a journal bearing: forces and pressure in closed form.

The film thickness is h = c (1 + ε cos φ), φ from the thickest film in the sense of rotation. The
force on the journal has the component ξ towards the thinnest film and η ahead of it by 90°.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...base.arrays import Array
from ...base.errors import ParameterError
from .parameters import JournalBearing

Values = NDArray[Any]
"""Real values, or complex ones where a derivative is taken by a complex step."""

PRESSURE_ANGLES: Final = 2880
"""Angles of the search for the highest pressure: at ε = 0.95 it is found to 1e-4."""


def short_bearing_force(
    bearing: JournalBearing, eccentricity: Array, rate: Array, slip: Array
) -> tuple[Array, Array]:
    """F_ξ and F_η of a short bearing, pressure of 0 ≤ φ ≤ π only (Estupiñan eqs. 26 and 27).

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    eccentricity : ε, over the clearance
    rate : dε/dt, 1/s
    slip : u = Ω - 2 dϕ/dt, rad/s

    Returns
    -------
    radial, transverse : F_ξ and F_η, N
    """
    gap = 1.0 - eccentricity**2
    scale = (
        bearing.radius_m
        * bearing.viscosity_pa_s
        * bearing.width_m**3
        / (2.0 * bearing.clearance_m**2 * gap**2)
    )
    squeeze = np.pi * (1.0 + 2.0 * eccentricity**2) / np.sqrt(gap) * rate
    radial = -scale * (squeeze + 2.0 * eccentricity**2 * slip)
    return radial, scale * eccentricity * (4.0 * rate + 0.5 * np.pi * np.sqrt(gap) * slip)


def short_bearing_pressure(
    bearing: JournalBearing, angle: Values, eccentricity: Array, rate: Array, slip: Array
) -> Array:
    """Pressure in the middle of a short bearing, negative parts kept (Estupiñan eq. 24, z = 0).

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    angle : φ, rad
    eccentricity : ε, over the clearance
    rate : dε/dt, 1/s
    slip : u = Ω - 2 dϕ/dt, rad/s

    Returns
    -------
    pressure above ambient, Pa
    """
    thickness = 1.0 + eccentricity * np.cos(angle)
    source = 2.0 * rate * np.cos(angle) - slip * eccentricity * np.sin(angle)
    scale = 0.75 * bearing.viscosity_pa_s * (bearing.width_m / bearing.clearance_m) ** 2
    return np.asarray(-scale * source / thickness**3)


def sommerfeld_angle(angle: Values, eccentricity: Values) -> Values:
    """Sommerfeld's γ with 1 + ε cos φ = (1 - ε²)/(1 - ε cos γ), continuous in φ."""
    ratio = eccentricity / (1.0 + np.sqrt(1.0 - eccentricity**2))
    turn = np.arctan(ratio * np.sin(angle) / (1.0 + ratio * np.cos(angle)))
    return np.asarray(angle - 2.0 * turn)


def film_coordinates(
    bearing: JournalBearing, displacement_m: Array, velocity: Array, spin: Array
) -> tuple[Array, Array, Array]:
    """ε, dε/dt in 1/s and u in rad/s of a journal, for the laws in ξ and η.

    Raises
    ------
    ParameterError
        The journal touches the bearing.
    """
    x, y = displacement_m[..., 0], displacement_m[..., 1]
    eccentric = np.hypot(x, y)
    eccentricity = np.asarray(eccentric / bearing.clearance_m, dtype=float)
    if np.max(eccentricity) >= 1.0:
        raise ParameterError(
            f"eccentricity ratio = {np.max(eccentricity):g}: must be less than 1, the journal "
            "touches the bearing"
        )
    rate = np.sum(displacement_m * velocity, axis=-1) / (eccentric * bearing.clearance_m)
    turning = x * velocity[..., 1] - y * velocity[..., 0]
    return eccentricity, rate, spin - 2.0 * turning / eccentric**2


def highest_pressure_pa(
    bearing: JournalBearing, displacement_m: Array, velocity: Array, spin: Array
) -> Array:
    """Highest pressure of a short film around the bearing (Estupiñan eq. 24), Pa."""
    coordinates = film_coordinates(bearing, displacement_m, velocity, spin)
    angle = np.linspace(0.0, 2.0 * np.pi, PRESSURE_ANGLES, endpoint=False)
    eccentricity, rate, slip = (np.asarray(value)[..., np.newaxis] for value in coordinates)
    return np.asarray(short_bearing_pressure(bearing, angle, eccentricity, rate, slip).max(axis=-1))
