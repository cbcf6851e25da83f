"""Half-Sommerfeld oil films of a journal bearing: forces and pressure in closed form.

The film thickness is h = c (1 + ε cos φ), φ from the thickest film in the sense of rotation. The
force on the journal has the component ξ towards the thinnest film and η ahead of it by 90°.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...mechanics.beam_rotor import RotorMatrices
from ...mechanics.journal_film import JournalFilm, short_bearing
from .parameters import JournalBearing

Values = NDArray[Any]
"""Real values, or complex ones where a derivative is taken by a complex step."""
PRESSURE_ANGLES: Final = 2880
"""Angles of the search for the highest pressure: at ε = 0.95 it is found to 1e-4."""
FilmForce = Callable[[JournalBearing, Values, Values, Values], Values]
"""Force on the journal, N, from its displacement, velocity (..., 2) and spin (...)."""
COMPLEX_STEP: Final = 1e-30
"""A complex step has no cancellation; it need only be small beside a displacement of 1 nm."""


def short_bearing_force(
    bearing: JournalBearing, eccentricity: Array, rate: Array, slip: Array
) -> tuple[Array, Array]:
    """F_ξ and F_η of a short bearing, pressure of 0 ≤ φ ≤ π only (Estupiñan eqs. 26 and 27).

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    eccentricity : ε over the clearance, shape (...)
    rate : dε/dt, shape (...), 1/s
    slip : u = Ω - 2 dϕ/dt, shape (...), rad/s

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
    eccentricity : ε over the clearance, shape (...)
    rate : dε/dt, shape (...), 1/s
    slip : u = Ω - 2 dϕ/dt, shape (...), rad/s

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


def film_integrals(
    eccentricity: Values, start: Values, end: Values
) -> tuple[Values, Values, Values]:
    """Integrals of cos², sin cos and sin² over (1 + ε cos φ)³ from `start` to `end`."""
    gap = 1.0 - eccentricity**2

    def primitives(angle: Values) -> tuple[Values, Values, Values]:
        gamma = sommerfeld_angle(angle, eccentricity)
        half, double = 0.5 * gamma, 0.25 * np.sin(2.0 * gamma)
        cosines = half + double - 2.0 * eccentricity * np.sin(gamma) + eccentricity**2 * gamma
        mixed = 0.5 * np.sin(gamma) ** 2 + eccentricity * np.cos(gamma)
        return cosines / gap**2.5, mixed / gap**2, (half - double) / gap**1.5

    upper, lower = primitives(end), primitives(start)
    return upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]


def positive_film_force(
    bearing: JournalBearing, displacement_m: Values, velocity: Values, spin: Values
) -> Values:
    """Force of a short film over the half where its pressure is positive, whichever that is.

    With V = v - Ω/2 ẑ x e the pressure of eq. 24 is 6µ (l²/4 - z²) V·n / h³, positive on the half
    that V points to (Booker 1965), so that (26) and (27) follow for dε/dt = 0 and u > 0. The
    printed ones keep 0 ≤ φ ≤ π and suck the journal outwards where u < 0 or dε/dt < 0.

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    displacement_m : journal centre from the bearing's, shape (..., 2)
    velocity : velocity of the journal centre, m/s, shape (..., 2)
    spin : Ω, rad/s

    Returns
    -------
    force on the journal, N, shape (..., 2)
    """
    x, y = displacement_m[..., 0], displacement_m[..., 1]
    eccentric = np.sqrt(x**2 + y**2)
    cosine, sine = -x / eccentric, -y / eccentric  # to the thickest film
    slip_x, slip_y = velocity[..., 0] + 0.5 * spin * y, velocity[..., 1] - 0.5 * spin * x
    along, across = cosine * slip_x + sine * slip_y, cosine * slip_y - sine * slip_x
    middle = _angle(along, across)
    cosines, mixed, sines = film_integrals(
        eccentric / bearing.clearance_m, middle - 0.5 * np.pi, middle + 0.5 * np.pi
    )
    scale = (
        -bearing.viscosity_pa_s * bearing.radius_m * (bearing.width_m / bearing.clearance_m) ** 3
    )
    force_along = scale * (cosines * along + mixed * across)
    force_across = scale * (mixed * along + sines * across)
    return np.stack(
        (cosine * force_along - sine * force_across, sine * force_along + cosine * force_across),
        axis=-1,
    )


def _angle(x: Values, y: Values) -> Values:
    """Angle of (x, y), differentiable by a complex step, unlike arctan2."""
    base = np.arctan2(y.real, x.real)
    turned_x = x * np.cos(base) + y * np.sin(base)
    turned_y = y * np.cos(base) - x * np.sin(base)
    return np.asarray(base + np.arctan(turned_y / turned_x))


def linear_film(bearing: JournalBearing, load_n: float, spin_rad_per_s: float) -> JournalFilm:
    """Short half-Sommerfeld film about the equilibrium of a steady load along x.

    Parameters
    ----------
    bearing : radius, width and clearance in m, viscosity in Pa s
    load_n : on the journal, along x, N
    spin_rad_per_s : Ω
    """
    size = 2.0 * bearing.radius_m, bearing.width_m, bearing.clearance_m
    return short_bearing(*size, bearing.viscosity_pa_s, spin_rad_per_s, load_n)


def damped_modes(
    rotor: RotorMatrices, films: dict[int, JournalFilm], spin_rad_per_s: float
) -> tuple[Array, Array]:
    """Damped natural frequencies, ascending, and damping ratios of a rotor on linear films.

    Parameters
    ----------
    rotor : M, G and K
    films : by the freedom of x of the journal; y follows it
    spin_rad_per_s : Ω

    Returns
    -------
    frequencies in Hz and damping ratios of the oscillating modes
    """
    damping, stiffness = spin_rad_per_s * rotor.gyroscopic, rotor.stiffness.copy()
    for dof, film in films.items():
        stiffness[dof : dof + 2, dof : dof + 2] += film.stiffness
        damping[dof : dof + 2, dof : dof + 2] += film.damping
    zero, identity = np.zeros_like(stiffness), np.eye(len(stiffness))
    lower = -np.linalg.solve(rotor.mass, np.hstack((stiffness, damping)))
    values = np.linalg.eigvals(np.vstack((np.hstack((zero, identity)), lower)))
    values = values[values.imag > 1.0]
    values = values[np.argsort(values.imag)]
    return values.imag / (2.0 * np.pi), -values.real / np.abs(values)
