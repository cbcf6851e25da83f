"""Film laws as Estupiñan & Santos print them, beside those that the package uses."""

from collections.abc import Callable

import numpy as np

from vibroacoustics.base.arrays import Array
from vibroacoustics.mechanisms.hermetic.journal_bearing import FilmForce, Values, sommerfeld_angle
from vibroacoustics.mechanisms.hermetic.parameters import JournalBearing


def long_bearing_force(
    bearing: JournalBearing, eccentricity: Array, rate: Array, slip: Array
) -> tuple[Array, Array]:
    """F_ξ and F_η of an infinitely long bearing (Estupiñan eqs. 28 and 29).

    They belong to a film that is at ambient pressure at φ = 0 and φ = π, `long_bearing_pressure`,
    not to the printed (25), whose squeeze part does not vanish at π.

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
    squared = eccentricity**2
    gap, wide = 1.0 - squared, 2.0 + squared
    scale = 12.0 * bearing.viscosity_pa_s * bearing.width_m * bearing.radius_m**3
    scale /= bearing.clearance_m**2
    squeeze = (0.5 * np.pi - 8.0 / (np.pi * wide)) / gap**1.5 * rate
    radial = -scale * (squared * slip / (wide * gap) + squeeze)
    wedge = 0.5 * np.pi * eccentricity * slip / (wide * np.sqrt(gap))
    return radial, scale * (wedge + 2.0 * eccentricity * rate / (wide * gap))


def long_bearing_pressure(
    bearing: JournalBearing, angle: Array, eccentricity: Array, rate: Array, slip: Array
) -> Array:
    """Pressure of an infinitely long bearing that is ambient at φ = 0 and φ = π.

    The wedge part is that of Estupiñan eq. 25. The squeeze part solves eq. 23 with both ends at
    ambient pressure, as eqs. 28 and 29 do.

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    angle : φ from 0 to π, rad
    eccentricity : ε, over the clearance
    rate : dε/dt, 1/s
    slip : u = Ω - 2 dϕ/dt, rad/s

    Returns
    -------
    pressure above ambient, Pa
    """
    squared = eccentricity**2
    thickness = 1.0 + eccentricity * np.cos(angle)
    wedge = 0.5 * slip * eccentricity * np.sin(angle) * (2.0 + eccentricity * np.cos(angle))
    wedge = wedge / ((2.0 + squared) * thickness**2)
    gamma = sommerfeld_angle(angle, eccentricity)
    sine = (1.0 - np.cos(gamma) - 0.5 * eccentricity * np.sin(gamma) ** 2) / (1.0 - squared) ** 2
    one = (1.0 + 0.5 * squared) * gamma - 2.0 * eccentricity * np.sin(gamma)
    one = (one + 0.25 * squared * np.sin(2.0 * gamma)) / (1.0 - squared) ** 2.5
    leak = 4.0 * np.sqrt(1.0 - squared) / (np.pi * (2.0 + squared))
    scale = 12.0 * bearing.viscosity_pa_s * (bearing.radius_m / bearing.clearance_m) ** 2
    return np.asarray(scale * (wedge + rate * (sine - leak * one)))


def printed_film_force(
    law: Callable[..., tuple[Array, Array]],
) -> FilmForce:
    """A printed law in ε, dε/dt and u as a force in x and y (Estupiñan eq. 30)."""

    def force(
        bearing: JournalBearing, displacement_m: Values, velocity: Values, spin: Values
    ) -> Values:
        x, y = displacement_m[..., 0], displacement_m[..., 1]
        eccentric = np.sqrt(x**2 + y**2)
        rate = (x * velocity[..., 0] + y * velocity[..., 1]) / eccentric
        turning = (x * velocity[..., 1] - y * velocity[..., 0]) / eccentric**2
        clearance = bearing.clearance_m
        radial, transverse = law(
            bearing, eccentric / clearance, rate / clearance, spin - 2.0 * turning
        )
        return np.stack(
            ((radial * x - transverse * y) / eccentric, (radial * y + transverse * x) / eccentric),
            axis=-1,
        )

    return force
